// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/label.h"

#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/show/color/palette.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3f;

Labels atomsOf(const std::vector<Ball>& balls)
{
    Labels out;
    out.reserve(balls.size());
    for (const Ball& ball : balls) out.push_back(ball.atom);
    return out;
}

Labels labelsOf(const Labels& nearest, const Labels& labelOf)
{
    Labels out(nearest.size(), -1);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i] >= 0) out[i] = labelOf[std::size_t(nearest[i])];
    }
    return out;
}

namespace
{

/// The part of a triangle where a function that is linear in it is negative: if only one corner is,
/// that corner's triangle, whose sides are shares f0 / (f0 - f1) and f0 / (f0 - f2) of its own.
/// @param[in] f  the function at the corners
double negativeShare(std::array<double, 3> f)
{
    std::sort(f.begin(), f.end());
    if (f[2] <= 0.0) return 1.0;
    if (f[0] >= 0.0) return 0.0;
    if (f[1] > 0.0) return f[0] * f[0] / ((f[1] - f[0]) * (f[2] - f[0]));
    return 1.0 - f[2] * f[2] / ((f[2] - f[0]) * (f[2] - f[1]));
}

} // namespace

std::vector<Color> colorsOf(const Labels& nearest, const std::vector<Color>& ballColor)
{
    std::vector<Color> out(nearest.size(), neutralColor);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i] >= 0) out[i] = ballColor[std::size_t(nearest[i])];
    }
    return out;
}

openvdb::BoolGrid::Ptr shownVoxels(const openvdb::FloatGrid& surface, bool inside)
{
    auto grid = gridLike<openvdb::BoolGrid>(surface, "", false);
    if (!inside) return grid;
    grid->tree().topologyUnion(openvdb::tools::sdfInteriorMask(surface)->tree());
    grid->tree().voxelizeActiveTiles();
    return grid;
}

Labels ownersOf(const openvdb::BoolGrid& voxels, const std::vector<Ball>& balls, double reach,
                const Progress& progress)
{
    std::vector<Vec3f> points;
    for (auto it = voxels.cbeginValueOn(); it; ++it)
        points.emplace_back(voxels.indexToWorld(it.getCoord()));
    return nearestBalls(balls, points, reach, progress);
}

std::vector<double> memberAreas(const std::vector<Ball>& balls, const Labels& memberOf,
                                std::size_t members, const Labels& nearest, const Mesh& mesh)
{
    const std::size_t other = members;
    const auto groupOf = [&](std::uint32_t vertex) {
        const std::int32_t g = nearest[vertex] < 0 ? -1 : memberOf[std::size_t(nearest[vertex])];
        return g < 0 ? other : std::size_t(g);
    };
    const auto distance = [&](std::uint32_t from, std::uint32_t owner) {
        if (nearest[owner] < 0) return std::numeric_limits<double>::max();
        const Ball& ball = balls[std::size_t(nearest[owner])];
        return (openvdb::Vec3d(mesh.positions[from]) - ball.center).length() - ball.radius;
    };
    std::vector<double> areas(other + 1, 0.0);
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](int k) { return mesh.positions[t[k]]; };
        const double area =
            0.5 * double((corner(1) - corner(0)).cross(corner(2) - corner(0)).length());
        const std::array<std::size_t, 3> group = {groupOf(t[0]), groupOf(t[1]), groupOf(t[2])};
        const std::size_t second = group[1] != group[0] ? group[1] : group[2];
        if (group[2] != group[0] && group[2] != second) { // three groups
            for (const std::size_t g : group) areas[g] += area / 3.0;
            continue;
        }
        std::array<double, 3> nearer{}; // how much nearer the first group is
        for (int k = 0; k < 3; ++k) {
            std::array<double, 2> least;
            least.fill(std::numeric_limits<double>::max());
            for (int o = 0; o < 3; ++o) {
                double& d = least[group[std::size_t(o)] == group[0] ? 0 : 1];
                d = std::min(d, distance(t[k], t[o]));
            }
            nearer[std::size_t(k)] = least[0] - least[1];
        }
        const double share = second == group[0] ? 1.0 : negativeShare(nearer);
        areas[group[0]] += share * area;
        areas[second] += (1.0 - share) * area;
    }
    return areas;
}

