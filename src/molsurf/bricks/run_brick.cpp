// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bricks/run_brick.h"

#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/levelset/union_distance.h"
#include "molsurf/mesh/extract.h"
#include "molsurf/spline/fit.h"
#include "molsurf/surface.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/label_surface.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

namespace
{

/// Whole leaves that hold so many voxels.
int leavesFor(double voxels)
{
    return int(std::ceil(voxels / leafDim));
}

/// Fills the places beside leaves where there is none by the sign of the nearest value, since what
/// flood fill makes of a level set that is cut open cannot be trusted.
void closeSides(openvdb::FloatGrid& surface)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    auto& tree = surface.tree();
    std::vector<std::pair<Coord, bool>> missing; // first voxel, inside
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        for (int k = 0; k < 27; ++k) {
            const Coord step(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
            const Coord origin =
                leaf->origin().offsetBy(leafDim * step.x(), leafDim * step.y(), leafDim * step.z());
            if (tree.probeConstLeaf(origin)) continue;
            const auto side = [](int s) { return s < 0 ? 0 : s > 0 ? leafDim - 1 : leafDim / 2; };
            const Coord near(side(step.x()), side(step.y()), side(step.z()));
            missing.emplace_back(origin, leaf->getValue(Leaf::coordToOffset(near)) < 0.0f);
        }
    }
    const float outside = tree.background();
    // Leaves that share a face with the place come last and decide.
    for (const auto& [origin, inside] : missing)
        tree.addTile(1, origin, inside ? -outside : outside, false);
}

/// Takes the leaves in a box out of a grid, which is lost.
template<typename GridT>
openvdb::GridBase::Ptr ownedPart(GridT& grid, const CoordBBox& box)
{
    using Leaf = typename GridT::TreeType::LeafNodeType;
    std::vector<Leaf*> leaves;
    grid.tree().stealNodes(leaves);
    auto out = grid.copyWithNewTree();
    for (Leaf* leaf : leaves) {
        if (box.isInside(leaf->origin())) {
            out->tree().addLeaf(leaf);
        } else {
            delete leaf;
        }
    }
    return out;
}

openvdb::GridBase::Ptr owned(const openvdb::GridBase::Ptr& grid, const CoordBBox& box)
{
    if (const auto g = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) return ownedPart(*g, box);
    if (const auto g = openvdb::gridPtrCast<openvdb::Int32Grid>(grid)) return ownedPart(*g, box);
    return ownedPart(*openvdb::gridPtrCast<openvdb::Vec3SGrid>(grid), box);
}

/// The grid `sas` of what a brick owns.
openvdb::GridBase::Ptr sasGrid(const BallSet& atoms, const SurfaceOptions& options,
                               const NarrowBand& band, const Scope& scope, Progress& progress)
{
    const double width = surfaceWidthVox * options.voxel;
    openvdb::FloatGrid::Ptr grid;
    if (options.kind == SurfaceKind::Variational) {
        grid = toLevelSet(band.phi, width, progress);
    } else {
        const DistanceBand exact =
            distanceToUnion(unionOf(atoms.balls, options.probe, progress), options.voxel,
                            {width, width}, progress, scope.region.owned);
        grid = toLevelSet(exact.phi, width, progress);
    }
    grid->setName("sas");
    return owned(grid, scope.region.owned);
}

