// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/depth.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

TEST(Depth, IsTheRadiusOfOneBall)
{
    for (const double probe : {0.0, 1.4, 30.0}) {
        const auto depths =
            depthsOf({{Vec3d(1.0), 1.7, 0}}, probe, {Vec3d(1.0), Vec3d(1.0, 1.0, 1.5)}, Progress());
        EXPECT_NEAR(depths[0], 1.7, 1e-8);
        EXPECT_NEAR(depths[1], 1.2, 1e-8);
    }
}

// Between two balls the probe that rolls about them reaches nearest to their middle.
TEST(Depth, BetweenTwoBallsIsThatOfTheNeck)
{
    const double r = 1.7, probe = 1.4, half = 1.5;
    const auto depths = depthsOf({{Vec3d(0.0), r, 0}, {Vec3d(0.0, 0.0, 2.0 * half), r, 1}}, probe,
                                 {Vec3d(0.0, 0.0, half)}, Progress());
    EXPECT_NEAR(depths[0], std::sqrt((r + probe) * (r + probe) - half * half) - probe, 1e-8);
}

/// Balls on a sphere about 0, closed.
std::vector<Ball> shellOf(int count, double radius)
{
    std::vector<Ball> out;
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / count, angle = 3.883222 * k;
        const double across = std::sqrt(1.0 - z * z);
        out.push_back(
            {radius * Vec3d(across * std::cos(angle), across * std::sin(angle), z), 1.7, k});
    }
    return out;
}

// A shell of balls about a void for a probe, closed and with a hole.
TEST(Depth, IsNotFromCavities)
{
    constexpr double radius = 12.0;
    std::vector<Ball> shell = shellOf(400, radius);
    shell.push_back({Vec3d(radius - 3.0, 0.0, 0.0), 1.7, 400});
    const Vec3d x = shell.back().center;
    EXPECT_NEAR(depthsOf(shell, 1.4, {x}, Progress())[0], 4.4, 0.3);
    shell.erase(shell.begin(), shell.begin() + 12); // those about the pole
    EXPECT_NEAR(depthsOf(shell, 1.4, {x}, Progress())[0], 1.7, 1e-6);
}

// What lies apart in a closed void is as deep as the shell about it is outside; so is what lies in
// a void of that. What lies beside the shell is not.
TEST(Depth, IsNotFromBodiesInCavities)
{
    std::vector<Ball> balls = shellOf(700, 15.0);
    for (const Ball& ball : shellOf(100, 6.0)) balls.push_back(ball);
    balls.push_back({Vec3d(0.0), 1.5, 800});
    balls.push_back({Vec3d(0.0, 0.0, 40.0), 1.5, 801});
    const auto depths =
        depthsOf(balls, 1.4, {Vec3d(0.0), balls[750].center, Vec3d(0.0, 0.0, 40.0)}, Progress());
    EXPECT_NEAR(depths[0], 16.7, 0.6); // between atoms it is less
    EXPECT_NEAR(depths[1], 10.7, 0.6);
    EXPECT_NEAR(depths[2], 1.5, 1e-6);
}

// By definition: the nearest of many places of the probe that touch no ball.
TEST(Depth, IsTheNearestProbeOfAMolecule)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    constexpr double probe = 1.4, step = 0.25;
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < balls.size(); i += 40) points.push_back(balls[i].center);
    const auto depths = depthsOf(balls, probe, points, Progress());
    for (std::size_t p = 0; p < points.size(); ++p) {
        double least = 100.0;
        for (double x = -10.0; x <= 10.0; x += step)
            for (double y = -10.0; y <= 10.0; y += step)
                for (double z = -10.0; z <= 10.0; z += step) {
                    const Vec3d way(x, y, z), centre = points[p] + way;
                    if (way.length() - probe >= least) continue;
                    bool isFree = true;
                    for (const Ball& ball : balls)
                        isFree = isFree && (ball.center - centre).length() >= ball.radius + probe;
                    if (isFree) least = way.length() - probe;
                }
        EXPECT_LE(depths[p], least + 1e-6) << p;
        EXPECT_GE(depths[p], least - step) << p;
    }
}

} // namespace
} // namespace molsurf
