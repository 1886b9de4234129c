// SPDX-License-Identifier: MPL-2.0
#include "molsurf/topology/closed_passages.h"
#include "molsurf/topology/gaps_of_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double carbon = 1.7, grown = carbon + 1.4; // [Å], with the probe

/// Points that cover a sphere evenly, by the golden angle.
std::vector<Ball> cage(int count, double distance)
{
    const double turn = M_PI * (3.0 - std::sqrt(5.0));
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
        balls.push_back(
            {distance * Vec3d(r * std::cos(turn * i), r * std::sin(turn * i), z), carbon, 0});
    }
    return balls;
}

/// Rings of ten atoms about an axis, open at both ends.
std::vector<Ball> tube(int rings, double distance)
{
    std::vector<Ball> balls;
    for (int k = 0; k < rings; ++k) {
        for (int i = 0; i < 10; ++i) {
            const double angle = 2.0 * M_PI * (i + 0.5 * (k % 2)) / 10;
            balls.push_back({{distance * std::cos(angle), distance * std::sin(angle),
                              1.2 * (k - 0.5 * (rings - 1))},
                             carbon,
                             0});
        }
    }
    return balls;
}

GapReport gapsOf(const std::vector<Ball>& balls, double voxel, double epsilon,
                 GapRule rule = {0.01}, double probe = 1.4)
{
    GaussianOptions options;
    options.probe = probe;
    options.epsilon = epsilon;
    options.voxelSize = voxel;
    options.reach = 4.5 * voxel;
    GaussianSum sum(balls, options);
    GapReport report;
    sum.band(3, Progress(), openvdb::CoordBBox::inf(), [&](const SparseField& psi) {
        return bumpsOfGaps(sum, psi, rule, Progress(), report);
    });
    return report;
}

TEST(ClosedPassages, OfACageHaveTheRoomBesideAProbe)
{
    for (const double room : {0.3, 0.5, 0.8, 1.2}) {
        for (const double voxel : {1.0, 0.5, 0.2}) { // of the last some leaves are all inside
            const GapReport report = gapsOf(cage(60, grown + room), voxel, 0.5);
            ASSERT_TRUE(report.closedByField);
            EXPECT_EQ(*report.closedByField, 1u) << room << " " << voxel;
            EXPECT_NEAR(report.widestClosed, room, 0.02) << room << " " << voxel;
        }
    }
}

TEST(ClosedPassages, AreNotThoseThatABallCovers)
{
    const GapReport report = gapsOf(cage(60, grown - 0.1), 0.5, 0.5);
    EXPECT_EQ(report.closedByField, std::optional<std::size_t>(0));
    EXPECT_EQ(report.widestClosed, 0.0);
}

TEST(ClosedPassages, AreNotThoseThatAreOpen)
{
    EXPECT_EQ(*gapsOf(cage(60, grown + 2.0), 0.5, 0.5).closedByField, 0u);
    EXPECT_EQ(*gapsOf(tube(12, grown + 2.0), 0.5, 0.5).closedByField, 0u);
}

TEST(ClosedPassages, OfATubeAreOne)
{
    const GapReport report = gapsOf(tube(12, grown + 0.8), 0.5, 0.5);
    EXPECT_EQ(*report.closedByField, 1u);
    std::vector<Ball> two = tube(12, grown + 0.8);
    for (const Ball& ball : tube(12, grown + 0.8))
        two.push_back({ball.center + Vec3d(40, 0, 0), carbon, 0});
    EXPECT_EQ(*gapsOf(two, 0.5, 0.5).closedByField, 2u);
}

/// Voids beside each other are two, however near, and the widest counts.
TEST(ClosedPassages, OfTwoCagesThatTouchAreTwo)
{
    std::vector<Ball> two = cage(60, grown + 0.8);
    for (const Ball& ball : cage(60, grown + 0.4))
        two.push_back({ball.center + Vec3d(7.5, 0, 0), carbon, 0});
    const GapReport report = gapsOf(two, 0.5, 0.5);
    EXPECT_EQ(*report.closedByField, 2u);
    EXPECT_NEAR(report.widestClosed, 0.8, 0.05);
}

/// One ball is nearer than the others, in whichever cell of the index it lies.
TEST(ClosedPassages, HaveOneRoomInAllPlaces)
{
    std::vector<Ball> balls = cage(60, carbon + 6.0 + 0.8);
    balls[0].center *= 0.9;
    const double room = gapsOf(balls, 0.5, 0.5, {0.01}, 6.0).widestClosed;
    EXPECT_GT(room, 0.05);
    for (int k = 1; k < 8; ++k) {
        for (Ball& ball : balls) ball.center += Vec3d(1.5);
        EXPECT_NEAR(gapsOf(balls, 0.5, 0.5, {0.01}, 6.0).widestClosed, room, 0.01) << k;
    }
}

TEST(ClosedPassages, OpenBelowTheToleranceThatTheReportHas)
{
    for (const double room : {0.5, 0.8, 1.2}) {
        const std::vector<Ball> balls = cage(60, grown + room);
        const double opens = gapsOf(balls, 0.5, 0.5).opensBelow;
        EXPECT_GT(opens, 0.05);
        EXPECT_EQ(*gapsOf(balls, 0.2, 0.97 * opens).closedByField, 0u) << room;
        EXPECT_EQ(*gapsOf(balls, 0.2, 1.2 * opens).closedByField, 1u) << room;
    }
}

TEST(ClosedPassages, AreNotCountedWhereBallsHaveRates)
{
    EXPECT_FALSE(gapsOf(cage(60, grown + 0.5), 0.5, 0.5, {0.01, 0.0, false}).closedByField);
}

} // namespace
} // namespace molsurf
