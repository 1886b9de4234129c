// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/run_brick.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/round_ridges.h"
#include "molsurf/kernel/pipeline/derived_grids.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/topology/walls.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/surface/field_table.h"
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

/// Leaves of the halo for the initial level set and for the way that information takes along the
/// interface during the flow.
constexpr int flowLeaves = 2;

/// Whole leaves that hold so many voxels.
int leavesFor(double voxels)
{
    return int(std::ceil(voxels / leafDim));
}

/// Fills the places about leaves (26 each) where there is none with tiles of the sign of the
/// nearest value. A flood fill of signs would go wrong on a level set that is cut open.
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
    // If several leaves have such a place, the last in the order of the tree decides.
    for (const auto& [origin, inside] : missing)
        tree.addTile(1, origin, inside ? -outside : outside, false);
}

/// Leaves the voxels outside of a box inactive. Those beside them need their values.
void turnOffOutside(openvdb::FloatGrid& grid, const CoordBBox& box)
{
    for (auto leaf = grid.tree().beginLeaf(); leaf; ++leaf)
        if (!box.isInside(leaf->origin())) leaf->setValuesOff();
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

/// Cuts the mesh of a run to what a brick owns, and measures how well that fits S.
void cutMesh(SurfaceRun& run, const SurfaceOptions& options, const Region& region, Brick& brick,
             Progress& progress)
{
    Mesh& mesh = run.result().mesh;
    ExtractStats& stats = run.stats();
    std::vector<std::uint32_t> sources;
    brick.mesh = cutBrick(std::move(mesh), std::move(stats.cells), region.owned,
                          region.anchor.asVec3d() * options.voxel, sources, progress);
    mesh = std::move(brick.mesh.mesh);
    std::vector<float> slopes;
    slopes.reserve(brick.mesh.owned);
    for (std::size_t v = 0; v < brick.mesh.owned; ++v) {
        slopes.push_back(stats.slopes[sources[v]]);
        brick.maxResidual = std::max(brick.maxResidual, double(stats.residuals[sources[v]]));
    }
    const GradientCounts counts = run.countGradients(slopes);
    brick.kinkVertices = counts.kink;
    brick.unitVertices = counts.unit;
}

} // namespace

Scope brickScope(const SurfaceOptions& options, const Region& region, const GaussianExtent& extent)
{
    Scope scope;
    scope.region = region;
    scope.extent = extent;
    // A point on the brick's face needs the spline of the next leaf, whose coefficients come from
    // the one beyond it.
    scope.splineHalo = scope.ridgeHalo = 2;
    if (isUnion(options.kind)) return scope;
    if (hasFlow(options.kind)) {
        scope.ridgeHalo += leavesFor(ridgeReach(options.voxel) +
                                     (decidesWalls(options) ? wallReach(options.voxel) : 0));
    }
    // S is the distance to closest points, which lie on a spline of their own.
    const auto [inside, outside] = widthsOf(options);
    constexpr double overhang = 2.5; // [voxel]
    scope.distanceHalo =
        scope.ridgeHalo + leavesFor(std::max(inside, outside) / options.voxel + overhang);
    // A step at a voxel depends on the three voxels about it, and less by some orders of magnitude
    // on those of earlier steps, farther out (docs/adr/0013-bricks.md).
    scope.flowHalo = scope.distanceHalo + (restsInClosedForm(options) ? 1 : flowLeaves);
    return scope;
}

openvdb::BBoxd spaceNear(const SurfaceOptions& options, const Scope& scope)
{
    const int halo = std::max(scope.flowHalo, scope.splineHalo);
    const CoordBBox box = scope.region.grown(halo);
    const double reach = Influence(*scope.extent, options).onVoxels();
    return {box.min().asVec3d() * options.voxel - Vec3d(reach),
            box.max().asVec3d() * options.voxel + Vec3d(reach)};
}

BallSet ballsIn(const BallSet& atoms, const openvdb::BBoxd& space)
{
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i)
        if (space.isInside(Vec3d(atoms.balls[i].center))) inside.push_back(i);
    return subset(atoms, inside, Counted::Whole);
}

Brick runBrick(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
               Progress& progress)
{
    const CoordBBox& box = scope.region.owned;
    SurfaceRun run(atoms, {options, options}, scope, progress);
    LevelSetSurface& result = run.result();
    if (!atoms.balls.empty()) {
        run.density();
        run.flow();
        run.distance();
    }
    run.spline();
    run.levelSet();
    closeSides(*result.surface);
    run.mesh();
    run.dropSpecks();
    run.curvatures();
    turnOffOutside(*result.surface, box);
    result.fields = run.fields();
    run.freeFields();

    Brick brick;
    Stopwatch watch(result.report);
    cutMesh(run, options, scope.region, brick, progress);
    watch.stop("mesh");
    MolecularSurface made = run.finish();
    watch = Stopwatch(made.report);
    progress.update("color", 0.0);
    labelPart(atoms, options, run.labelReach(), progress, made);
    watch.stop("color");
    brick.mesh.mesh = std::move(made.mesh);
    for (const auto& grid : made.grids()) brick.grids.push_back(owned(grid, box));
    if (options.halfFloats) saveAsHalf(brick.grids);
    brick.evolution = made.report.evolution;
    brick.displacements = run.displacements();
    brick.groups = made.report.groups;
    brick.seconds = made.report.seconds;
    return brick;
}

} // namespace molsurf
