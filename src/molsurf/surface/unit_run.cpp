// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_run.h"

#include "molsurf/analysis/measures/shape_complementarity.h"
#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/power_owners.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/surface/label_surface.h"
#include "molsurf/surface/product_table.h"
#include "molsurf/surface/unit_border.h"
#include "molsurf/surface/unit_cut.h"
#include "molsurf/surface/unit_union.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The balls that decide whose a point is. Images of a ball on an axis move a little toward their
/// own units, so that each has an equal part.
std::vector<Ball> owningBalls(const BallSet& atoms, double grown)
{
    const Placement& placement = atoms.placement;
    const BallIndex index(atoms.balls, {0.0, 0.0, 2.0});
    Vec3d middle(0.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        if (!placement.owns(std::int32_t(i))) continue;
        middle += Vec3d(atoms.balls[i].center);
        ++count;
    }
    middle /= double(count);
    std::vector<Ball> out = atoms.balls;
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].radius += grown;
        if (imagesAt(atoms, index, i).empty()) continue;
        const Instance& motion = placement.instances[std::size_t(placement.motionOf[i])];
        const Vec3d away = motion.placed(middle) - Vec3d(out[i].center);
        if (away.lengthSqr() > 0.0) out[i].center += onAxis * away.unit();
    }
    return out;
}

/// Replaces the measures of a whole by those in closed form. How many pieces it has is not known.
/// @return the areas of balls in all units [Å^2]; 0 for those of neighbours
std::vector<double> useClosedForm(const BallSet& atoms, double grown, const Progress& progress,
                                  SurfaceReport& surface)
{
    const double order = double(atoms.placement.order());
    UnitShare share = shareOfUnit(atoms, grown, progress);
    dropTopology(surface);
    surface.eulerCharacteristic = share.wholeEuler;
    surface.area = 0.0;
    for (double& area : share.areas) surface.area += area *= order;
    surface.volume = order * share.volume;
    return std::move(share.areas);
}

/// The measures of the whole in closed form.
MolecularSurface runUnitWithoutGrid(const BallSet& atoms, const SurfaceOptions& options,
                                    Progress& progress)
{
    const Placement::Unit& unit = *atoms.placement.unit;
    MolecularSurface result;
    Stopwatch watch(result.report);
    progress.update("areas", 0.0);
    result.report.surface.kind = nameOf(options.kind);
    labelSurface(atoms, options,
                 useClosedForm(atoms, probeOf(options), progress, result.report.surface), 0.0,
                 progress, result);
    result.report.symmetry =
        Report::Symmetry{unit.pointGroup, unit.inverse.size(), unit.copies, unit.deviation, 0.0, 0};
    watch.stop("areas");
    return result;
}

/// The connected pieces of the whole, by union-find: piece p of unit k is k * n + p, and is joined
/// to the pieces that share a vertex with it.
/// @param[in] pieceOf  piece of each vertex of the unit
/// @param[in] pieces   measures of the unit's n pieces
std::vector<PieceMeasure> wholePieces(const Placement::Unit& unit, const BorderFit& fit,
                                      const std::vector<std::uint32_t>& pieceOf,
                                      const std::vector<PieceMeasure>& pieces)
{
    const std::size_t order = unit.inverse.size(), n = pieces.size();
    DisjointSets sets(order * n);
    std::vector<std::array<std::uint32_t, 3>> meetings;
    for (const MolecularSurface::SharedVertex& s : fit.shared)
        meetings.push_back({pieceOf[s.vertex], std::uint32_t(s.motion), pieceOf[s.other]});
    std::sort(meetings.begin(), meetings.end());
    meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
    for (std::size_t k = 0; k < order; ++k) {
        for (const auto& [piece, motion, other] : meetings)
            sets.join(std::uint32_t(k * n + piece),
                      std::uint32_t(unit.product[k][motion] * n + other));
    }
    std::size_t count = 0;
    const std::vector<std::uint32_t> number = sets.numbers(count);
    std::vector<PieceMeasure> out(count);
    for (std::size_t i = 0; i < number.size(); ++i) out[number[i]] += pieces[i % n];
    return out;
}

