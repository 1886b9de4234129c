// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/evolve.h"

#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/flow/speed.h"
#include "molsurf/levelset/redistance.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/spline/curvature.h"
#include "molsurf/spline/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace molsurf
{

namespace
{

/// Iterations that keep the band a distance while the interface moves by at most 0.4 voxel: each
/// carries the distance half a voxel.
constexpr int reinitializations = 1;

/// Takes the curvatures of a leaf from a spline.
void curvatureFromSpline(const Spline& spline, const openvdb::Coord& origin, double voxelSize,
                         const LeafMask& active, LeafCurvature& shape)
{
    SplineSampler sampler(spline);
    active.forEach([&](int v) {
        const Jet jet =
            sampler.at(origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * voxelSize);
        if (jet.gradient.lengthSqr() < 1e-6) return;
        shape.mean[v] = float(2.0 * meanCurvature(jet));
        shape.gauss[v] = float(gaussianCurvature(jet));
    });
}

/// The spline of phi on voxels of edge 2^level h, on a band wide enough for it.
Spline coarseSpline(const SparseField& phi, int level, const Progress& progress)
{
    const double width = (flowWidthVox + 3.5 * (1 << level)) * phi.voxelSize;
    const DistanceBand wide = redistance(copied(phi), {width, width}, 0.0, progress);
    return fitSpline(wide.phi, level, progress);
}

/// The parameters of a step of the flow, besides the band.
struct Step {
    Weights weights;
    StepSize size;
    const Spline* coarse; ///< that gives the curvature, or null for differences
};

/// One step of the flow on all leaves.
/// @param[out] next  phi after it
/// @return sums over the region's own voxels
StepSums takeStep(const NarrowBand& band, const Step& step, const Region& region, LeafField& next,
                  const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    const double h = band.phi.voxelSize;
    // Positions are taken from the first leaf: volumes then do not cancel far from the origin.
    const openvdb::Coord first = !region.whole() ? region.anchor
                                 : table.size()  ? table.origin(0)
                                                 : openvdb::Coord();
    return parallelSum<StepSums>(table.size(), progress, [&](std::size_t n) {
        const LeafMask active = table.active(n) & within(band.phi.leaf(n), float(flowWidthVox * h));
        if (!active.any()) {
            std::copy_n(band.phi.leaf(n), leafSize, next.leaf(n));
            return StepSums();
        }
        LeafBlock<float, 1> phi, psi;
        phi.gather(band.phi, n);
        psi.gather(table, band.psi, n);
        next.prefetchAfter(n);
        LeafCurvature shape;
        curvature(phi, active, float(h), shape);
        if (step.coarse) curvatureFromSpline(*step.coarse, table.origin(n), h, active, shape);
        const StepSums sums =
            flowStep(phi, psi, shape, active, (table.origin(n) - first).asVec3d() * h, float(h),
                     step.weights, step.size, next.leaf(n));
        return region.owned.isInside(table.origin(n)) ? sums : StepSums();
    });
}

/// Gives each voxel of a new leaf the sign of the nearest voxel of an old leaf.
/// @param[in]  n    index of the leaf in the new table
/// @param[out] phi  512 values, -width or width
void fillFromNeighbours(const SparseField& old, const LeafTable& table, std::size_t n, float width,
                        float* phi)
{
    const auto& near = table.neighbours(n);
    std::array<std::int32_t, 27> known;
    for (int k = 0; k < 27; ++k) {
        known[k] = near[k] == noLeaf ? noLeaf : old.table.find(table.origin(near[k]));
    }
    for (int v = 0; v < leafSize; ++v) {
        const int x = v >> 6, y = v >> 3 & 7, z = v & 7;
        int nearest = 1000;
        phi[v] = width;
        for (int k = 0; k < 27; ++k) {
            if (known[k] == noLeaf) continue;
            const int dx = k / 9 - 1, dy = k / 3 % 3 - 1, dz = k % 3 - 1;
            const int qx = dx == 0 ? x : dx < 0 ? -1 : 8, qy = dy == 0 ? y : dy < 0 ? -1 : 8;
            const int qz = dz == 0 ? z : dz < 0 ? -1 : 8;
            const int distance = (x - qx) * (x - qx) + (y - qy) * (y - qy) + (z - qz) * (z - qz);
            if (distance >= nearest) continue;
            nearest = distance;
            const float value = old.leaf(known[k])[64 * (qx & 7) + 8 * (qy & 7) + (qz & 7)];
            phi[v] = std::copysign(width, value);
        }
    }
}

/// Whether a leaf of a table lacks a neighbour, in a domain, that a step from its voxels leads to.
bool lacksNeighbour(const LeafTable& table, std::size_t n, const LeafMask& inside,
                    const openvdb::CoordBBox& domain)
{
    const auto& near = table.neighbours(n);
    const auto& w = inside.words;
    std::uint64_t all = 0;
    for (const std::uint64_t word : w) all |= word;
    const auto lacks = [&](int k) {
        return near[k] == noLeaf &&
               domain.isInside(table.origin(n).offsetBy(
                   leafDim * (k / 9 - 1), leafDim * (k / 3 % 3 - 1), leafDim * (k % 3 - 1)));
    };
    return (w[0] && lacks(4)) || (w[7] && lacks(22)) || ((all & 0xff) && lacks(10)) ||
           ((all >> 56) && lacks(16)) || ((all & 0x0101010101010101ull) && lacks(12)) ||
           ((all & 0x8080808080808080ull) && lacks(14));
}

/// Adds leaves about the active voxels. The leaves of the band stay, where none of their voxels is
/// active, too.
/// @param[in,out] scratch  a field that grows with the band; its values are lost
void addLeaves(NarrowBand& band, const PsiSource& source, const openvdb::CoordBBox& domain,
               LeafField& scratch, Progress& progress)
{
    const LeafTable& old = band.phi.table;
    const float width = float(bandWidthVox * band.phi.voxelSize);
    LeafTable table = joined(clipped(dilated(old, 1, Spread::Ball, progress), domain), old);
    // One field after the other: at no time are there both twice.
    scratch = LeafField();
    const auto extend = [&](LeafField& field, const auto& fill) {
        LeafField out(table.size());
        parallelFor(table.size(), progress, [&](std::size_t n) {
            const std::int32_t m = old.find(table.origin(n));
            if (m != noLeaf) {
                std::copy_n(field.leaf(std::size_t(m)), leafSize, out.leaf(n));
            } else {
                fill(n, out.leaf(n));
            }
        });
        field = std::move(out);
    };
    extend(band.psi, [&](std::size_t n, float* psi) { source(table.origin(n), psi); });
    extend(band.phi.values,
           [&](std::size_t n, float* phi) { fillFromNeighbours(band.phi, table, n, width, phi); });
    scratch = LeafField(table.size());
    band.phi.table = std::move(table);
}

/// Makes the active voxels those within the band of the interface; adds leaves as needed. None is
/// dropped: that would change what stencils beside it see, and what happens at a voxel would depend
/// on whether any leaf, anywhere, has to be added in the same step.
/// @param[in]     domain   where leaves may be
/// @param[in,out] scratch  a field that grows with the band; its values are lost
void updateBand(NarrowBand& band, const PsiSource& source, const openvdb::CoordBBox& domain,
                LeafField& scratch, Progress& progress)
{
    LeafTable& table = band.phi.table;
    // The voxels that are certainly within the band, and one step around them.
    const float core = float(bandWidthVox * band.phi.voxelSize - band.phi.voxelSize);
    std::vector<LeafMask> inside(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        inside[n] = within(band.phi.leaf(n), core) & table.active(n);
    });
    bool complete = true;
    for (std::size_t n = 0; n < table.size(); ++n) {
        table.active(n) = inside[n];
        complete = complete && !(inside[n].any() && lacksNeighbour(table, n, inside[n], domain));
    }
    if (!complete) {
        addLeaves(band, source, domain, scratch, progress);
        return;
    }
    parallelFor(table.size(), progress,
                [&](std::size_t n) { table.active(n) = dilatedMask(table, inside, n, false); });
}

/// How far the interface has yet to go if the displacements of the last two steps go on to shrink
/// by the same factor: the sum of a geometric series [Å].
double remainingDisplacement(const std::vector<double>& displacement)
{
    const std::size_t n = displacement.size();
    if (n < 2) return n == 1 ? displacement[0] : 0.0;
    const double last = displacement[n - 1], ratio = last / displacement[n - 2];
    if (last == 0.0) return 0.0;
    return ratio < 1.0 ? last * ratio / (1.0 - ratio) : std::numeric_limits<double>::infinity();
}

/// Whether the steps, though small, will not meet the tolerance, since they no longer fall: on
/// voxels that are too large for the metric's valley the discretisation keeps the flow moving for
/// ever.
bool stalled(const EvolutionReport& report, const EvolveOptions& options, double voxelSize)
{
    constexpr std::size_t steps = 5; // over which they are compared
    const std::vector<double>&d = report.meanDisplacement, &E = report.energy;
    const std::size_t n = d.size();
    return n > steps && d[n - 1] >= options.displacementTolerance * voxelSize &&
           d[n - 1] < 0.05 * voxelSize && d[n - 1] > 0.99 * d[n - 1 - steps] &&
           std::abs(E[n] - E[n - steps]) < 0.01 * E[n];
}

} // namespace

