// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/value_colors.h"

#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/show/color/palette.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

BallSet valued(const std::vector<Ball>& balls, const std::vector<float>& values)
{
    BallSet atoms;
    atoms.balls = balls;
    BallValues of;
    of.valueOf = values;
    atoms.labels.emplace().values = of;
    return atoms;
}

// By the distance from its centre a ball has one colour, on all voxels beside its surface.
TEST(ValueGrid, IsThatOfTheSurfaceNotOfTheVoxel)
{
    const auto surface = test::ballGrid();
    BallSet atoms = valued({}, {});
    BallValues& values = *atoms.labels->values;
    values.high = 10.0;
    values.centre = Vec3d(0.3, 1.2, -0.7);
    const PointValues points(atoms, 1.4);
    const auto voxels = shownVoxels(*surface, false);
    const std::vector<PointValue> found = points.on(*voxels, *surface, 2.0, Progress());
    ASSERT_EQ(found.size(), surface->activeVoxelCount());
    const Vec3f wanted = linearLight(scaleOf(values).at(5.0));
    std::size_t seen = 0, i = 0;
    for (auto voxel = surface->cbeginValueOn(); voxel; ++voxel, ++i) {
        if (std::abs(*voxel) > 0.5f) continue;
        ++seen;
        const Vec3f color = linearLight(points.colorOf(found[i]));
        ASSERT_LT((color - wanted).length(), 0.01f) << *voxel;
    }
    EXPECT_GT(seen, 2000u);
}

// The other way a colour is found: at a vertex, so far outside of the surface.
TEST(PointValues, OfAMapAreOutsideAlongTheNormal)
{
    BallSet atoms = valued({}, {});
    ScalarMap map;
    map.origin = Vec3d(-10.0);
    map.spacing = Vec3d(20.0);
    std::fill_n(map.counts, 3, 2);
    map.values = {-10, -10, -10, -10, 10, 10, 10, 10}; // x
    atoms.labels->values->field = std::make_shared<ScalarMap>(map);
    SurfaceOptions options;
    options.probe = 1.5;
    const auto at = [&](const Vec3d& normal) {
        return PointValues(atoms, outwardOf(atoms.coloring, options))
            .at({2, 3, 4}, normal, 1.0)
            .value;
    };
    EXPECT_FLOAT_EQ(at({1, 0, 0}), 3.5f);
    EXPECT_FLOAT_EQ(at({-0.6, 0.8, 0}), 1.1f);
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::SmoothAccessible}) {
        options.kind = kind; // a probe radius out itself
        EXPECT_FLOAT_EQ(at({1, 0, 0}), 2.0f);
    }
    atoms.coloring.potentialOffset = 0.25;
    EXPECT_FLOAT_EQ(at({1, 0, 0}), 2.25f);
}

/// Two balls a bond apart, and what a point beside them has.
struct BlendTest : testing::Test {
    BallSet atoms = valued({{Vec3d(0.0), 1.7, 0}, {Vec3d(1.5, 0, 0), 1.7, 1}, {{9, 0, 0}, 1.7, 2}},
                           {10.0f, 30.0f, 50.0f});
    PointValue at(double x, double y) const
    {
        return PointValues(atoms, 1.4).at({x, y, 0.0}, Vec3d(0.0), 2.0);
    }
};

TEST_F(BlendTest, IsTheMeanBetweenTwoAndTheirOwnFarAway)
{
    EXPECT_FLOAT_EQ(at(0.75, 1.6).value, 20.0f);
    EXPECT_FLOAT_EQ(at(10.7, 0.0).value, 50.0f);
    EXPECT_FLOAT_EQ(at(0.75, 1.6).share, 1.0f);
    // 1 / (1 + exp(-e/3)), e = 3 (0.75 - x), but for the end of the weights.
    const double weight = std::exp(-0.75), cut = std::exp(-8.0);
    EXPECT_NEAR(at(0.5, 1.6).value, 10.0 + 20.0 * std::exp(-0.25) / (1.0 + std::exp(-0.25)), 0.01);
    EXPECT_NEAR(at(0.0, 1.6).value, 10.0 + 20.0 * (weight - cut) / (1.0 + weight - 2.0 * cut),
                1e-4);
    // A ball whose surface is 1.5 Å away still weighs something.
    const double far = std::exp(-(3.2 * 3.2 - 1.7 * 1.7) / 3.0);
    EXPECT_NEAR(at(-1.7, 0.0).value, 10.0 + 20.0 * (far - cut) / (1.0 + far - 2.0 * cut), 1e-4);
}

TEST_F(BlendTest, HasNoJumps)
{
    float last = at(-1.7, 1.2).value;
    for (double x = -1.69; x < 3.2; x += 0.01) {
        const float here = at(x, 1.2).value;
        ASSERT_LE(std::abs(here - last), 20.0 * 0.25 * 0.0101) << x; // its slope
        last = here;
    }
}

TEST_F(BlendTest, FadesToNoValueWhereBallsHaveNone)
{
    atoms.labels->values->valueOf[1] = atoms.labels->values->valueOf[2] = std::nanf("");
    const PointValues values(atoms, 1.4);
    EXPECT_FLOAT_EQ(at(0.75, 1.6).share, 0.5f);
    EXPECT_FLOAT_EQ(at(0.75, 1.6).value, 10.0f);
    EXPECT_TRUE(std::isnan(at(10.7, 0.0).value));
    EXPECT_EQ(values.colorOf(at(10.7, 0.0)), noValueColor);
    Mesh mesh;
    mesh.positions = {Vec3f(0.7f, 1.6f, 0), Vec3f(0.8f, 1.6f, 0)};
    mesh.normals.resize(2);
    mesh.colors.resize(2);
    const BallValues& own = *atoms.labels->values;
    addValues(own, values, vertexValues(values, own, {0, 1}, 2.0, Progress(), mesh), mesh);
    EXPECT_EQ(mesh.scalars[0].values[0], 10.0f);
    EXPECT_TRUE(std::isnan(mesh.scalars[0].values[1]));
}

TEST_F(BlendTest, FlatValuesAreThoseOfTheBall)
{
    atoms.labels->values->flat = true;
    Mesh mesh;
    mesh.positions = {Vec3f(0.7f, 1.6f, 0)};
    mesh.normals.resize(1);
    mesh.colors = {Color{1, 2, 3}};
    const PointValues points(atoms, 1.4);
    const BallValues& own = *atoms.labels->values;
    addValues(own, points, vertexValues(points, own, {0}, 2.0, Progress(), mesh), mesh);
    EXPECT_EQ(mesh.scalars[0].values[0], 10.0f);
    EXPECT_EQ(mesh.colors[0], (Color{1, 2, 3})); // of its ball, as it was
}

TEST(ValueColors, OfOneValueAreNeutral)
{
    BallValues values;
    values.valueOf = {7.0f, 7.0f};
    values.low = values.high = 7.0;
    EXPECT_EQ(valueColors(values), std::vector<Color>(2, neutralColor));
}

} // namespace
} // namespace molsurf
