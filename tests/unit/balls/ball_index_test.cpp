// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_index.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

TEST(BallIndex, FindsAllThatAreNearOnceEach)
{
    for (const Vec3d& centre : {Vec3d(0.0), Vec3d(-90.0, 5000.0, -999000.0)}) {
        std::vector<Ball> balls = test::randomBalls(800, 40.0, centre, 4);
        balls.push_back(balls.front()); // at the same place
        balls.back().atom = 800;
        for (int k = 0; k < 6; ++k) { // far larger ones
            balls[std::size_t(100 * k)].radius *= float(5 << 2 * k);
        }
        for (const double cell : {1.0, 3.3, 50.0}) {
            const BallIndex index(balls, {0.5, 0.0, cell});
            for (const Ball& box : test::randomBalls(30, 50.0, centre, 5)) {
                const Vec3d low(box.center), high = low + Vec3d(3.5, 0.0, 1.0);
                const double reach = 2.0 * box.radius;
                std::set<std::int32_t> found;
                index.forEachNear(low, high, reach, [&](const Ball& ball, std::int32_t i) {
                    EXPECT_TRUE(found.insert(i).second) << "twice: " << i;
                    EXPECT_EQ(ball.atom, balls[i].atom);
                });
                for (std::size_t i = 0; i < balls.size(); ++i) {
                    const Vec3d c(balls[i].center);
                    const Vec3d nearest =
                        openvdb::math::maxComponent(low, openvdb::math::minComponent(high, c));
                    if ((c - nearest).length() > reach + balls[i].radius) continue;
                    EXPECT_TRUE(found.count(int(i)));
                }
            }
        }
    }
}

TEST(BallIndex, AsksNoFurtherThanTheFirstThatHolds)
{
    const std::vector<Ball> balls = test::randomBalls(800, 20.0, Vec3d(0.0), 4);
    const BallIndex index(balls, {0.5, 0.0, 3.3});
    int asked = 0;
    EXPECT_TRUE(
        index.anyNear(Vec3d(0.0), Vec3d(0.0), 30.0, [&](const Ball&) { return ++asked == 5; }));
    EXPECT_EQ(asked, 5);
    asked = 0;
    EXPECT_FALSE(
        index.anyNear(Vec3d(0.0), Vec3d(0.0), 60.0, [&](const Ball&) { return ++asked > 800; }));
    EXPECT_EQ(asked, 800);
}

// A box with more cells than a ball list can have: a ball of 0.02 mm beside atoms.
TEST(BallIndex, TakesNoTimeWhereABoxIsWide)
{
    std::vector<Ball> balls = test::randomBalls(800, 40.0, Vec3d(-3e5, 2e5, 9e5), 4);
    balls.push_back({openvdb::Vec3f(8e5f, -9e5f, 0.0f), 1.5f, 800}); // as if it were near: 21 bits
    const BallIndex index(balls, {0.0, 0.0, 1.0});
    for (const double gap : {2e4, 177777.0, 1e6}) {
        const Vec3d place = Vec3d(balls[0].center) + Vec3d(0.9 * gap, 0.0, -0.3 * gap);
        std::set<std::int32_t> found;
        index.forEachNear(place, place, gap, [&](const Ball&, std::int32_t i) {
            EXPECT_TRUE(found.insert(i).second) << "twice: " << i;
        });
        EXPECT_EQ(found.size(), 800u);
        EXPECT_EQ(found.count(800), 0u);
    }
}

TEST(BallIndex, LeavesOutWhatIsFar)
{
    const std::vector<Ball> balls = test::randomBalls(800, 40.0, Vec3d(0.0), 4);
    const BallIndex index(balls, {0.0, 0.0, 2.0});
    std::size_t found = 0;
    index.forEachNear(Vec3d(0.0), Vec3d(2.0), 1.0, [&](const Ball& ball, int) {
        ++found;
        for (int i = 0; i < 3; ++i) {
            EXPECT_GT(ball.center[i], -5.01f);
            EXPECT_LT(ball.center[i], 7.01f);
        }
    });
    EXPECT_LT(found, 100u);
}

} // namespace
} // namespace molsurf