/// Fills in the measures of the whole of a unit: areas are those of the surface that was found,
/// volumes those that the fitted one encloses.
void measureWhole(const Placement::Unit& unit, const BorderFit& fit, const Mesh& mesh,
                  const MeshPieces& found, const Progress& progress, SurfaceReport& surface)
{
    MeshPieces fitted = piecesOf(mesh, unit.centre, progress);
    surface.degenerateTriangles = fitted.triangles.flat;
    for (PieceMeasure& piece : fitted.measures) piece.area = 0.0;
    std::vector<char> counted(found.measures.size(), 0);
    for (std::size_t v = 0; v < found.of.size(); ++v)
        if (!std::exchange(counted[found.of[v]], 1))
            fitted.measures[fitted.of[v]].area += found.measures[found.of[v]].area;
    countPieces(wholePieces(unit, fit, fitted.of, fitted.measures), surface);
    surface.triangleArea = double(unit.inverse.size()) * fitted.triangles.area;
    BorderClasses classes(unit, fit.shared, mesh.positions.size());
    const std::size_t units = unit.inverse.size();
    surface.triangles = units * mesh.triangles.size();
    surface.vertices = units * (mesh.positions.size() - classes.border().size()) + classes.count();
    const std::size_t edges = 3 * surface.triangles / 2;
    surface.eulerCharacteristic = surface.meshEulerCharacteristic =
        int(std::int64_t(surface.vertices + surface.triangles) - std::int64_t(edges));
}

/// How many units meet at a place: those whose rotations leave it where it is.
std::size_t unitsAt(const Placement& placement, const Vec3d& x)
{
    constexpr double apart = 0.01; // [Å]
    const auto& motions = placement.instances;
    return std::size_t(std::count_if(motions.begin(), motions.end(), [&](const Instance& motion) {
        return (motion.placed(x) - x).length() < apart;
    }));
}

/// The Euler number of the whole by the part that a unit owns, before its border is glued: that of
/// `order` parts, less a half for each of the d parts that meet at a corner of the border, of which
/// the whole has one. d is 3, and n on an n-fold axis.
/// @return nothing if no whole number comes out, so that the parts do not fit each other
std::optional<int> eulerOfParts(const Placement& placement, const CutMesh& part)
{
    const auto vertices = double(part.mesh.positions.size());
    const auto triangles = double(part.mesh.triangles.size());
    const double edges = 0.5 * (3.0 * triangles + double(part.border.size()));
    double sum = vertices - edges + triangles;
    std::vector<Vec3d> axes; // corners on them
    for (const BorderEdge& edge : part.border) {
        const std::int32_t before = part.border[edge.previous].owner;
        if (before == edge.owner) continue;
        const Vec3d x(part.mesh.positions[edge.from]);
        const std::size_t units = unitsAt(placement, x);
        const auto isNear = [&](const Vec3d& y) { return (x - y).length() < 0.02; };
        if (units > 1 && std::any_of(axes.begin(), axes.end(), isNear)) continue;
        if (units > 1) axes.push_back(x);
        sum += 1.0 / double(units > 1 ? units : 3) - 0.5;
    }
    sum *= double(placement.order());
    const double whole = std::round(sum);
    if (std::abs(sum - whole) > 1e-3) return {};
    return int(whole);
}

