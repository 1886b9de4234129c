// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/compare.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/levelset/redistance.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/kernel/mesh/extract.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/spline/fit.h"

#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
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
/// it [voxel]: splineWidthVox, and a voxel since values of the file and those that are added do not
/// fit exactly.
constexpr double completedWidthVox = 4.5;

[[noreturn]] void refuse(const std::string& message)
{
    throw Error(ErrorKind::Input, message);
}

std::string gridName(const openvdb::GridBase& grid)
{
    return "grid '" + grid.getName() + "'";
}

/// The level set of the surface.
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
Motion poseOf(const openvdb::GridBase& grid)
{
    const auto& transform = grid.transform();
    if (!transform.isLinear()) refuse(gridName(grid) + ": expected a linear transform");
    Motion pose{{}, transform.indexToWorld(Vec3d(0.0))};
    const double voxel = grid.voxelSize()[0];
    constexpr double least = 1e-6, most = 1e6; // [Å]
    if (!(voxel >= least && voxel <= most))
        refuse(gridName(grid) + ": expected voxels of 1e-6 to 1e6 Å");
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d step(0.0);
        step[axis] = 1.0;
        const Vec3d column = (transform.indexToWorld(step) - pose.translation) / voxel;
        for (int row = 0; row < 3; ++row)
            pose.rotation[std::size_t(row)][std::size_t(axis)] = column[row];
    }
    const Mat3d turn = pose.matrix(), product = turn.transpose() * turn;
    double worst = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            worst = std::max(worst, std::abs(product(i, j) - (i == j ? 1.0 : 0.0)));
    if (!(worst < 1e-6) || turn.det() < 0.0) {
        std::ostringstream message;
        message << gridName(grid)
                << ": expected voxels that are cubes, not sheared or mirrored; got edges of "
                << grid.voxelSize() << " Å";
        refuse(message.str());
    }
    return pose;
}

/// The largest coordinate of a box, whose corners lie at voxels, where these are put.
double farthest(const openvdb::CoordBBox& box, const Motion& pose, double voxel)
{
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d x;
        for (int a = 0; a < 3; ++a) // bit a of the corner: its end of axis a
            x[a] = voxel * double((corner >> a & 1 ? box.max() : box.min())[a]);
        const Vec3d placed = openvdb::math::Abs(pose.placed(x));
        most = std::max({most, placed[0], placed[1], placed[2]});
    }
    return most;
}

/// Refuses a grid with places that coordinates of 32 bits do not hold, in its own frame or outside.
/// @return how far a place is rounded by float coordinates [Å]
double roundingAt(const FloatGrid& grid, const Motion& pose)
{
    constexpr double far = 1e6; // [Å], as of atoms
    openvdb::CoordBBox box;
    grid.tree().evalLeafBoundingBox(box);
    const double voxel = grid.voxelSize()[0];
    const double local = farthest(box, Motion::identity(), voxel),
                 placed = farthest(box, pose, voxel);
    constexpr int last = 1 << 26; // [voxel]: sums of a few coordinates stay within 32 bits
    if (!openvdb::CoordBBox(Coord(-last), Coord(last)).isInside(box))
        refuse(gridName(grid) + ": expected voxels within 2^26 of the origin");
    if (!(std::max(local, placed) <= far)) {
        std::ostringstream message;
        message << gridName(grid) << ": expected voxels within 1e6 Å of the origin, got one at "
                << std::max(local, placed) << " Å";
        refuse(message.str());
    }
    return placed * double(std::numeric_limits<float>::epsilon());
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

/// Whether a spline is of a level set: takes its values at voxels within one of zero, one a leaf.
/// On voxels of h a spline of distances differs by 0.002 h^2 to 0.03 h^2/Å in the median, most of
/// all at creases.
bool fits(const Spline& spline, const FloatGrid& levelSet)
{
    const double h = levelSet.voxelSize()[0];
    // measured: the median of vdw, sas, ses, gaussian and variational surfaces of 1CRN and BPTI on
    // voxels of 0.25 to 2 Å is at most 0.03 h^2/Å, and 95 % are within 0.4 h^2/Å.
    const double most = std::max(0.005, 0.05 * h * h); // [Å]
    constexpr double rest = 20.0;                      // times as much at 95 % of the voxels
    std::vector<double> apart;
    SplineSampler sampler(spline);
    for (auto leaf = levelSet.tree().cbeginLeaf(); leaf; ++leaf)
        for (auto it = leaf->cbeginValueOn(); it; ++it) {
            if (std::abs(double(*it)) >= h) continue;
            const Vec3d x = h * it.getCoord().asVec3d();
            const bool known = spline.table().find(Coord::round(x / spline.voxelSize())) != noLeaf;
            apart.push_back(known ? std::abs(sampler.at(x).value - double(*it))
                                  : std::numeric_limits<double>::infinity());
            break;
        }
    if (apart.empty()) return true;
    std::sort(apart.begin(), apart.end());
    return apart[apart.size() / 2] <= most && apart[apart.size() * 19 / 20] <= rest * most;
}

/// A warning if a level set holds no distances: its slope where the sign changes, the median of one
/// place a leaf, is not about 1.
void checkSlopes(const FloatGrid& levelSet, std::vector<std::string>& warnings)
{
    constexpr double least = 0.8, most = 1.25; // creases and coarse voxels are flatter
    const auto values = levelSet.getConstAccessor();
    const double h = levelSet.voxelSize()[0];
    std::vector<double> slopes;
    for (auto leaf = levelSet.tree().cbeginLeaf(); leaf; ++leaf)
        for (auto it = leaf->cbeginValueOn(); it; ++it) {
            Vec3d gradient(0.0);
            bool crosses = false;
            for (int axis = 0; axis < 3; ++axis) {
                const Coord at = it.getCoord();
                Coord low = at, high = at;
                --low[axis];
                ++high[axis];
                const float below = values.getValue(low), above = values.getValue(high);
                crosses |= (below < 0.0f) != (*it < 0.0f) || (above < 0.0f) != (*it < 0.0f);
                gradient[axis] = (double(above) - double(below)) / (2.0 * h);
            }
            if (!crosses) continue;
            slopes.push_back(gradient.length());
            break;
        }
    if (slopes.empty()) return;
    std::nth_element(slopes.begin(), slopes.begin() + slopes.size() / 2, slopes.end());
    const double slope = slopes[slopes.size() / 2];
    if (slope >= least && slope <= most) return;
    warnings.push_back(gridName(levelSet) +
                       formatted(": expected distances in Å, whose slope at the surface is 1, got "
                                 "%.3g; area and volume may be wrong by some per cent",
                                 slope));
}

/// The stored spline of a level set; nothing if there is none, or, with a warning, of another one.
std::optional<Spline> storedSpline(const openvdb::GridPtrVec& grids, const FloatGrid& levelSet,
                                   const Motion& pose, std::vector<std::string>& warnings)
{
    const FloatGrid::Ptr coefficients = findGrid<FloatGrid>(grids, "spline");
    if (!coefficients || coefficients->empty()) return std::nullopt;
    const Motion other = poseOf(*coefficients);
    roundingAt(*coefficients, other);
    checkValues(*coefficients, coefficients->cbeginValueAll());
    if ((other.translation - pose.translation).length() > 1e-3 * levelSet.voxelSize()[0] ||
        !other.matrix().eq(pose.matrix(), 1e-5))
        refuse("grids 'surface' and 'spline': expected one origin and direction, got two");
    Spline spline{fromGrid(*coefficients)};
    if (fits(spline, levelSet)) return spline;
    warnings.push_back("grid 'spline': it is of another surface than " + gridName(levelSet) +
                       ", so a spline is fitted to that one");
    return std::nullopt;
}

/// Refuses files in which a name does not say which grid is meant.
void checkNames(const openvdb::GridPtrVec& grids)
{
    for (const char* name : {"surface", "spline"}) {
        const auto count = std::count_if(grids.begin(), grids.end(),
                                         [&](const auto& grid) { return grid->getName() == name; });
        if (count > 1)
            refuse("grid '" + std::string(name) + "': expected one of this name, got " +
                   std::to_string(count));
    }
}

void sayIfOpen(Operand& operand)
{
    if (operand.surface.closed) return;
    operand.warnings.push_back("the mesh is open, or its triangles are not oriented alike: it has "
                               "no volume and no inside");
}

void sayIfRounded(double rounding, std::vector<std::string>& warnings)
{
    constexpr double most = 0.01; // [Å]
    if (rounding < most) return;
    std::ostringstream message;
    message << std::setprecision(2) << "vertices are rounded to " << rounding
            << " Å, as they lie far from the origin; area and volume are not";
    warnings.push_back(message.str());
}

} // namespace

