// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/warm_start.h"

#include "molsurf/balls/boundary_check.h"
#include "molsurf/balls/boundary_measure.h"
#include "molsurf/color/curvature_colors.h"
#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/levelset/cavities.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/levelset/thicken.h"
#include "molsurf/levelset/union_distance.h"
#include "molsurf/mesh/extract.h"
#include "molsurf/mesh/integrate.h"
#include "molsurf/mesh/measure.h"
#include "molsurf/mesh/statistics.h"
#include "molsurf/mesh/topology.h"
#include "molsurf/spline/fit.h"
#include "molsurf/surface/check_balls.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/interfaces.h"
#include "molsurf/surface/label_surface.h"
#include "molsurf/surface/match_volume.h"
#include "molsurf/surface/parts.h"
#include "molsurf/surface/stages.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// The voxels of the cavities of a surface.
/// @param[in] mesh  of S = 0
/// @return one mask a leaf of S; empty if there are none
std::vector<LeafMask> cavityVoxels(const Mesh& mesh, const SparseField& S, const Progress& progress)
{
    std::size_t count = 0;
    const std::vector<std::uint32_t> pieces = connectedPieces(mesh, count, progress);
    const std::vector<double> volumes = pieceVolumes(mesh, pieces, count);

    // Outer voxels of S in front of the walls, then all that hang together with them. Those that
    // hang together with the outer surface, where a wall is thinner than a voxel, are no cavity.
    std::vector<LeafMask> positive(S.table.size()), walls(S.table.size()), skin(S.table.size());
    for (std::size_t n = 0; n < S.table.size(); ++n) {
        positive[n] = ~lessThan(S.leaf(n), 0.0f);
    }
    bool any = false;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool cavity = volumes[pieces[i]] < 0.0;
        any = any || cavity;
        const openvdb::Vec3d x = openvdb::Vec3d(mesh.positions[i]) / S.voxelSize;
        const openvdb::Coord cell = openvdb::Coord::floor(x);
        for (int k = 0; k < 8; ++k) {
            const openvdb::Coord corner = cell.offsetBy(k >> 2, k >> 1 & 1, k & 1);
            if ((corner.asVec3d() - x).dot(openvdb::Vec3d(mesh.normals[i])) <= 0.0) continue;
            const std::int32_t n = S.table.find(corner);
            if (n != noLeaf)
                (cavity ? walls : skin)[std::size_t(n)].set(
                    int(openvdb::FloatTree::LeafNodeType::coordToOffset(corner)));
        }
    }
    if (!any) return {};
    std::vector<LeafMask> cavities = connectedTo(S.table, positive, walls);
    const std::vector<LeafMask> exterior = connectedTo(S.table, positive, skin);
    for (std::size_t n = 0; n < cavities.size(); ++n) cavities[n] &= ~exterior[n];
    return cavities;
}

/// Makes voxels inner ones, and the level set a distance again.
/// @param[in] voxels  one mask a leaf
/// @param[in] width   half width of the level set's band [Å]
void fillVoxels(const std::vector<LeafMask>& voxels, double width, SparseField& phi,
                Progress& progress)
{
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        voxels[n].forEach([&](int v) { phi.leaf(n)[v] = float(-width); });
    }
    reinitialize(phi, width, int(std::ceil(2.0 * width / phi.voxelSize)), progress);
}

/// Closes the cavities of a surface in the level set that it was offset from, which holds them.
/// @param[in] cavities  one mask a leaf of S
void fillCavities(const std::vector<LeafMask>& cavities, const LeafTable& S, SparseField& phi,
                  Progress& progress)
{
    std::vector<LeafMask> outside(phi.table.size()), start(phi.table.size());
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        outside[n] = ~lessThan(phi.leaf(n), 0.0f);
        const std::int32_t m = S.find(phi.table.origin(n));
        if (m != noLeaf) start[n] = cavities[m];
    }
    fillVoxels(connectedTo(phi.table, outside, start), bandWidthVox * phi.voxelSize, phi, progress);
}

/// Closes the cavities of a surface in its own distance, which changes about them alone.
/// @param[in] cavities  one mask a leaf of S
void fillCavities(const std::vector<LeafMask>& cavities, SparseField& S, Progress& progress)
{
    SparseField filled = copied(S);
    fillVoxels(cavities, splineWidthVox * S.voxelSize, filled, progress);
    LeafTable about = S.table;
    for (std::size_t n = 0; n < about.size(); ++n) about.active(n) = cavities[n];
    about = dilated(about, 2 * int(splineWidthVox), Spread::Ball, progress);
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = about.find(S.table.origin(n));
        if (m == noLeaf) return;
        about.active(m).forEach([&](int v) { S.leaf(n)[v] = filled.leaf(n)[v]; });
    });
}

