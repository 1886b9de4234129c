// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/stages.h"

#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/levelset/initial_surface.h"
#include "molsurf/levelset/redistance.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/levelset/thicken.h"
#include "molsurf/levelset/union_distance.h"
#include "molsurf/surface/warm_start.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

void Stopwatch::stop(const char* stage)
{
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    report_.addSeconds(stage, seconds);
}

namespace
{

/// psi and the level set of psi = 0.
NarrowBand gaussianBand(const GaussianSum& field, const Scope& scope, Progress& progress,
                        Stopwatch& watch)
{
    progress.update("density", 0.0);
    LeafTable table = field.band(bandWidthVox, progress, scope.region.grown(scope.flowHalo));
    if (table.size() == 0 && scope.region.whole()) {
        throw Error(ErrorKind::Numeric,
                    "density: no voxel lies inside the surface [hint: a smaller "
                    "`voxel`]");
    }
    progress.update("density", 0.6);
    SparseField psi = field.evaluate(std::move(table), progress);
    watch.stop("density");

    progress.update("initial", 0.0);
    SparseField phi = initialSurface(psi, bandWidthVox * psi.voxelSize, progress);
    watch.stop("initial");
    return {std::move(phi), std::move(psi.values)};
}

/// How far from the balls of a sum psi is wanted [Å]: stencils reach a voxel beyond the band, along
/// diagonals.
double gaussianReach(double voxel)
{
    return (bandWidthVox + 1.5) * voxel;
}

/// Adds to the surface of psi = 0 what the flow of the frame before added to its own.
/// @return the surface as it was
SparseField addCorrection(const WarmStart& warm, SparseField& phi, Progress& progress)
{
    constexpr int repairs = 2; // the sum is nearly a distance
    const float width = float(bandWidthVox * phi.voxelSize);
    SparseField cold = copied(phi);
    if (warm.empty()) return cold;
    const SparseField& correction = warm.state->correction;
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = correction.table.find(phi.table.origin(n));
        if (m == noLeaf) return;
        for (int v = 0; v < leafSize; ++v)
            phi.leaf(n)[v] = std::clamp(phi.leaf(n)[v] + correction.leaf(m)[v], -width, width);
    });
    reinitialize(phi, width, repairs, progress);
    return cold;
}

/// What the next frame wants: how far the flow went from `cold`, where both are known.
WarmStart correctionOf(const SparseField& cold, const SparseField& phi, Progress& progress)
{
    const float width = float(bandWidthVox * phi.voxelSize) * 0.999f;
    WarmStart warm;
    warm.state = std::make_unique<WarmStart::State>();
    SparseField& correction = warm.state->correction;
    correction = {phi.table, LeafField(phi.table.size()), phi.voxelSize};
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        float* out = correction.leaf(n);
        std::fill_n(out, leafSize, 0.0f);
        const std::int32_t m = cold.table.find(phi.table.origin(n));
        if (m == noLeaf) return;
        const float *from = cold.leaf(m), *to = phi.leaf(n);
        for (int v = 0; v < leafSize; ++v)
            if (std::abs(from[v]) < width && std::abs(to[v]) < width) out[v] = to[v] - from[v];
    });
    return warm;
}

/// The flow.
void evolveBand(const GaussianSum& field, const SurfaceOptions& options, const Scope& scope,
                NarrowBand& band, Progress& progress, Report& report, WarmStart* warm)
{
    const double h = options.voxel, reach = gaussianReach(h);
    SparseField cold;
    if (warm) cold = addCorrection(*warm, band.phi, progress);
    const auto source = [&](const openvdb::Coord& origin, float* psi) {
        field.evaluate(origin, reach, psi);
    };
    EvolveOptions evolution = options.evolution;
    evolution.splineLevel = options.splineLevel;
    report.evolution = evolve(band, source, evolution, progress, scope.region, scope.flowHalo);
    if (warm) *warm = correctionOf(cold, band.phi, progress);
    constexpr double noticeable = 0.1; // [voxel]
    if (report.evolution->converged && report.evolution->remainingWay > noticeable * h) {
        report.warnings.push_back(
            "evolve: the steps are small, but the interface still creeps [hint: a "
            "smaller `tolerance` and more `maxSteps`]");
    }
}

} // namespace

GaussianOptions gaussianOptions(const SurfaceOptions& options)
{
    const double h = options.voxel;
    if (options.kind == SurfaceKind::Gaussian)
        return {0.0, 0.0, options.blobbiness, h, gaussianReach(h)};
    return {options.probe, options.epsilon, 0.0, h, gaussianReach(h)};
}

NarrowBand makeBand(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
                    Progress& progress, Report& report, Stopwatch& watch, WarmStart* warm)
{
    if (isUnion(options.kind)) return NarrowBand();
    const bool evolves = options.kind == SurfaceKind::Variational;
    GaussianOptions gaussian = gaussianOptions(options);
    gaussian.extent = scope.extent;
    const GaussianSum field(atoms.balls, gaussian, evolves ? atoms.decays : std::vector<Decay>());
    NarrowBand band = gaussianBand(field, scope, progress, watch);
    if (evolves) {
        progress.update("evolve", 0.0);
        evolveBand(field, options, scope, band, progress, report, warm);
        watch.stop("evolve");
    }
    band.psi = LeafField();
    return band;
}

