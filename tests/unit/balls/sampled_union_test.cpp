// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/sampled_union.h"

#include "molsurf/kernel/pipeline/closed_form.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

/// Area and volume in closed form.
std::pair<double, double> exactOf(std::vector<Ball> balls, double grown)
{
    SurfaceSpec spec;
    spec.kind = SurfaceKind::VanDerWaals;
    for (Ball& ball : balls) ball.radius += float(grown);
    std::pair<double, double> sum;
    for (const BoundaryPiece& piece : measureClosedForm(balls, spec, Progress()).pieces) {
        sum.first += piece.area;
        sum.second += piece.volume;
    }
    return sum;
}

} // namespace

TEST(SampledUnion, IsThatOfTheClosedForm)
{
    for (const std::size_t count : {1u, 300u, 20000u}) {
        const double edge = 3.0 * std::cbrt(double(count));
        const std::vector<Ball> balls = test::randomBalls(int(count), edge, openvdb::Vec3d(2.0), 7);
        for (const double grown : {0.0, 1.4, 5.0}) {
            const auto [area, volume] = exactOf(balls, grown);
            double whole = 0.0;
            for (const Ball& b : balls) whole += 4.0 * M_PI * std::pow(b.radius + grown, 2);
            const double share = area / whole, error = std::sqrt((1.0 - share) / share / 8192.0);
            EXPECT_NEAR(sampledArea(balls, grown), area, (0.01 + 2.0 * error) * area)
                << count << " " << grown;
            EXPECT_NEAR(sampledVolume(balls, grown), volume, 0.08 * volume)
                << count << " " << grown;
        }
    }
}

// A large ball among many small ones has nearly all of the area.
TEST(SampledUnion, HasTheLargeBall)
{
    std::vector<Ball> balls = test::randomBalls(5000, 40.0, openvdb::Vec3d(0.0), 7);
    balls.push_back({openvdb::Vec3f(500.0f, 0.0f, 0.0f), 400.0f, 0});
    const auto [area, volume] = exactOf(balls, 0.0);
    EXPECT_NEAR(sampledArea(balls, 0.0), area, 0.03 * area);
    EXPECT_NEAR(sampledVolume(balls, 0.0), volume, 0.03 * volume);
}

TEST(SampledUnion, OfNothingIsNothing)
{
    const std::vector<Ball> none;
    EXPECT_EQ(sampledArea(none, 1.0), 0.0);
    EXPECT_EQ(sampledVolume(none, 1.0), 0.0);
}

// The same bits: a plan of an assembly that is not unfolded is that of all its balls.
TEST(SampledUnion, RepeatedBallsAreThoseThatMotionsMakeOfThem)
{
    const std::vector<Ball> balls = {
        {{0.0, 0.0, 0.0}, 1.5, 0}, {{1.7, 0.3, 0.2}, 1.2, 1}, {{9.0, 0.0, 0.0}, 2.5, 2}};
    const double c = std::cos(0.3), s = std::sin(0.3);
    const Motion turn{{{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}}, {3.0, 1.0, -2.0}};
    const RepeatedBalls whole(balls, {{Motion::identity(), 0, 2}, {turn, 0, 2}, {turn, 2, 3}});
    const std::vector<Ball> all = whole.unfolded();
    ASSERT_EQ(all.size(), 5u);
    EXPECT_EQ(all[3].center, turn.placed(balls[1].center));
    EXPECT_EQ(all[4].radius, 2.5);
    EXPECT_EQ(sampledArea(whole, 1.4), sampledArea(all, 1.4));
    EXPECT_EQ(sampledVolume(whole, 1.4), sampledVolume(all, 1.4));
}

} // namespace molsurf
