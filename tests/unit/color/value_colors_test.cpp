// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/value_colors.h"

#include "molsurf/selection/scalar_map.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

// By the distance from its centre a ball has one colour, on all voxels beside its surface.
TEST(ValueGrid, IsThatOfTheSurfaceNotOfTheVoxel)
{
    const auto surface = test::ballGrid();
    const BallValues values{
        "radius", "", "", BallValues::Map::Magnitude, 0.0, 10.0, Vec3d(0.3, 1.2, -0.7)};
    const auto grid =
        openvdb::gridPtrCast<openvdb::Vec3SGrid>(valueGrid(*surface, values, Progress()));
    const Vec3f wanted = linearLight(scaleOf(values).at(5.0));
    std::size_t seen = 0;
    for (auto voxel = surface->cbeginValueOn(); voxel; ++voxel) {
        if (std::abs(*voxel) > 0.5f) continue;
        ++seen;
        const Vec3f found = grid->tree().getValue(voxel.getCoord());
        ASSERT_LT((found - wanted).length(), 0.01f) << *voxel;
    }
    EXPECT_GT(seen, 2000u);
}

// The other way a colour is found: at a vertex, so far outside of the surface.
TEST(ValueAt, IsOutsideAlongTheNormal)
{
    BallValues values;
    ScalarMap map;
    map.origin = Vec3d(-10.0);
    map.spacing = Vec3d(20.0);
    std::fill_n(map.counts, 3, 2);
    map.values = {-10, -10, -10, -10, 10, 10, 10, 10}; // x
    values.field = std::make_shared<ScalarMap>(map);
    values.outward = 1.5;
    EXPECT_FLOAT_EQ(valueAt(values, {2, 3, 4}, {1, 0, 0}), 3.5f);
    EXPECT_FLOAT_EQ(valueAt(values, {2, 3, 4}, {-0.6, 0.8, 0}), 1.1f);
}

} // namespace
} // namespace molsurf
