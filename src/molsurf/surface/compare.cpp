// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/compare.h"

#include "molsurf/core/parallel.h"
#include "molsurf/error.h"
#include "molsurf/grid/grid_like.h"
#include "molsurf/levelset/redistance.h"
#include "molsurf/mesh/extract.h"
#include "molsurf/mesh/measure.h"
#include "molsurf/mesh/topology.h"
#include "molsurf/spline/fit.h"

#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace molsurf
{

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// How far on either side the band of a stored level set is completed, before a spline is fitted to
/// it [voxel]: splineWidthVox, and half a voxel since values of the file and those that are added
/// do not fit exactly.
constexpr double completedWidthVox = 4.5;

[[noreturn]] void refuse(const std::string& message)
{
    throw Error(ErrorKind::Input, message);
}

std::string gridName(const openvdb::GridBase& grid)
{
    return "grid '" + grid.getName() + "'";
}

/// The level set that stands for the surface.
FloatGrid::Ptr findLevelSet(const openvdb::GridPtrVec& grids)
{
    std::vector<FloatGrid::Ptr> found;
    for (const auto& grid : grids) {
        const bool named = grid->getName() == "surface";
        if (grid->getGridClass() != openvdb::GRID_LEVEL_SET) {
            if (named)
                refuse("grid 'surface': expected class level set, got " +
                       openvdb::GridBase::gridClassToString(grid->getGridClass()));
            continue;
        }
        const auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
        if (!floats && named)
            refuse("grid 'surface': expected type float, got " + grid->valueType());
        if (!floats) continue;
        if (named) return floats;
        found.push_back(floats);
    }
    if (found.empty())
        refuse("expected a level set of type float, got none among " +
               std::to_string(grids.size()) + " grids [hint: vdb_molsurf info FILE.vdb]");
    if (found.size() > 1)
        refuse("expected a grid 'surface' or only one level set, got " +
               std::to_string(found.size()) + " level sets of other names");
    return found[0];
}

/// The rotation and shift of a grid of cubes.
Pose poseOf(const openvdb::GridBase& grid)
{
    const auto& transform = grid.transform();
    if (!transform.isLinear()) refuse(gridName(grid) + ": expected a linear transform");
    Pose pose;
    pose.shift = transform.indexToWorld(Vec3d(0.0));
    const double voxel = grid.voxelSize()[0];
    constexpr double least = 1e-6, most = 1e6; // [Å]
    if (!(voxel >= least && voxel <= most) || !(pose.shift.length() <= 1e3 * most))
        refuse(gridName(grid) + ": expected voxels of 1e-6 to 1e6 Å, within 1e9 Å of the origin");
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d step(0.0);
        step[axis] = 1.0;
        pose.turn.setCol(axis, (transform.indexToWorld(step) - pose.shift) / voxel);
    }
    const Mat3d product = pose.turn.transpose() * pose.turn;
    double worst = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            worst = std::max(worst, std::abs(product(i, j) - (i == j ? 1.0 : 0.0)));
    if (!(worst < 1e-6) || pose.turn.det() < 0.0) {
        std::ostringstream message;
        message << gridName(grid)
                << ": expected voxels that are cubes, not sheared or mirrored; got edges of "
                << grid.voxelSize() << " Å";
        refuse(message.str());
    }
    return pose;
}

/// Refuses leaves near the largest whole numbers.
void checkPlace(const FloatGrid& grid)
{
    constexpr int far = 1 << 26; // [voxel]
    openvdb::CoordBBox box;
    grid.tree().evalLeafBoundingBox(box);
    if (!openvdb::CoordBBox(Coord(-far), Coord(far)).isInside(box))
        refuse(gridName(grid) + ": expected voxels within 2^26 of the origin");
}

/// Refuses values of which squares and products are no numbers.
template<typename Iterator>
void checkValues(const FloatGrid& grid, Iterator it)
{
    const double most = 1e6 * grid.voxelSize()[0];
    for (; it; ++it) {
        if (std::abs(double(*it)) <= most) continue;
        refuse(gridName(grid) + (std::isfinite(*it) ? ": a value is larger than a million voxels"
                                                    : ": a value is not a number"));
    }
}

void sayIfOpen(Operand& operand)
{
    if (operand.surface.closed) return;
    operand.warnings.push_back("the mesh is open, or its triangles are not oriented alike: it has "
                               "no volume and no inside");
}

} // namespace

Spline splineThrough(const FloatGrid& grid, const Progress& progress)
{
    SparseField given = fromGrid(grid);
    const float full = std::abs(grid.background()) * (1.0f - 1e-6f);
    for (std::size_t n = 0; n < given.table.size(); ++n)
        given.table.active(n) &= within(given.leaf(n), full);
    const double width = completedWidthVox * given.voxelSize;
    SparseField S = redistance(copied(given), {width, width}, 0.0, progress).phi;
    parallelFor(S.table.size(), progress, [&](std::size_t n) {
        const std::int32_t m = given.table.find(S.table.origin(n));
        if (m == noLeaf) return;
        const LeafMask& known = given.table.active(m);
        known.forEach([&](int v) { S.leaf(n)[v] = given.leaf(m)[v]; });
        S.table.active(n) |= known;
    });
    if (S.table.size() == 0) return Spline();
    return fitSpline(S, 0, progress);
}

