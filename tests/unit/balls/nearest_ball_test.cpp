// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/nearest_ball.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

TEST(NearestBalls, AgreesWithASearch)
{
    const std::vector<Ball> balls = test::randomBalls(300, 30.0, Vec3d(7.0, -50.0, 2.0), 8);
    std::vector<Vec3f> points;
    for (const Ball& ball : test::randomBalls(3000, 44.0, Vec3d(7.0, -50.0, 2.0), 9))
        points.push_back(ball.center);
    const float reach = 2.5f;
    const auto found = nearestBalls(balls, points, reach, Progress());
    ASSERT_EQ(found.size(), points.size());
    int none = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        double best = 1e30;
        for (const Ball& ball : balls)
            best = std::min(best, (Vec3d(points[p]) - Vec3d(ball.center)).length() - ball.radius);
        if (found[p] < 0) {
            EXPECT_GT(best, reach - 1e-5);
            ++none;
        } else {
            const Ball& ball = balls[found[p]];
            EXPECT_NEAR((Vec3d(points[p]) - Vec3d(ball.center)).length() - ball.radius, best, 1e-5);
        }
    }
    EXPECT_GT(none, 100);
    EXPECT_LT(none, 2900);
}

// A large ball far away wins over a small one nearby whose surface is farther.
TEST(NearestBalls, MeasuresToTheSurfaceAndTakesTheFirstOfEquals)
{
    const std::vector<Ball> balls = {{Vec3f(0.0f), 1.0f, 0},
                                     {Vec3f(10.0f, 0.0f, 0.0f), 8.0f, 1},
                                     {Vec3f(10.0f, 0.0f, 0.0f), 8.0f, 2}};
    const std::vector<Vec3f> points = {Vec3f(1.7f, 0.0f, 0.0f), Vec3f(1.3f, 0.0f, 0.0f)};
    EXPECT_EQ(nearestBalls(balls, points, 5.0, Progress()), (std::vector<std::int32_t>{1, 0}));
    EXPECT_TRUE(nearestBalls(balls, {}, 5.0, Progress()).empty());
}

} // namespace
} // namespace molsurf