EvolutionReport evolve(NarrowBand& band, const PsiSource& source, const EvolveOptions& options,
                       Progress& progress, const Region& region, int halo)
{
    const double h = band.phi.voxelSize;
    const bool preconditioned = options.flow == Flow::Preconditioned;
    const bool gradient = options.regularizer == Regularizer::Gradient;
    const bool fixed = options.steps >= 0;
    const int maxSteps = fixed                   ? options.steps
                         : options.maxSteps >= 0 ? options.maxSteps
                         : preconditioned        ? 50
                                                 : 2000;
    const bool mayGiveUp = preconditioned && !fixed && options.maxSteps < 0;
    const float lambda = float(options.lambda);
    Step step{gradient ? Weights{lambda, 0.0f} : Weights{0.0f, lambda}, {}, nullptr};

    EvolutionReport report;
    LeafField next(band.phi.table.size());
    double lastDisplacement = 0.0;
    for (;;) {
        Spline coarse;
        if (options.splineLevel > 0) {
            coarse = coarseSpline(band.phi, options.splineLevel, progress);
            step.coarse = &coarse;
        }
        step.size = {true, 0.0f};
        if (!preconditioned) {
            // Explicit Euler for a stiffness P is stable up to 2/P; the longest step is limited
            // anyway.
            const StepSums before = takeStep(band, step, region, next, progress);
            step.size = {false, 0.8f / before.maxSecond};
        }
        const StepSums sums = takeStep(band, step, region, next, progress);
        if (!std::isfinite(sums.energy) || !std::isfinite(sums.displacement)) {
            throw Error(ErrorKind::Numeric, "evolve: step " + std::to_string(report.steps) +
                                                ": the energy is not a number");
        }
        if (sums.area == 0.0 && region.whole()) {
            throw Error(ErrorKind::Numeric,
                        "evolve: step " + std::to_string(report.steps) +
                            ": nothing is left of the surface [hint: a smaller `lambda`]");
        }
        if (!report.energy.empty() && sums.energy > 0.0) {
            const double change = std::abs(sums.energy - report.energy.back()) / sums.energy;
            report.converged = change < options.energyTolerance &&
                               lastDisplacement < options.displacementTolerance * h;
        }
        report.energy.push_back(sums.energy);
        report.area.push_back(sums.area);
        report.volume.push_back(sums.volume);
        report.unresolvedGapVoxels = sums.unresolvedGaps;
        report.estimatedRemainingDisplacement = remainingDisplacement(report.meanDisplacement);
        if ((report.converged && !fixed) || report.steps == maxSteps) break;
        if (mayGiveUp && stalled(report, options, h)) break;

        lastDisplacement = sums.area > 0.0 ? sums.displacement / sums.area : 0.0;
        report.meanDisplacement.push_back(lastDisplacement);
        report.maxSpeed.push_back(sums.maxSpeed);
        ++report.steps;
        progress.update("evolve", double(report.steps) / maxSteps);
        std::swap(band.phi.values, next);
        reinitialize(band.phi, bandWidthVox * h, reinitializations, progress, next);
        updateBand(band, source, region.grown(halo), next, progress);
    }
    return report;
}

void checkConvergence(const EvolveOptions& options, double voxelSize, EvolutionReport& report)
{
    report.estimatedRemainingDisplacement = remainingDisplacement(report.meanDisplacement);
    const std::size_t n = report.energy.size();
    if (n < 2) return;
    const double change = std::abs(report.energy[n - 1] - report.energy[n - 2]);
    report.converged = change < options.energyTolerance * report.energy[n - 1] &&
                       report.meanDisplacement[n - 2] < options.displacementTolerance * voxelSize;
}

} // namespace molsurf