/// The mesh, what is known at its vertices, and the grids.
void finish(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
            NarrowBand& band, DistanceBand& S, bool keepsMemory, Progress& progress,
            Stopwatch& watch, Brick& brick)
{
    const CoordBBox& box = scope.region.owned;
    progress.update("spline", 0.0);
    Spline spline = fitSpline(S.phi, 0, progress);
    watch.stop("spline");
    auto surface = surfaceGrid(std::move(S.phi), scope, progress);
    closeSides(*surface);
    if (!keepsMemory) releasePages(); // grids and meshes have memory of their own
    watch.stop("redistance");

    progress.update("mesh", 0.0);
    ExtractStats stats;
    stats.keepCells = true;
    Mesh whole = extractMesh(*surface, spline, progress, stats);
    addCurvature(spline, options.fields, whole, progress);
    MolecularSurface result;
    result.surface = openvdb::gridPtrCast<openvdb::FloatGrid>(owned(surface, box));
    surface.reset();
    brick.grids = {result.surface};
    if (hasField(options.fields, "sas"))
        brick.grids.push_back(sasGrid(atoms, options, band, scope, progress));
    if (hasField(options.fields, "spline")) brick.grids.push_back(owned(splineGrid(spline), box));
    for (auto& grid : curvatureGrids(*result.surface, spline, options.fields, progress))
        brick.grids.push_back(std::move(grid));
    band = NarrowBand();
    spline = Spline();
    if (!keepsMemory) releasePages();

    std::vector<std::uint32_t> sources;
    brick.mesh = cutBrick(std::move(whole), std::move(stats.cells), box,
                          scope.region.anchor.asVec3d() * options.voxel, sources, progress);
    result.mesh = std::move(brick.mesh.mesh);
    std::vector<float> slopes;
    slopes.reserve(brick.mesh.owned);
    for (std::size_t v = 0; v < brick.mesh.owned; ++v) slopes.push_back(stats.slopes[sources[v]]);
    const GradientCounts counts =
        countGradients(result.mesh, slopes, S.kinks, options.voxel, progress);
    brick.kinkVertices = counts.kink;
    brick.unitVertices = counts.unit;
    for (std::size_t v = 0; v < brick.mesh.owned; ++v)
        brick.maxResidual = std::max(brick.maxResidual, double(stats.residuals[sources[v]]));
    watch.stop("mesh");

    progress.update("color", 0.0);
    const std::vector<double> areas =
        labelPart(atoms, options, labelReach(atoms, options), progress, result);
    for (std::size_t g = 0; g < areas.size(); ++g) {
        const bool other = g + 1 == areas.size();
        const Group* group = other ? nullptr : &atoms.labels->groups[g];
        GroupReport part;
        part.name = other ? "other" : group->name;
        part.atoms = other ? 0 : group->balls;
        part.area = areas[g];
        brick.groups.push_back(part);
    }
    brick.grids.insert(brick.grids.end(), result.fields.begin(), result.fields.end());
    brick.mesh.mesh = std::move(result.mesh);
    watch.stop("color");
}

} // namespace

Scope brickScope(const SurfaceOptions& options, const Region& region, const GaussianExtent& extent)
{
    Scope scope;
    scope.region = region;
    scope.extent = extent;
    // A point on the brick's face needs the spline of the next leaf, whose coefficients come from
    // the one beyond it.
    scope.splineHalo = 2;
    if (isUnion(options.kind)) return scope;
    // S is the distance to closest points, which lie on a spline of their own.
    const auto [inside, outside] = widthsOf(options);
    constexpr double overhang = 2.5; // [voxel]
    scope.distanceHalo =
        scope.splineHalo + leavesFor(std::max(inside, outside) / options.voxel + overhang);
    // What a step does at a voxel depends on the three voxels about it, and less by some orders of
    // magnitude on those of earlier steps, farther out (docs/adr/0013-bricks.md).
    scope.flowHalo = scope.distanceHalo + flowLeaves;
    return scope;
}

double ballReach(const SurfaceOptions& options, const GaussianExtent& extent)
{
    const double h = options.voxel, R = extent.largest + options.probe;
    const double leaf = leafDim * h, tolerance = extent.tolerance;
    // A ball's boundary takes part in the distance of its depth, and is cut by balls two radii off.
    const double unions = 3.0 * R + widthsOf(options).inside + leaf;
    const double sums =
        std::max(cutoff(extent, std::max(gaussianOptions(options).reach, 2.0 * tolerance)),
                 extent.swollen + 3.0 * tolerance + h + 2.0 * leaf);
    const double labels = extent.largest + 2.0 * options.probe + 4.0 * tolerance + 4.0 * h;
    return std::max({unions, isUnion(options.kind) ? 0.0 : sums, labels});
}

