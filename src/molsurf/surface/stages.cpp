// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/stages.h"

#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/levelset/carrier.h"
#include "molsurf/levelset/initial_surface.h"
#include "molsurf/levelset/redistance.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/levelset/round_ridges.h"
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
NarrowBand gaussianBand(const GaussianSum& field, double voxel, const Scope& scope,
                        Progress& progress, Stopwatch& watch)
{
    progress.update("density", 0.0);
    NarrowBand band;
    band.table = field.band(bandWidthVox, progress, scope.region.grown(scope.flowHalo));
    if (band.table.size() == 0) {
        if (!scope.region.whole()) return band;
        throw Error(ErrorKind::Numeric,
                    "density: no voxel lies inside the surface [hint: a smaller "
                    "`voxel`]");
    }
    progress.update("density", 0.6);
    band.psi = field.evaluate(band.table, progress);
    watch.stop("density");

    progress.update("initial", 0.0);
    band.phi = initialSurface(band.table, band.psi, voxel, bandWidthVox * voxel, progress);
    watch.stop("initial");
    return band;
}

/// How far from the balls of a sum psi is wanted [Å]: stencils reach a voxel beyond the band, along
/// diagonals.
double gaussianReach(double voxel)
{
    return (bandWidthVox + 1.5) * voxel;
}

/// Adds to the surface of psi = 0 what the flow of the frame before added to its own, and keeps it
/// as it was in `cold`.
void addCorrection(const WarmStart& warm, double voxel, NarrowBand& band, LeafField& cold,
                   Progress& progress)
{
    constexpr int repairs = 2; // the sum is nearly a distance
    const float width = float(bandWidthVox * voxel);
    cold = LeafField(band.table.size());
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        float* phi = band.phi.leaf(n);
        std::copy_n(phi, leafSize, cold.leaf(n));
        const std::int32_t m = warm.empty() ? noLeaf : warm.state->table.find(band.table.origin(n));
        if (m == noLeaf) return;
        const float* correction = warm.state->correction.leaf(m);
        for (int v = 0; v < leafSize; ++v)
            phi[v] = std::clamp(phi[v] + correction[v], -width, width);
    });
    if (warm.empty()) return;
    LeafField scratch;
    reinitialize(band.table, band.phi, voxel, width, repairs, scratch, progress);
}

/// What the next frame wants: how far the flow went from `cold`, where both are known.
WarmStart correctionOf(const LeafTable& before, const LeafField& cold, const NarrowBand& band,
                       double voxel, Progress& progress)
{
    const float width = float(bandWidthVox * voxel) * 0.999f;
    WarmStart warm;
    warm.state = std::make_unique<WarmStart::State>();
    warm.state->table = band.table;
    warm.state->correction = LeafField(band.table.size());
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        float* out = warm.state->correction.leaf(n);
        std::fill_n(out, leafSize, 0.0f);
        const std::int32_t m = before.find(band.table.origin(n));
        if (m == noLeaf) return;
        const float *from = cold.leaf(m), *to = band.phi.leaf(n);
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
    const LeafTable before = band.table;
    LeafField cold;
    if (warm) addCorrection(*warm, h, band, cold, progress);
    const auto source = [&](const openvdb::Coord& origin, float* psi) {
        field.evaluate(origin, reach, psi);
    };
    EvolveOptions evolution = options.evolution;
    evolution.splineLevel = options.splineLevel;
    report.evolution = evolve(band, source, h, evolution, progress, scope.region, scope.flowHalo);
    if (warm) *warm = correctionOf(before, cold, band, h, progress);
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
    NarrowBand band = gaussianBand(field, options.voxel, scope, progress, watch);
    if (evolves) {
        progress.update("evolve", 0.0);
        evolveBand(field, options, scope, band, progress, report, warm);
        watch.stop("evolve");
    }
    return band;
}

namespace
{

/// |grad psi| on the surface of each ball alone [1/Å].
std::vector<double> slopesOf(const std::vector<Ball>& balls, const GaussianOptions& options,
                             const std::vector<Decay>& decays)
{
    std::vector<double> slopes;
    slopes.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        slopes.push_back(2.0 * rateOf(balls[i], options, decays.empty() ? 0.0 : decays[i].rate) *
                         (balls[i].radius + options.probe));
    return slopes;
}

/// The slopes of the balls, at each voxel weighted by their terms of the sum: psi of the sum with
/// the slopes as factors, less psi.
LeafField slopeField(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
                     const NarrowBand& band, Progress& progress)
{
    GaussianOptions gaussian = gaussianOptions(options);
    std::vector<Decay> decays =
        options.kind == SurfaceKind::Variational ? atoms.decays : std::vector<Decay>();
    const std::vector<double> slopes = slopesOf(atoms.balls, gaussian, decays);
    LeafField out(band.table.size());
    const auto [least, most] = std::minmax_element(slopes.begin(), slopes.end());
    if (*most - *least < 1e-4 * *most) {
        parallelFor(band.table.size(), progress,
                    [&](std::size_t n) { std::fill_n(out.leaf(n), leafSize, float(*most)); });
        return out;
    }
    gaussian.extent = scope.extent ? scope.extent : extentOf(atoms.balls, gaussian, decays);
    decays.resize(atoms.balls.size());
    for (std::size_t i = 0; i < slopes.size(); ++i)
        decays[i].level += float(std::log(slopes[i] / *most));
    const LeafField weighted =
        GaussianSum(atoms.balls, gaussian, decays).evaluate(band.table, progress);
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        const float *w = weighted.leaf(n), *psi = band.psi.leaf(n);
        for (int v = 0; v < leafSize; ++v)
            out.leaf(n)[v] =
                std::clamp(float(*most) * std::exp(w[v] - psi[v]), float(*least), float(*most));
    });
    return out;
}

} // namespace