Operand operandOf(const openvdb::GridPtrVec& grids, const Progress& progress)
{
    Operand operand;
    operand.kind = "level set";
    const FloatGrid::Ptr stored = findLevelSet(grids);
    const Pose pose = poseOf(*stored);
    operand.voxel = stored->voxelSize()[0];
    // A tile is a few bytes of a file, and may be 2^36 voxels.
    const auto leaves = stored->tree().leafCount();
    if (stored->activeVoxelCount() - stored->tree().activeLeafVoxelCount() > leafSize * leaves)
        refuse(gridName(*stored) + ": expected a narrow band, got more voxels in tiles than in it");
    stored->tree().voxelizeActiveTiles();
    if (stored->tree().leafCount() == 0) refuse(gridName(*stored) + ": expected voxels, got none");
    checkPlace(*stored);
    checkValues(*stored, stored->cbeginValueOn());

    Surface& surface = operand.surface;
    surface.pose = pose;
    const FloatGrid::Ptr coefficients = findGrid<FloatGrid>(grids, "spline");
    if (coefficients && !coefficients->empty()) {
        const Pose other = poseOf(*coefficients);
        checkPlace(*coefficients);
        checkValues(*coefficients, coefficients->cbeginValueAll());
        if ((other.shift - pose.shift).length() > 1e-3 * operand.voxel ||
            !other.turn.eq(pose.turn, 1e-5))
            refuse("grids 'surface' and 'spline': expected one origin and direction, got two");
        surface.spline = Spline{fromGrid(*coefficients)};
    } else {
        surface.spline = splineThrough(*stored, progress);
    }

    // The mesh is made in the frame of the spline.
    const FloatGrid::Ptr local = stored->copy();
    local->setTransform(openvdb::math::Transform::createLinearTransform(operand.voxel));
    ExtractStats stats;
    Mesh& mesh = surface.mesh;
    if (surface.spline->table().size() > 0)
        mesh = extractMesh(*local, *surface.spline, progress, stats);
    if (mesh.triangles.empty())
        refuse(gridName(*stored) + ": expected values of both signs, got no surface");
    SurfaceReport report = measure(mesh, progress);
    if (!report.manifold && !splitNonManifold(mesh).empty()) report = measure(mesh, progress);
    surface.closed = report.closed;
    operand.size.area = report.area;
    if (report.closed) operand.size.volume = report.volume;
    sayIfOpen(operand);
    for (Vec3f& p : mesh.positions) p = Vec3f(pose.toWorld(Vec3d(p)));
    for (Vec3f& n : mesh.normals) n = Vec3f(pose.turn * Vec3d(n));
    operand.levelSet = stored;
    return operand;
}

Operand operandOf(MolecularSurface&& result)
{
    Operand operand;
    operand.kind = "structure";
    operand.atoms = result.report.atoms;
    operand.voxel = result.report.voxel;
    const FloatGrid::Ptr coefficients = findGrid<FloatGrid>(result.fields, "spline");
    if (!coefficients) throw std::logic_error("compare: a run without the field 'spline'");
    operand.surface.spline = Spline{fromGrid(*coefficients)};
    operand.surface.mesh = std::move(result.mesh);
    operand.surface.closed = result.report.surface.closed;
    operand.size.area = result.report.surface.area;
    if (operand.surface.closed) operand.size.volume = result.report.surface.volume;
    operand.warnings = result.report.warnings;
    operand.levelSet = result.surface;
    return operand;
}

Operand operandOf(Mesh mesh, const Progress& progress)
{
    Operand operand;
    operand.kind = "mesh";
    Surface& surface = operand.surface;
    surface.mesh = std::move(mesh);
    surface.closed = hasInside(surface.mesh, vertexTriangles(surface.mesh), progress);
    sayIfOpen(operand);
    operand.size = sizeOfTriangles(surface.mesh, surface.closed, progress);
    if (operand.size.volume && *operand.size.volume < 0.0) {
        for (auto& t : surface.mesh.triangles) std::swap(t[1], t[2]);
        for (Vec3f& n : surface.mesh.normals) n = -n;
        operand.size.volume = -*operand.size.volume;
        operand.warnings.push_back(
            "the triangles of the mesh are oriented inward: they are turned round");
    }
    if (surface.mesh.normals.empty()) surface.mesh.normals = vertexNormals(surface.mesh);
    return operand;
}

FloatGrid::Ptr levelSetOf(const Surface& surface, double voxel)
{
    if (!surface.closed)
        refuse("the mesh is not closed: it has no level set [hint: write .ply instead of .vdb]");
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    std::vector<openvdb::Vec3I> triangles;
    triangles.reserve(surface.mesh.triangles.size());
    for (const auto& t : surface.mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    constexpr float halfWidth = 3.0f; // [voxel]
    auto grid = openvdb::tools::meshToLevelSet<FloatGrid>(*transform, surface.mesh.positions,
                                                          triangles, halfWidth);
    grid->setName("surface");
    return grid;
}

Comparison compare(const Operand& a, const DistanceTo& toA, const Operand& b, const DistanceTo& toB,
                   Progress& progress)
{
    Comparison both;
    progress.update("distance", 0.0);
    both.aToB = distancesFrom(a.surface, toB, progress);
    progress.update("distance", 0.5);
    both.bToA = distancesFrom(b.surface, toA, progress);
    both.hausdorff = std::max(both.aToB.max, both.bToA.max);
    return both;
}

} // namespace molsurf