BallSet ballsNear(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope)
{
    const int halo = std::max(scope.flowHalo, scope.splineHalo);
    const CoordBBox box = scope.region.grown(halo);
    const double reach = ballReach(options, *scope.extent);
    const Vec3d low = box.min().asVec3d() * options.voxel - Vec3d(reach);
    const Vec3d high = box.max().asVec3d() * options.voxel + Vec3d(reach);
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const Vec3d c(atoms.balls[i].center);
        if (c.x() >= low.x() && c.y() >= low.y() && c.z() >= low.z() && c.x() <= high.x() &&
            c.y() <= high.y() && c.z() <= high.z())
            near.push_back(i);
    }
    std::vector<Ball> balls;
    for (const std::size_t i : near) balls.push_back(atoms.balls[i]);
    const std::vector<std::int32_t> order = spatialOrder(balls); // as in a run of the whole
    const auto take = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to.reserve(near.size());
        for (const std::int32_t k : order) to.push_back(from[near[std::size_t(k)]]);
    };
    BallSet some;
    take(atoms.balls, some.balls);
    take(atoms.decays, some.decays);
    take(atoms.colors, some.colors);
    some.resolutions = atoms.resolutions;
    take(atoms.resolutionOf, some.resolutionOf);
    if (atoms.labels) {
        BallLabels& labels = some.labels.emplace();
        take(atoms.labels->chainOf, labels.chainOf);
        take(atoms.labels->groupOf, labels.groupOf);
        take(atoms.labels->elementOf, labels.elementOf);
        take(atoms.labels->residueClassOf, labels.residueClassOf);
        labels.groups = atoms.labels->groups;
    }
    return some;
}

void checkBrickOptions(const SurfaceOptions& options)
{
    const auto refuse = [](const std::string& what) {
        throw Error(ErrorKind::Usage,
                    what + " needs the whole molecule at once: it is not for bricks [hint: without "
                           "`memory`, on a machine that has enough]");
    };
    if (options.split) refuse("`split`");
    if (!options.surfaceOf.empty()) refuse("`surfaceOf`");
    if (options.interfaces) refuse("`interfaces`");
    if (options.matchVolume) refuse("`matchVolume`");
    if (options.fillCavities) refuse("`fillCavities`");
    if (options.minWall > 0.0) refuse("`minWall`");
    if (hasField(options.fields, "density")) refuse("`fields` density");
    if (options.curvatureTotals) refuse("`curvatureTotals`");
    if (options.splineLevel > 0) refuse("`splineLevel`");
    if (options.kind == SurfaceKind::Variational && options.evolution.flow == Flow::Plain)
        refuse("`flow` plain");
    if (options.color == ColorBy::MeanCurvature || options.color == ColorBy::GaussianCurvature)
        refuse("`color` by curvature");
}

Brick runBrick(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
               Progress& progress, bool keepsMemory)
{
    Brick brick;
    Report report;
    Stopwatch watch(report);
    NarrowBand band;
    DistanceBand S;
    band.phi.voxelSize = S.phi.voxelSize = options.voxel;
    if (!atoms.balls.empty()) {
        band = makeBand(atoms, options, scope, progress, report, watch);
        band.phi = clipped(std::move(band.phi), scope.region.grown(scope.distanceHalo), progress);
        progress.update("redistance", 0.0);
        const bool kept = hasField(options.fields, "sas");
        if (isUnion(options.kind)) {
            S = distanceBand(unionOf(atoms.balls, grownBy(options), progress), options, scope,
                             progress);
        } else {
            S = distanceBand(kept ? copied(band.phi) : std::move(band.phi), options, scope,
                             progress);
        }
        watch.stop("redistance");
    }
    brick.evolution = report.evolution;
    finish(atoms, options, scope, band, S, keepsMemory, progress, watch, brick);
    brick.seconds = report.seconds;
    return brick;
}

} // namespace molsurf
