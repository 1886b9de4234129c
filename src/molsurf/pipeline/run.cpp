// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pipeline/run.h"

#include "molsurf/bspline/fit.h"
#include "molsurf/core/error.h"
#include "molsurf/core/parallel.h"
#include "molsurf/evolution/evolve.h"
#include "molsurf/levelset/cavities.h"
#include "molsurf/levelset/initial_surface.h"
#include "molsurf/levelset/redistance.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/levelset/thicken.h"
#include "molsurf/pipeline/curvature_colors.h"
#include "molsurf/pipeline/fields.h"
#include "molsurf/pipeline/interfaces.h"
#include "molsurf/pipeline/label_surface.h"
#include "molsurf/pipeline/match_volume.h"
#include "molsurf/pipeline/parts.h"
#include "molsurf/rasterize/boundary_measure.h"
#include "molsurf/rasterize/gaussian_sum.h"
#include "molsurf/rasterize/union_distance.h"
#include "molsurf/surface/extract.h"
#include "molsurf/surface/integrate.h"
#include "molsurf/surface/measure.h"
#include "molsurf/surface/statistics.h"
#include "molsurf/surface/topology.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace molsurf
{

namespace
{

/// Half width of the grid `surface` [voxel].
constexpr double surfaceWidthVox = 3.0;

/// How far from S = 0 the spline needs samples [voxel]: the corners of the 4^3 coefficients about a
/// point are up to 2 sqrt(3) away.
constexpr double splineWidthVox = 4.0;

/// Wall seconds of the stages, in their order; a stage may come more than once.
class Stopwatch
{
public:
    explicit Stopwatch(Report& report) : report_(report) {}
    void stop(const char* stage)
    {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        for (auto& [name, sum] : report_.seconds) {
            if (name != stage) continue;
            sum += seconds;
            return;
        }
        report_.seconds.emplace_back(stage, seconds);
    }

private:
    using Clock = std::chrono::steady_clock;
    Report& report_;
    Clock::time_point start_ = Clock::now();
};

/// psi and the level set of psi = 0.
NarrowBand gaussianBand(const GaussianSum& field, double voxel, Progress& progress,
                        Stopwatch& watch)
{
    progress.update("density", 0.0);
    NarrowBand band;
    band.table = field.band(bandWidthVox, progress);
    if (band.table.size() == 0) {
        throw Error(ErrorKind::Numeric,
                    "density: no voxel lies inside the surface [hint: a smaller "
                    "--voxel]");
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
        const std::int32_t m = warm.table.find(band.table.origin(n));
        if (m == noLeaf) return;
        const float* correction = warm.correction.leaf(m);
        for (int v = 0; v < leafSize; ++v)
            phi[v] = std::clamp(phi[v] + correction[v], -width, width);
    });
    if (warm.table.size() == 0) return;
    LeafField scratch;
    reinitialize(band.table, band.phi, voxel, width, repairs, scratch, progress);
}

/// What the next frame wants: how far the flow went from `cold`, where both are known.
WarmStart correctionOf(const LeafTable& before, const LeafField& cold, const NarrowBand& band,
                       double voxel, Progress& progress)
{
    const float width = float(bandWidthVox * voxel) * 0.999f;
    WarmStart warm;
    warm.table = band.table;
    warm.correction = LeafField(band.table.size());
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        float* out = warm.correction.leaf(n);
        std::fill_n(out, leafSize, 0.0f);
        const std::int32_t m = before.find(band.table.origin(n));
        if (m == noLeaf) return;
        const float *from = cold.leaf(m), *to = band.phi.leaf(n);
        for (int v = 0; v < leafSize; ++v)
            if (std::abs(from[v]) < width && std::abs(to[v]) < width) out[v] = to[v] - from[v];
    });
    return warm;
}