/// Whether area, volume and pieces of a surface are known in closed form.
bool isClosedForm(const SurfaceOptions& options)
{
    return isUnion(options.kind) && offsetOf(options) == 0.0 && options.minWall == 0.0;
}

/// Replaces area, volume and pieces by those of the union of balls itself. A mesh bridges what is
/// narrower than a voxel: creases and small cavities.
void takeClosedForm(const BoundaryMeasure& measure, const SurfaceOptions& options, Report& report)
{
    SurfaceReport& s = report.surface;
    const std::size_t shown = s.cavities.size();
    s.area = s.volume = s.outerArea = s.outerVolume = 0.0;
    s.components = s.eulerCharacteristic = 0;
    s.cavities.clear();
    for (const BoundaryPiece& piece : measure.pieces) {
        const bool cavity = !piece.outer;
        if (cavity && options.fillCavities) continue;
        s.area += piece.area;
        s.volume += piece.volume;
        s.eulerCharacteristic += piece.eulerCharacteristic;
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
                                  " cavities, for want of voxels [hint: a smaller `voxel`]");
    }
}

/// Statistics and integrals of the curvatures.
void describeCurvature(const Mesh& mesh, const Spline& spline, const SurfaceOptions& options,
                       Progress& progress, SurfaceReport& report)
{
    const std::vector<float> areas = vertexAreas(mesh, progress);
    tbb::parallel_invoke(
        [&] { report.meanCurvature = statistics(mesh.scalars[0].values, areas); },
        [&] { report.gaussianCurvature = statistics(mesh.scalars[1].values, areas); });
    if (!options.curvatureTotals) return;
    constexpr double tolerance = 5.0; // for each unit of the Euler characteristic [sr]
    const int chi = std::max(std::abs(report.eulerCharacteristic), 2);
    report.integrals = integrateSurface(mesh, spline, tolerance * chi, progress);
}

