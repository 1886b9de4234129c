// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/unit_cut.h"

#include "molsurf/kernel/mesh/measure.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

// A sphere and three owners about its axis: each has a third, and the borders are meridians.
TEST(CutToOwner, TakesAThirdOfASphere)
{
    constexpr double R = 3.0, voxel = 0.5;
    const test::Shape ball = test::sphere(R);
    Mesh mesh = test::meshOf(ball, voxel);
    const std::vector<float> zeros(mesh.positions.size(), 0.0f);
    mesh.scalars = {{"mean", zeros}, {"gauss", zeros}};
    const Spline spline =
        test::splineOf(ball.distance, ball.distance, ball.centre, ball.extent, voxel, 6.0 * voxel);
    std::vector<Ball> balls;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * M_PI * i / 3.0 + 0.2;
        balls.push_back({ball.centre + 2.5 * Vec3d(std::cos(angle), std::sin(angle), 0.0), 1.0, i});
    }
    const CutMesh cut = cutToOwner(mesh, PowerOwners(balls, {0, 1, 2}), spline, Progress());

    EXPECT_NEAR(measure(cut.mesh, Progress()).area, 4.0 * M_PI * R * R / 3.0, 0.05);
    const std::vector<BorderEdge>& border = cut.border;
    std::size_t corners = 0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        ASSERT_EQ(border[i].next, (i + 1) % border.size()); // one line
        const BorderEdge& last = border[border[i].previous];
        ASSERT_EQ(last.next, i);
        const Vec3d a(cut.mesh.positions[border[i].from]);
        const Vec3d b(cut.mesh.positions[border[border[i].next].from]);
        EXPECT_NEAR((a - ball.centre).length(), R, 2e-3);
        // Power cells have plane borders, so that the middle of an edge lies in one, too: in that
        // with the owner beyond the edge, who is the nearest other one there.
        const Vec3d middle = 0.5 * (a + b);
        const auto power = [&](std::int32_t k) {
            return (middle - balls[std::size_t(k)].center).lengthSqr();
        };
        const std::int32_t other = border[i].owner;
        EXPECT_NEAR(power(0), power(other), 2e-3);
        EXPECT_LT(power(other), power(3 - other) + 2e-3);
        if (last.owner == other) continue;
        ++corners;
        EXPECT_NEAR(std::hypot(a.x() - ball.centre.x(), a.y() - ball.centre.y()), 0.0, 1e-3);
    }
    EXPECT_EQ(corners, 2u);
}

} // namespace
} // namespace molsurf