/// The initial level set and the flow.
NarrowBand evolveSurface(const BallSelection& atoms, const Options& options, Progress& progress,
                         Report& report, Stopwatch& watch, WarmStart* warm)
{
    const double h = options.voxel, reach = gaussianReach(h);
    const GaussianSum field(atoms.balls, {options.probe, options.epsilon, 0.0, h, reach},
                            atoms.decays);
    NarrowBand band = gaussianBand(field, h, progress, watch);
    const LeafTable before = band.table;
    LeafField cold;
    if (warm) addCorrection(*warm, h, band, cold, progress);

    progress.update("evolve", 0.0);
    const auto source = [&](const openvdb::Coord& origin, float* psi) {
        field.evaluate(origin, reach, psi);
    };
    EvolveOptions evolution = options.evolution;
    evolution.splineLevel = options.splineLevel;
    report.evolution = evolve(band, source, h, evolution, progress);
    if (warm) *warm = correctionOf(before, cold, band, h, progress);
    watch.stop("evolve");
    constexpr double noticeable = 0.1; // [voxel]
    if (report.evolution->converged && report.evolution->remainingWay > noticeable * h) {
        report.warnings.push_back(
            "evolve: the steps are small, but the interface still creeps [hint: a "
            "smaller --tolerance and more --max-steps]");
    }
    return band;
}

/// The level set that a smooth surface is offset from; empty for surfaces of a union of balls.
NarrowBand makeBand(const BallSelection& atoms, const Options& options, Progress& progress,
                    Report& report, Stopwatch& watch, WarmStart* warm)
{
    switch (options.kind) {
    case SurfaceKind::Variational: {
        NarrowBand band = evolveSurface(atoms, options, progress, report, watch, warm);
        band.psi = LeafField();
        return band;
    }
    case SurfaceKind::Gaussian: {
        const double h = options.voxel;
        const GaussianSum field(atoms.balls, {0.0, 0.0, options.blobbiness, h, gaussianReach(h)});
        NarrowBand band = gaussianBand(field, h, progress, watch);
        band.psi = LeafField();
        return band;
    }
    default:
        return NarrowBand();
    }
}

/// How far the surface lies inside the set whose distance is known [Å].
double offsetOf(const Options& options)
{
    return options.kind == SurfaceKind::Variational || options.kind == SurfaceKind::SolventExcluded
               ? options.probe
               : 0.0;
}

/// The probe that the balls of a union surface are grown by [Å].
double grownBy(const Options& options)
{
    return options.kind == SurfaceKind::VanDerWaals ? 0.0 : options.probe;
}

/// S = Phi + r_b on a band that holds the coefficients of every point of the surface.
DistanceBand distanceBand(const std::vector<Ball>& balls, const NarrowBand& band,
                          const Options& options, Progress& progress)
{
    const double h = options.voxel, width = splineWidthVox * h * (1 << options.splineLevel);
    const double offset = offsetOf(options);
    const double grown = 0.5 * options.minWall;
    const double inside = offset + width + grown, outside = std::max(width - offset, h) + grown;
    DistanceBand S;
    if (options.kind == SurfaceKind::Variational || options.kind == SurfaceKind::Gaussian) {
        S = redistance(band.table, band.phi, h, inside, outside, -offset, progress);
    } else {
        const double probe = grownBy(options);
        const BallBoundary boundary = ballBoundary(balls, probe, progress);
        S = distanceToUnion(balls, probe, boundary, h, inside, outside, progress);
    }
    if (offset > 0.0) {
        parallelFor(S.table.size(), progress, [&](std::size_t n) {
            for (int v = 0; v < leafSize; ++v) S.phi.leaf(n)[v] += float(offset);
        });
    }
    if (options.minWall > 0.0) thickenWalls(S, h, options.minWall, width, progress);
    return S;
}

/// Replaces S near its zero set by the values of a coarser spline, so that signs and values agree
/// with it.
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

/// The voxels of the cavities of a surface.
/// @param[in] mesh  of S = 0
/// @return one mask a leaf of S; empty if there are none
std::vector<LeafMask> cavityVoxels(const Mesh& mesh, const DistanceBand& S, double voxel)
{
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count);
    const std::vector<double> volumes = pieceVolumes(mesh, pieces, count);

    // Outer voxels of S about the walls, then all that hang together with them.
    std::vector<LeafMask> positive(S.table.size()), seeds(S.table.size());
    for (std::size_t n = 0; n < S.table.size(); ++n) {
        positive[n] = ~lessThan(S.phi.leaf(n), 0.0f);
    }
    bool any = false;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (volumes[pieces[i]] >= 0.0) continue;
        any = true;
        const openvdb::Coord cell =
            openvdb::Coord::floor(openvdb::Vec3d(mesh.positions[i]) / voxel);
        for (int k = 0; k < 8; ++k) {
            const openvdb::Coord corner = cell.offsetBy(k >> 2, k >> 1 & 1, k & 1);
            const std::int32_t n = S.table.find(corner);
            if (n != noLeaf)
                seeds[n].set(int(openvdb::FloatTree::LeafNodeType::coordToOffset(corner)));
        }
    }
    if (!any) return {};
    return connectedTo(S.table, positive, seeds);
}

