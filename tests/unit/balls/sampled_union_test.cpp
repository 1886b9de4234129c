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
    EXPECT_EQ(sampledArea({}, 1.0), 0.0);
    EXPECT_EQ(sampledVolume({}, 1.0), 0.0);
}

} // namespace molsurf