/// @param[in] area  of the unit's surface [Å^2]
/// @throws Error(ErrorKind::Check) if the whole is not closed, or by too much that was not found
void checkFit(const BorderFit& fit, double area, const SurfaceReport& surface)
{
    constexpr double most = 0.05; // of the area that triangles over holes may have
    if (surface.closed && surface.manifold && fit.filled <= most * area) return;
    throw Error(
        ErrorKind::Check,
        formatted(
            "mesh: %zu edges of the unit's border fit none of its neighbours', expected holes "
            "of at most %g %% of the area, got %.3g %% [hint: without `bySymmetry`, with "
            "`memory` 8G where the whole is too large]",
            fit.open, 100.0 * most, 100.0 * fit.filled / area));
}

} // namespace

double surroundingsOf(const SurfaceOptions& options)
{
    // Two balls that touch through a probe, and the voxels between a surface and what it depends
    // on.
    constexpr double largest = 2.5; // of atoms [Å]
    const double voxels = isUnion(options.kind) ? 8.0 : 12.0;
    const double surface =
        2.0 * (largest + options.probe) + voxels * options.voxel + options.minThickness;
    return options.interfaces ? std::max(surface, 2.0 * largest + fitReach) : surface;
}

MolecularSurface runUnit(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    checkWay(BySymmetry, options);
    if (!options.grid) return runUnitWithoutGrid(atoms, options, progress);
    const Placement& placement = atoms.placement;
    const Placement::Unit& unit = *placement.unit;
    Scope scope;
    scope.isUnit = true;
    KernelProducts products = options;
    products.needs = needsOf(atoms, options);
    SurfaceRun run(atoms, {options, products}, scope, progress);
    run.toMesh();

    Stopwatch watch(run.result().report);
    Mesh& mesh = run.result().mesh;
    ExtractStats& stats = run.stats();
    run.dropSpecks();
    const Topology topology = checkTopology(mesh, progress);
    if (!topology.manifold)
        for (const std::uint32_t v : splitNonManifold(mesh))
            stats.slopes.push_back(stats.slopes[v]);
    const double grown = growthOf(options);
    const PowerOwners owners(owningBalls(atoms, grown), placement.motionOf);
    CutMesh part = cutToOwner(mesh, owners, run.currentSpline(), progress);
    if (part.mesh.triangles.empty())
        throw Error(ErrorKind::Numeric, "mesh: nothing of the unit is left at this resolution "
                                        "[hint: a smaller `voxel`]");
    SurfaceReport& surface = run.result().report.surface;
    const MeshPieces found = piecesOf(part.mesh, unit.centre, progress);
    const std::optional<int> euler = eulerOfParts(placement, part);
    const BorderFit fit = fitBorder(placement, options.voxel, part);
    std::vector<float> slopes;
    for (const std::uint32_t v : part.sources) slopes.push_back(stats.slopes[v]);
    mesh = std::move(part.mesh);

    surface.kind = nameOf(options.kind);
    measureWhole(unit, fit, mesh, found, progress, surface);
    surface.closed = topology.closed;
    surface.manifold = topology.oriented;
    surface.maxResidual = stats.maxResidual;
    run.describeSlopes(slopes);

    run.curvatures();
    run.describeCurvature();
    const double area = surface.area;
    std::vector<double> known;
    if (isBoundary(options)) {
        surface.meshArea = surface.area;
        surface.meshVolume = surface.volume;
        known = useClosedForm(atoms, grown, progress, surface);
    } else if (isClosedForm(options) || euler != surface.eulerCharacteristic) {
        dropTopology(surface); // the mesh has its own, where borders were glued otherwise
    }
    checkFit(fit, area / double(placement.order()), surface);
    watch.stop("unit");
    run.freeFields();
    MolecularSurface result = run.finish();
    watch = Stopwatch(result.report);
    progress.update("color", 0.0);
    labelSurface(atoms, options, std::move(known), run.labelReach(), progress, result);
    watch.stop("color");
    result.surface.reset();
    result.shared = fit.shared;
    result.report.symmetry = Report::Symmetry{unit.pointGroup, unit.inverse.size(), unit.copies,
                                              unit.deviation,  fit.largest,         fit.open};
    return result;
}

} // namespace molsurf