/// Makes voxels inner ones, and the level set a distance again.
void turnInside(const LeafTable& table, const std::vector<LeafMask>& voxels, double voxel,
                double width, LeafField& phi, Progress& progress)
{
    for (std::size_t n = 0; n < table.size(); ++n) {
        voxels[n].forEach([&](int v) { phi.leaf(n)[v] = float(-width); });
    }
    LeafField scratch;
    reinitialize(table, phi, voxel, width, int(std::ceil(2.0 * width / voxel)), scratch, progress);
}

/// Closes the cavities of a surface in the level set that it was offset from, which holds them.
void fillCavities(const std::vector<LeafMask>& cavities, const DistanceBand& S, double voxel,
                  NarrowBand& band, Progress& progress)
{
    std::vector<LeafMask> outside(band.table.size()), start(band.table.size());
    for (std::size_t n = 0; n < band.table.size(); ++n) {
        outside[n] = ~lessThan(band.phi.leaf(n), 0.0f);
        const std::int32_t m = S.table.find(band.table.origin(n));
        if (m != noLeaf) start[n] = cavities[m];
    }
    turnInside(band.table, connectedTo(band.table, outside, start), voxel, bandWidthVox * voxel,
               band.phi, progress);
}

/// Closes the cavities of a surface in its own distance, which changes about them alone.
void fillCavities(const std::vector<LeafMask>& cavities, double voxel, DistanceBand& S,
                  Progress& progress)
{
    LeafField filled(S.table.size());
    parallelFor(S.table.size(), progress,
                [&](std::size_t n) { std::copy_n(S.phi.leaf(n), leafSize, filled.leaf(n)); });
    turnInside(S.table, cavities, voxel, splineWidthVox * voxel, filled, progress);
    LeafTable about = S.table;
    for (std::size_t n = 0; n < about.size(); ++n) about.active(n) = cavities[n];
    about = dilated(about, 2 * int(splineWidthVox), Spread::Ball, progress);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = about.find(S.table.origin(n));
        if (m == noLeaf) return;
        about.active(m).forEach([&](int v) { S.phi.leaf(n)[v] = filled.leaf(n)[v]; });
    });
}

/// The level set grid: S made a distance on both sides.
openvdb::FloatGrid::Ptr surfaceGrid(const DistanceBand& S, double voxel, Progress& progress)
{
    const double width = surfaceWidthVox * voxel;
    LeafTable table = S.table;
    LeafField phi(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        std::copy_n(S.phi.leaf(n), leafSize, phi.leaf(n));
        table.active(n) &= within(phi.leaf(n), float(width));
    });
    // Two voxels outward from where sheets of S meet: farther out few of them are still wrong.
    LeafField scratch;
    reinitialize(table, phi, voxel, width, 4, scratch, progress);
    auto grid = toLevelSet(table, phi, width, voxel, progress);
    grid->setName("surface");
    return grid;
}

/// Replaces area, volume and pieces by those of the union of balls itself. A mesh bridges what is
/// narrower than a voxel: creases and small cavities.
void measureExactly(const std::vector<Ball>& balls, const Options& options, Progress& progress,
                    Report& report)
{
    const BallBoundary boundary = ballBoundary(balls, grownBy(options), progress);
    SurfaceReport& s = report.surface;
    const std::size_t shown = s.cavities.size();
    s.area = s.volume = s.outerArea = s.outerVolume = 0.0;
    s.components = 0;
    s.cavities.clear();
    for (const BoundaryPiece& piece : measureBoundary(boundary, progress).pieces) {
        const bool cavity = piece.volume < 0.0;
        if (cavity && options.fillCavities) continue;
        s.area += piece.area;
        s.volume += piece.volume;
        if (cavity) {
            s.cavities.push_back({piece.area, -piece.volume});
        } else {
            ++s.components;
            s.outerArea += piece.area;
            s.outerVolume += piece.volume;
        }
    }
    std::stable_sort(s.cavities.begin(), s.cavities.end(),
                     [](const Cavity& a, const Cavity& b) { return a.volume > b.volume; });
    if (!options.fillCavities && shown != s.cavities.size()) {
        report.warnings.push_back("mesh: " + std::to_string(shown) + " inner walls for " +
                                  std::to_string(s.cavities.size()) +
                                  " cavities, for want of voxels [hint: a smaller --voxel]");
    }
}