LeafField carrierOf(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
                    const NarrowBand& band, Progress& progress)
{
    const double h = options.voxel, width = bandWidthVox * h;
    const LeafField slope = slopeField(atoms, options, scope, band, progress);
    const EvolveOptions& evolution = options.evolution;
    const bool valley =
        options.kind == SurfaceKind::Variational && evolution.regularizer == Regularizer::Gradient;
    return smoothCarrier(band.table, band.phi, {band.psi, slope, valley ? evolution.lambda : 0.0},
                         h, width, progress);
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

Depth depthOf(const SurfaceOptions& options)
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
        parallelFor(S.table.size(), progress, [&](std::size_t n) {
            for (int v = 0; v < leafSize; ++v) S.phi.leaf(n)[v] += float(offset);
        });
    }
    if (options.kind == SurfaceKind::Variational) roundRidges(S, h, progress);
    if (options.minWall > 0.0) {
        const double width = splineWidthVox * h * (1 << options.splineLevel);
        thickenWalls(S, h, options.minWall, width, progress);
    }
    return S;
}

} // namespace

DistanceBand distanceBand(const LeafTable& table, LeafField phi, const SurfaceOptions& options,
                          const Scope& scope, Progress& progress)
{
    const auto [inside, outside] = depthOf(options);
    return offsetBand(redistance(table, std::move(phi), options.voxel, inside, outside,
                                 -offsetOf(options), progress, scope.region.grown(scope.ridgeHalo)),
                      options, progress);
}

DistanceBand distanceBand(const std::vector<Ball>& balls, BallBoundary boundary,
                          const SurfaceOptions& options, const Scope& scope, Progress& progress)
{
    const auto [inside, outside] = depthOf(options);
    return offsetBand(distanceToUnion(balls, grownBy(options), std::move(boundary), options.voxel,
                                      inside, outside, progress,
                                      scope.region.grown(scope.ridgeHalo)),
                      options, progress);
}

void resample(DistanceBand& S, const Spline& spline, double voxel, Progress& progress)
{
    const float width = float(splineWidthVox * voxel);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        LeafMask near;
        S.table.active(n).forEach([&](int v) {
            float& value = S.phi.leaf(n)[v];
            if (std::abs(value) >= width) return;
            const openvdb::Coord ijk = S.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            value = float(sampler.at(ijk.asVec3d() * voxel).value);
            near.set(v);
        });
        S.table.active(n) = near;
    });
}

openvdb::FloatGrid::Ptr surfaceGrid(LeafTable table, LeafField phi, double voxel,
                                    const Scope& scope, Progress& progress)
{
    const double width = surfaceWidthVox * voxel;
    parallelFor(table.size(), progress,
                [&](std::size_t n) { table.active(n) &= within(phi.leaf(n), float(width)); });
    // Two voxels outward from where sheets of S meet: farther out few of them are still wrong.
    LeafField scratch;
    reinitialize(table, phi, voxel, width, 4, scratch, progress);
    if (!scope.region.whole()) {
        // A leaf inside the cut, values are those of the whole surface.
        const LeafTable inner = clipped(table, scope.region.grown(scope.splineHalo - 1));
        phi = restricted(table, phi, inner, progress);
        table = inner;
    }
    auto grid = toLevelSet(table, phi, width, voxel, progress);
    grid->setName("surface");
    return grid;
}

GradientCounts countGradients(const Mesh& mesh, const std::vector<float>& slopes,
                              std::size_t vertices, const DistanceBand& S, double voxel,
                              Progress& progress)
{
    constexpr int kinkVox = 2;
    constexpr double gradientTolerance = 0.03;
    LeafTable kinks = S.table;
    for (std::size_t n = 0; n < kinks.size(); ++n) kinks.active(n) = S.kinks[n];
    kinks = dilated(kinks, kinkVox, Spread::Ball, progress);

    constexpr std::size_t chunk = 512;
    const auto count = [&](std::size_t c) {
        GradientCounts sum;
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
            const openvdb::Vec3d x(mesh.positions[v]);
            const openvdb::Coord near = openvdb::Coord::round(x / voxel);
            const std::int32_t n = kinks.find(near);
            const bool kink =
                n != noLeaf &&
                kinks.active(n).on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(near)));
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