bool isUnion(SurfaceKind kind)
{
    return kind != SurfaceKind::Variational && kind != SurfaceKind::Gaussian;
}

double offsetOf(const SurfaceOptions& options)
{
    return options.kind == SurfaceKind::Variational || options.kind == SurfaceKind::SolventExcluded
               ? options.probe
               : 0.0;
}

double grownBy(const SurfaceOptions& options)
{
    return options.kind == SurfaceKind::VanDerWaals ? 0.0 : options.probe;
}

BandWidths widthsOf(const SurfaceOptions& options)
{
    const double h = options.voxel, width = splineWidthVox * h * (1 << options.splineLevel);
    const double offset = offsetOf(options);
    const double grown = 0.5 * options.minWall;
    return {offset + width + grown, std::max(width - offset, h) + grown};
}

namespace
{

/// From the distance to the set that a surface is offset from.
DistanceBand offsetBand(DistanceBand S, const SurfaceOptions& options, Progress& progress)
{
    const double h = options.voxel, offset = offsetOf(options);
    if (offset > 0.0) {
        parallelFor(S.phi.table.size(), progress, [&](std::size_t n) {
            for (int v = 0; v < leafSize; ++v) S.phi.leaf(n)[v] += float(offset);
        });
    }
    if (options.minWall > 0.0) {
        const double width = splineWidthVox * h * (1 << options.splineLevel);
        thickenWalls(S, options.minWall, width, progress);
    }
    return S;
}

} // namespace

DistanceBand distanceBand(SparseField phi, const SurfaceOptions& options, const Scope& scope,
                          Progress& progress)
{
    return offsetBand(redistance(std::move(phi), widthsOf(options), -offsetOf(options), progress,
                                 scope.region.grown(scope.splineHalo)),
                      options, progress);
}

DistanceBand distanceBand(BallUnion set, const SurfaceOptions& options, const Scope& scope,
                          Progress& progress)
{
    return offsetBand(distanceToUnion(std::move(set), options.voxel, widthsOf(options), progress,
                                      scope.region.grown(scope.splineHalo)),
                      options, progress);
}

void resample(SparseField& S, const Spline& spline, Progress& progress)
{
    const float width = float(splineWidthVox * S.voxelSize);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        LeafMask near;
        S.table.active(n).forEach([&](int v) {
            float& value = S.leaf(n)[v];
            if (std::abs(value) >= width) return;
            const openvdb::Coord ijk = S.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            value = float(sampler.at(ijk.asVec3d() * S.voxelSize).value);
            near.set(v);
        });
        S.table.active(n) = near;
    });
}

openvdb::FloatGrid::Ptr surfaceGrid(SparseField S, const Scope& scope, Progress& progress)
{
    const double width = surfaceWidthVox * S.voxelSize;
    parallelFor(S.table.size(), progress,
                [&](std::size_t n) { S.table.active(n) &= within(S.leaf(n), float(width)); });
    // Two voxels outward from where sheets of S meet: farther out few of them are still wrong.
    reinitialize(S, width, 4, progress);
    // A leaf inside the cut, values are those of the whole surface.
    S = clipped(std::move(S), scope.region.grown(scope.splineHalo - 1), progress);
    auto grid = toLevelSet(S, width, progress);
    grid->setName("surface");
    return grid;
}

GradientCounts countGradients(const Mesh& mesh, const std::vector<float>& slopes,
                              const LeafTable& kinks, double voxelSize, Progress& progress)
{
    constexpr int kinkVox = 2;
    constexpr double gradientTolerance = 0.03;
    const LeafTable nearKinks = dilated(kinks, kinkVox, Spread::Ball, progress);

    constexpr std::size_t chunk = 512;
    const std::size_t vertices = slopes.size();
    const auto count = [&](std::size_t c) {
        GradientCounts sum;
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
            const openvdb::Vec3d x(mesh.positions[v]);
            const openvdb::Coord near = openvdb::Coord::round(x / voxelSize);
            const std::int32_t n = nearKinks.find(near);
            const bool kink =
                n != noLeaf &&
                nearKinks.active(n).on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(near)));
            sum += {std::size_t(kink),
                    std::size_t(!kink && std::abs(slopes[v] - 1.0f) < gradientTolerance)};
        }
        return sum;
    };
    return parallelSum<GradientCounts>((vertices + chunk - 1) / chunk, progress, count);
}

GaussianExtent extentOf(const BallSet& atoms, const SurfaceOptions& options)
{
    return extentOf(atoms.balls, gaussianOptions(options),
                    options.kind == SurfaceKind::Variational ? atoms.decays : std::vector<Decay>());
}

double labelReach(const BallSet& atoms, const SurfaceOptions& options)
{
    // Points of the surface lie within a probe radius and the tolerance's swelling of their atom.
    return 2.0 * options.probe + 4.0 * extentOf(atoms, options).tolerance + 4.0 * options.voxel +
           options.minWall;
}

} // namespace molsurf