/// Shares of the vertices near kinks, and of the others with a unit gradient.
void checkGradient(const Mesh& mesh, const std::vector<float>& slopes, const DistanceBand& S,
                   double voxel, Progress& progress, SurfaceReport& report)
{
    constexpr int kinkVox = 2;
    constexpr double gradientTolerance = 0.03;
    LeafTable kinks = S.table;
    for (std::size_t n = 0; n < kinks.size(); ++n) kinks.active(n) = S.kinks[n];
    kinks = dilated(kinks, kinkVox, Spread::Ball, progress);

    struct Counts {
        std::size_t kink = 0, unit = 0;
        Counts& operator+=(const Counts& o)
        {
            kink += o.kink;
            unit += o.unit;
            return *this;
        }
    };
    constexpr std::size_t chunk = 512;
    const std::size_t vertices = mesh.positions.size();
    const Counts counts =
        parallelSum<Counts>((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
            Counts sum;
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
        });
    report.kinkShare = vertices ? double(counts.kink) / vertices : 0.0;
    report.gradientShare = double(counts.unit) / double(vertices - counts.kink); // may be 0/0
}

/// Statistics and integrals of the curvatures.
void describeCurvature(const Mesh& mesh, const Spline& spline, const Options& options,
                       Progress& progress, SurfaceReport& report)
{
    const std::vector<float> areas = vertexAreas(mesh);
    report.meanCurvature = statistics(mesh.scalars[0].values, areas);
    report.gaussianCurvature = statistics(mesh.scalars[1].values, areas);
    if (!options.curvatureIntegrals) return;
    constexpr double tolerance = 5.0; // for each unit of the Euler characteristic [sr]
    const int chi = std::max(std::abs(report.eulerCharacteristic), 2);
    report.integrals = integrateSurface(mesh, spline, tolerance * chi, progress);
}

/// The surface of all balls.
Result runWhole(const BallSelection& atoms, const Options& options, Progress& progress,
                WarmStart* warm)
{
    const std::vector<Ball>& balls = atoms.balls;
    Result result;
    Report& report = result.report;
    Stopwatch watch(report);

    NarrowBand band = makeBand(atoms, options, progress, report, watch, warm);
    const bool unionOfBalls = band.table.size() == 0;
    const auto wanted = [&](const char* field) {
        return std::find(options.fields.begin(), options.fields.end(), field) !=
               options.fields.end();
    };

    DistanceBand S;
    Spline spline;
    ExtractStats stats;
    for (bool filled = false;; filled = true) {
        progress.update("redistance", 0.0);
        if (!filled || !unionOfBalls) S = distanceBand(balls, band, options, progress);
        if (!options.fillCavities && !wanted("sas")) band = NarrowBand();
        watch.stop("redistance");

        progress.update("spline", 0.0);
        spline = fitSpline(S.table, S.phi, options.voxel, options.splineLevel, progress);
        if (options.splineLevel > 0) resample(S, spline, options.voxel, progress);
        watch.stop("spline");

        progress.update("redistance", 0.6);
        result.surface = surfaceGrid(S, options.voxel, progress);
        watch.stop("redistance");

        progress.update("mesh", 0.0);
        stats = ExtractStats();
        result.mesh = extractMesh(*result.surface, spline, progress, stats);
        if (result.mesh.triangles.empty()) {
            throw Error(ErrorKind::Numeric,
                        "mesh: nothing of the molecule is left at this resolution [hint: a smaller "
                        "--voxel, --lambda or --epsilon]");
        }
        if (filled || !options.fillCavities) break;
        const std::vector<LeafMask> cavities = cavityVoxels(result.mesh, S, options.voxel);
        if (cavities.empty()) break;
        if (unionOfBalls) {
            fillCavities(cavities, options.voxel, S, progress);
        } else {
            fillCavities(cavities, S, options.voxel, band, progress);
        }
    }

    progress.update("mesh", 0.7);
    report.surface = measure(result.mesh, progress);
    if (!report.surface.manifold && splitNonManifold(result.mesh) > 0) {
        report.surface = measure(result.mesh, progress);
    }
    report.surface.kind = nameOf(options.kind);
    if (unionOfBalls && offsetOf(options) == 0.0 && options.minWall == 0.0)
        measureExactly(balls, options, progress, report);
    report.surface.maxResidual = stats.maxResidual;
    checkGradient(result.mesh, stats.slopes, S, options.voxel, progress, report.surface);
    addCurvature(spline, options.fields, result.mesh, progress);
    describeCurvature(result.mesh, spline, options, progress, report.surface);
    watch.stop("mesh");

    if (wanted("sas")) {
        const double width = surfaceWidthVox * options.voxel;
        if (options.kind != SurfaceKind::Variational) {
            DistanceBand exact =
                distanceToUnion(balls, options.probe, ballBoundary(balls, options.probe, progress),
                                options.voxel, width, width, progress);
            band.table = std::move(exact.table);
            band.phi = std::move(exact.phi);
        }
        auto sas = toLevelSet(band.table, band.phi, width, options.voxel, progress);
        sas->setName("sas");
        result.fields.push_back(sas);
    }
    if (wanted("spline")) result.fields.push_back(splineGrid(spline));
    for (auto& grid : curvatureGrids(*result.surface, spline, options.fields, progress))
        result.fields.push_back(std::move(grid));
    if (wanted("density")) result.fields.push_back(densityGrid(*result.surface));
    progress.update("color", 0.0);
    labelSurface(atoms, options, labelReach(atoms, options), progress, result);
    watch.stop("color");

    report.activeVoxels = result.surface->activeVoxelCount();
    report.gridBytes = result.surface->memUsage();
    return result;
}

} // namespace