Spline splineThrough(const FloatGrid& grid, const Progress& progress)
{
    SparseField given = fromGrid(grid);
    // Values at the ends of the band are cut off, and no distances: those voxels are not known.
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

Operand storedOperand(const openvdb::GridPtrVec& grids, const Progress& progress)
{
    Operand operand;
    operand.kind = "level set";
    checkNames(grids);
    const FloatGrid::Ptr stored = findLevelSet(grids);
    const Motion pose = poseOf(*stored);
    operand.voxel = stored->voxelSize()[0];
    // A tile is a few bytes of a file, and may be 2^36 voxels.
    const auto leaves = stored->tree().leafCount();
    if (stored->activeVoxelCount() - stored->tree().activeLeafVoxelCount() > leafSize * leaves)
        refuse(gridName(*stored) + ": expected a narrow band, got more voxels in tiles than in it");
    stored->tree().voxelizeActiveTiles();
    if (stored->tree().leafCount() == 0) refuse(gridName(*stored) + ": expected voxels, got none");
    const double rounding = roundingAt(*stored, pose);
    checkValues(*stored, stored->cbeginValueOn());
    checkSlopes(*stored, operand.warnings);

    Surface& surface = operand.surface;
    surface.pose = pose;
    surface.spline = storedSpline(grids, *stored, pose, operand.warnings);
    if (!surface.spline) surface.spline = splineThrough(*stored, progress);

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
    sayIfRounded(rounding, operand.warnings);
    operand.levelSet = stored;
    return operand;
}

void place(const Motion& pose, Mesh& mesh)
{
    for (Vec3f& p : mesh.positions) p = Vec3f(pose.placed(Vec3d(p)));
    for (Vec3f& n : mesh.normals) n = Vec3f(pose.turned(Vec3d(n)));
}

Operand operandOf(const openvdb::GridPtrVec& grids, const Progress& progress)
{
    Operand operand = storedOperand(grids, progress);
    place(operand.surface.pose, operand.surface.mesh);
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

Comparison compare(const Mesh& a, const Mesh& b, Progress* listener)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    for (const Mesh* mesh : {&a, &b}) {
        if (mesh->triangles.empty())
            throw Error(ErrorKind::Input, "compare: expected triangles, got a mesh without any");
        checkArrays(*mesh);
    }
    const Operand first = operandOf(a, progress), second = operandOf(b, progress);
    const DistanceTo toA(first.surface), toB(second.surface);
    return compare(first, toA, second, toB, progress);
}

} // namespace molsurf
