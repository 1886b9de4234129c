// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/map_grids.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"

#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// A grid of all points of a map, multiplied.
/// @param[in] background  also the value that makes points inactive
openvdb::FloatGrid::Ptr gridOf(const ScalarMap& map, float factor, float background)
{
    const auto grid = openvdb::FloatGrid::create(background);
    auto to = grid->getAccessor();
    std::size_t i = 0;
    openvdb::Coord at;
    for (at[0] = 0; at[0] < int(map.counts[0]); ++at[0])
        for (at[1] = 0; at[1] < int(map.counts[1]); ++at[1])
            for (at[2] = 0; at[2] < int(map.counts[2]); ++at[2], ++i)
                if (map.values[i] != background) to.setValue(at, factor * map.values[i]);
    openvdb::math::Mat4d matrix = openvdb::math::Mat4d::identity();
    matrix.postScale(map.spacing);
    matrix.setTranslation(map.origin);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    return grid;
}

/// The values of a map at the points of a lattice with one spacing for all axes.
ScalarMap onCubes(const ScalarMap& map, double spacing)
{
    ScalarMap out;
    out.origin = map.origin;
    out.spacing = openvdb::Vec3d(spacing);
    constexpr double rounding = 1e-9; // lest the last point is lost, or lies outside
    openvdb::Vec3d last;
    double points = 1.0;
    for (int a = 0; a < 3; ++a) {
        const double steps = double(map.counts[a] - 1), extent = steps * map.spacing[a];
        last[a] = (steps - rounding) * map.spacing[a];
        points *= extent / spacing + 1.0;
        out.counts[a] = std::size_t(extent / spacing * (1.0 + rounding)) + 1;
    }
    constexpr double most = 2147483647.0; // as of maps that are read
    if (points > most)
        throw Error(ErrorKind::Usage, "`iso`: on cubes of " + shortest(spacing) +
                                          " Å the map has " + formatted("%.3g", points) +
                                          " points, expected at most 2^31");
    out.values.reserve(out.counts[0] * out.counts[1] * out.counts[2]);
    for (std::size_t x = 0; x < out.counts[0]; ++x)
        for (std::size_t y = 0; y < out.counts[1]; ++y)
            for (std::size_t z = 0; z < out.counts[2]; ++z) {
                const auto away = spacing * openvdb::Vec3d(double(x), double(y), double(z));
                out.values.push_back(map.at(map.origin + openvdb::math::minComponent(away, last)));
            }
    return out;
}

} // namespace

openvdb::FloatGrid::Ptr fogOf(const ScalarMap& map)
{
    const auto grid = gridOf(map, 1.0f, 0.0f);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    return grid;
}

openvdb::FloatGrid::Ptr levelSetOf(const ScalarMap& map, double iso)
{
    const double voxel = map.spacing[openvdb::math::MinIndex(map.spacing)];
    if ((map.spacing - openvdb::Vec3d(voxel)).length() > 1e-4 * voxel)
        return levelSetOf(onCubes(map, voxel), iso);
    const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
    if (!(double(*least) < iso && iso < double(*most)))
        throw Error(ErrorKind::Usage, "`iso`: expected a value between those of the map, " +
                                          shortest(*least) + " and " + shortest(*most) + ", got " +
                                          shortest(iso));
    const float sign = iso < 0.0 ? -1.0f : 1.0f;
    // Beside the box there is less than any value.
    const float nothing = -2.0f * std::max(std::abs(*least), std::abs(*most));
    const auto fog = gridOf(map, sign, nothing);
    const auto value = float(std::abs(iso));
    constexpr int band = 4; // [voxel]: one more than is kept
    const auto mask = openvdb::tools::extractIsosurfaceMask(*fog, value);
    openvdb::tools::dilateActiveValues(mask->tree(), band, openvdb::tools::NN_FACE_EDGE_VERTEX);
    fog->tree().topologyIntersection(mask->tree());
    // It keeps cavities, which levelSetRebuild() fills.
    const auto grid = openvdb::tools::fogToSdf(*fog, value);
    const auto width = float(3.0 * voxel);
    for (auto voxels = grid->beginValueOn(); voxels; ++voxels) {
        if (std::abs(*voxels) < width) continue;
        voxels.setValue(std::copysign(width, *voxels));
        voxels.setActiveState(false);
    }
    openvdb::tools::changeBackground(grid->tree(), width);
    openvdb::tools::signedFloodFillWithValues(grid->tree(), width, -width);
    openvdb::tools::pruneLevelSet(grid->tree());
    grid->setName("surface");
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
}

} // namespace molsurf