namespace
{

/// A place in [0, 1)^3 for every cell of a lattice: Roberts' low-discrepancy sequence R3.
openvdb::Vec3d placeIn(const Coord& cell)
{
    const auto fraction = [](int i, int j, int k) {
        const double u = i * 0.8191725134 + j * 0.6710436067 + k * 0.5497004779;
        return u - std::floor(u);
    };
    return {fraction(cell.x(), cell.y(), cell.z()), fraction(cell.y(), cell.z(), cell.x()),
            fraction(cell.z(), cell.x(), cell.y())};
}

} // namespace

std::vector<Vec3f> pointsInside(const openvdb::FloatGrid& surface, double volume)
{
    constexpr double enough = 1e5, plenty = 1e6; // points in a small and in a very large volume
    constexpr double most = 4e6;                 // cells that are looked at beside the surface
    const double h = surface.voxelSize()[0];
    const double width =
        std::max(std::min(1.0, std::cbrt(volume / enough)), std::cbrt(volume / plenty)) / h;
    // Along an axis, a cell has `stride` voxels or, if it is smaller, a voxel has `parts` cells:
    // no more than `most` allows, since in a tiny volume few of them are inside.
    const int stride = std::max(1, int(std::floor(width + 1e-9)));
    const double finest = std::cbrt(most / double(surface.activeVoxelCount() + 1));
    const int parts = std::max(1, int(std::min(std::ceil(1.0 / width - 1e-9), finest)));
    openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> phi(surface);
    std::vector<Vec3f> points;
    // Adds a voxel, if the place of its cell lies in it.
    const auto addOne = [&](const Coord& voxel) {
        Coord cell;
        for (int a = 0; a < 3; ++a) {
            cell[a] = (voxel[a] - (voxel[a] < 0 ? stride - 1 : 0)) / stride; // rounded down
        }
        const openvdb::Vec3d at = placeIn(cell) * stride;
        for (int a = 0; a < 3; ++a) {
            if (cell[a] * stride + int(at[a]) != voxel[a]) return;
        }
        points.emplace_back(surface.indexToWorld(voxel));
    };
    // Adds those places of a voxel's cells that are inside; its coordinates are its middle.
    const auto addParts = [&](const Coord& voxel) {
        for (int p = 0; p < parts * parts * parts; ++p) {
            const Coord cell =
                Coord(voxel.x() * parts + p % parts, //
                      voxel.y() * parts + p / parts % parts, voxel.z() * parts + p / parts / parts);
            const openvdb::Vec3d at = (cell.asVec3d() + placeIn(cell)) / parts - 0.5;
            if (phi.isSample(at) < 0.0f) points.emplace_back(surface.indexToWorld(at));
        }
    };
    for (auto it = surface.cbeginValueAll(); it; ++it) {
        // A voxel is whole inside or not; cells of one just outside may be inside.
        if (*it >= (parts > 1 ? float(h) : 0.0f)) continue;
        const openvdb::CoordBBox box = it.getBoundingBox();
        for (auto c = box.begin(); c; ++c) {
            if (parts > 1) {
                addParts(*c);
            } else {
                addOne(*c);
            }
        }
    }
    return points;
}

void labelVertices(const BallSet& atoms, const Labels& nearest, Mesh& mesh)
{
    mesh.labels.push_back({"atom_id", labelsOf(nearest, atomsOf(atoms.balls))});
    if (!atoms.labels) return;
    mesh.labels.push_back({"chain_id", labelsOf(nearest, atoms.labels->chainOf)});
    if (!atoms.labels->groups.empty())
        mesh.labels.push_back({"group_id", labelsOf(nearest, atoms.labels->groupOf)});
}

} // namespace molsurf