/// The surface of all balls.
MolecularSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                          WarmStart* warm)
{
    const std::vector<Ball>& balls = atoms.balls;
    MolecularSurface result;
    Report& report = result.report;
    Stopwatch watch(report);

    const Scope everything;
    NarrowBand band = makeBand(atoms, options, everything, progress, report, watch, warm);
    const bool unionOfBalls = isUnion(options.kind);

    DistanceBand S;
    BoundaryMeasure exact;
    MeshTolerance tolerance{};
    if (unionOfBalls) {
        progress.update("redistance", 0.0);
        BallUnion set = unionOf(balls, grownBy(options), progress);
        if (isClosedForm(options)) {
            exact = measureBoundary(set.boundary, progress);
            checkBoundary(set.boundary, exact, progress);
            tolerance = meshTolerance(set.boundary, exact, options.voxel);
        }
        S = distanceBand(std::move(set), options, everything, progress);
    }
    Spline spline;
    ExtractStats stats;
    for (bool filled = false;; filled = true) {
        progress.update("redistance", 0.0);
        if (!unionOfBalls) {
            const bool kept = options.fillCavities || hasField(options.fields, "sas");
            S = distanceBand(kept ? copied(band.phi) : std::move(band.phi), options, everything,
                             progress);
            if (!kept) band = NarrowBand();
        }
        watch.stop("redistance");

        progress.update("spline", 0.0);
        spline = fitSpline(S.phi, options.splineLevel, progress);
        if (options.splineLevel > 0) resample(S.phi, spline, progress);
        watch.stop("spline");

        progress.update("redistance", 0.6);
        result.surface = surfaceGrid(options.fillCavities ? copied(S.phi) : std::move(S.phi),
                                     everything, progress);
        releasePages(); // grids and meshes have memory of their own
        watch.stop("redistance");

        progress.update("mesh", 0.0);
        stats = ExtractStats();
        result.mesh = extractMesh(*result.surface, spline, progress, stats);
        if (result.mesh.triangles.empty()) {
            throw Error(ErrorKind::Numeric,
                        "mesh: nothing of the molecule is left at this resolution [hint: a smaller "
                        "`voxel`, `lambda` or `epsilon`]");
        }
        if (filled || !options.fillCavities) break;
        const std::vector<LeafMask> cavities = cavityVoxels(result.mesh, S.phi, progress);
        if (cavities.empty()) break;
        if (unionOfBalls) {
            fillCavities(cavities, S.phi, progress);
        } else {
            fillCavities(cavities, S.phi.table, band.phi, progress);
        }
    }

    progress.update("mesh", 0.7);
    report.surface = measure(result.mesh, progress);
    if (!report.surface.manifold && !splitNonManifold(result.mesh).empty()) {
        report.surface = measure(result.mesh, progress);
    }
    report.surface.kind = nameOf(options.kind);
    report.surface.maxResidual = stats.maxResidual;
    const std::size_t vertices = stats.slopes.size();
    const GradientCounts counts =
        countGradients(result.mesh, stats.slopes, S.kinks, options.voxel, progress);
    report.surface.kinkShare = vertices ? double(counts.kink) / vertices : 0.0;
    report.surface.gradientShare = double(counts.unit) / double(vertices - counts.kink); // or 0/0
    addCurvature(spline, options.fields, result.mesh, progress);
    describeCurvature(result.mesh, spline, options, progress, report.surface);
    if (isClosedForm(options)) {
        const double area = report.surface.area, volume = report.surface.volume;
        takeClosedForm(exact, options, report);
        checkMesh(report.surface.area, report.surface.volume, area, volume, tolerance);
    }
    watch.stop("mesh");

    if (hasField(options.fields, "sas")) {
        const double width = surfaceWidthVox * options.voxel;
        if (options.kind != SurfaceKind::Variational) {
            BallUnion set = unionOf(balls, options.probe, progress);
            band.phi = distanceToUnion(std::move(set), options.voxel, {width, width}, progress).phi;
        }
        auto sas = toLevelSet(band.phi, width, progress);
        sas->setName("sas");
        result.fields.push_back(sas);
    }
    if (hasField(options.fields, "spline")) result.fields.push_back(splineGrid(spline));
    for (auto& grid : curvatureGrids(*result.surface, spline, options.fields, progress))
        result.fields.push_back(std::move(grid));
    if (hasField(options.fields, "density")) result.fields.push_back(densityGrid(*result.surface));
    spline = Spline();
    S = DistanceBand();
    releasePages();
    progress.update("color", 0.0);
    labelSurface(atoms, options, labelReach(atoms, options), progress, result);
    watch.stop("color");

    report.activeVoxels = result.surface->activeVoxelCount();
    report.gridBytes = result.surface->memUsage();
    return result;
}

/// The same balls in spatial order, so that results have the same bits for any order of the atoms.
BallSet inSpatialOrder(const BallSet& atoms)
{
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    return subset(atoms, {order.begin(), order.end()});
}

} // namespace

WarmStart::WarmStart() = default;
WarmStart::~WarmStart() = default;
WarmStart::WarmStart(WarmStart&& other) noexcept = default;
WarmStart& WarmStart::operator=(WarmStart&& other) noexcept = default;

MolecularSurface makeSurface(const std::vector<Ball>& balls, const SurfaceOptions& options,
                             Progress* progress)
{
    BallSet atoms;
    atoms.balls = balls;
    return makeSurface(atoms, options, progress);
}

MolecularSurface makeSurface(const BallSet& atoms, const SurfaceOptions& options,
                             Progress* listener, WarmStart* warm)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    checkOptions(options);
    if (options.matchVolume && !atoms.resolutions.empty()) {
        BallSet matched = atoms;
        SurfaceOptions once = options;
        once.matchVolume = false;
        progress.update("match", 0.0);
        matchVolumes(matched, once, progress);
        return makeSurface(matched, once, &progress, warm);
    }
    checkBalls(atoms.balls, options, Pieces::One, physicalMemory());
    const bool whole = !options.split && options.surfaceOf.empty();
    if ((!whole || options.interfaces) && (!atoms.labels || atoms.labels->groups.empty())) {
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
    }
    const char* shown = hasField(options.fields, "Cd") ? curvatureNameOf(options.color) : nullptr;
    const bool helps = shown && !hasField(options.fields, shown);
    SurfaceOptions wanted = options;
    if (helps) wanted.fields.push_back(shown);
    MolecularSurface result = whole ? runWhole(inSpatialOrder(atoms), wanted, progress, warm)
                                    : runParts(atoms, wanted, progress);
    if (shown) addCurvatureColors(options.color, !helps, result.mesh, result.fields);
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