double largestTolerance(const BallSelection& atoms, const Options& options)
{
    double largest = options.epsilon;
    for (std::size_t i = 0; i < atoms.decays.size(); ++i) {
        if (atoms.decays[i].rate <= 0.0f) continue;
        const double R = atoms.balls[i].radius + options.probe;
        largest = std::max(largest, M_LN2 / (atoms.decays[i].rate * R));
    }
    return largest;
}

double labelReach(const BallSelection& atoms, const Options& options)
{
    // Points of the surface lie within a probe radius and the tolerance's swelling of their atom.
    return 2.0 * options.probe + 4.0 * largestTolerance(atoms, options) + 4.0 * options.voxel +
           options.minWall;
}

Result run(const std::vector<Ball>& balls, const Options& options, Progress& progress)
{
    BallSelection atoms;
    atoms.balls = balls;
    return run(atoms, options, progress);
}

Result run(const BallSelection& atoms, const Options& options, Progress& progress, WarmStart* warm)
{
    checkOptions(options);
    if (options.matchVolume && !atoms.resolutions.empty()) {
        BallSelection matched = atoms;
        Options once = options;
        once.matchVolume = false;
        progress.update("match", 0.0);
        matchVolumes(matched, once, progress);
        return run(matched, once, progress, warm);
    }
    if (atoms.balls.empty()) throw Error(ErrorKind::Input, "no atoms");
    const bool whole = !options.split && options.surfaceOf.empty();
    if ((!whole || options.interfaces) && (!atoms.labels || atoms.labels->groups.empty())) {
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
    }
    const auto asked = [&](const char* field) {
        return std::find(options.fields.begin(), options.fields.end(), field) !=
               options.fields.end();
    };
    const char* shown = asked("Cd") ? curvatureNameOf(options.color) : nullptr;
    const bool helps = shown && !asked(shown);
    Options wanted = options;
    if (helps) wanted.fields.push_back(shown);
    Result result =
        whole ? runWhole(atoms, wanted, progress, warm) : runParts(atoms, wanted, progress);
    if (shown) addCurvatureColors(options.color, !helps, result);
    Report& report = result.report;
    report.atoms = atoms.balls.size();
    report.voxel = options.voxel;
    if (atoms.beads > 0) report.coarse = CoarseReport{atoms.beads, atoms.beadAtoms};
    for (const ResolutionGroup& group : atoms.resolutions) {
        report.resolutions.push_back(
            {group.rule.select, group.rule.resolution, group.balls, group.level});
    }
    if (options.interfaces) measureInterfaces(atoms, options, progress, report);
    return result;
}

} // namespace molsurf
