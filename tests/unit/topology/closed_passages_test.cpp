// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/closed_passages.h"
#include "molsurf/kernel/topology/gaps_of_sum.h"

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
    DecidedGaps found;
    sum.band(3, Progress(), openvdb::CoordBBox::inf(), [&](const SparseField& psi) {
        return bumpsOfGaps(sum, psi, rule, Progress(), report, &found);
    });
    countClosed(
        found.passages, [](const Vec3d&) { return true; }, report);
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

/// A pore is closed where one of its places is, and the report is of those alone.
TEST(ClosedPassages, AreThoseWhereTheSurfaceIsClosed)
{
    const std::vector<ClosedPassage> all = {{{0, 0, 0}, 0.9, 0.1, 0},
                                            {{1, 0, 0}, 0.5, 0.3, 1},
                                            {{2, 0, 0}, 0.45, 0.2, 1},
                                            {{3, 0, 0}, 0.3, 0.05, 1}};
    GapReport report;
    countClosed(
        all, [](const Vec3d& x) { return x.x() > 0.5; }, report);
    EXPECT_EQ(report.closedByField, 1u);
    EXPECT_EQ(report.widestClosed, 0.5);
    EXPECT_EQ(report.opensBelow, 0.2);
    GapReport none;
    countClosed(
        all, [](const Vec3d&) { return false; }, none);
    EXPECT_EQ(none.closedByField, 0u);
    EXPECT_EQ(none.widestClosed, 0.0);
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

TEST(ClosedPassages, AreNotLookedForWhereBallsHaveRates)
{
    EXPECT_EQ(gapsOf(cage(60, grown + 0.5), 0.5, 0.5).closedByField, 1u);
    EXPECT_EQ(gapsOf(cage(60, grown + 0.5), 0.5, 0.5, {0.01, 0.0, false}).closedByField, 0u);
}

/// Places of psi as given, in a row along x with room about them; psi between them is `between`.
/// At place i the field opens with a tolerance opens[i] times smaller.
GapReport closedAmong(const std::vector<Gap>& gaps, double between,
                      const std::vector<double>& opens, const GapRule& rule, double epsilon)
{
    const auto at = [](double psi) { return PsiJet{psi, Vec3d(0.0), openvdb::Mat3d::zero()}; };
    const PassageField field{[=](const Vec3d&) { return at(between); },
                             [](const Vec3d&) { return 0.5; },
                             [=](const Vec3d& x, double times) {
                                 const double limit = opens[std::size_t(std::lround(x.x()))];
                                 return at(times < limit ? 1.0 : -1.0);
                             }};
    GapReport report;
    countClosed(
        closedPassages(gaps, field, rule, epsilon, Progress()), [](const Vec3d&) { return true; },
        report);
    return report;
}

Gap gapOf(double x, double psi, const Vec3d& curvatures)
{
    Gap gap{};
    gap.place = Vec3d(x, 0.0, 0.0);
    gap.psi = psi;
    gap.curvatures = curvatures;
    return gap;
}

// Tension closes a void below zero, and its neck at zero; psi between them needs to be above the
// lower of both, in whichever order they come.
TEST(ClosedPassages, OfAVoidAndItsNeckAreOne)
{
    const Vec3d tight(4.0), none(-1.0);
    const GapRule rule{0.05};
    ASSERT_EQ(gapOf(0.0, 0.0, tight).closedAbove(rule.gradient, 0.0), -1.5);
    ASSERT_EQ(gapOf(0.0, 0.0, none).closedAbove(rule.gradient, 0.0), 0.0);
    const std::vector<double> opens = {2.0, 2.0};
    for (const bool first : {true, false}) {
        const std::vector<Gap> gaps = {gapOf(0.0, 0.3, first ? tight : none),
                                       gapOf(1.0, 0.3, first ? none : tight)};
        EXPECT_EQ(closedAmong(gaps, -1.0, opens, rule, 0.5).closedByField, 1u) << first;
        EXPECT_EQ(closedAmong(gaps, -1.6, opens, rule, 0.5).closedByField, 2u) << first;
    }
}

// A pore opens where all of its wide places do, whichever of them opens last.
TEST(ClosedPassages, OpenBelowTheSmallestToleranceOfTheirPlaces)
{
    const Vec3d none(-1.0);
    const std::vector<Gap> gaps = {gapOf(0.0, 0.3, none), gapOf(1.0, 0.3, none),
                                   gapOf(2.0, 0.3, none)};
    for (const std::vector<double>& opens :
         {std::vector{10.0, 3.0, 2.0}, {3.0, 10.0, 2.0}, {2.0, 3.0, 10.0}}) {
        const GapReport report = closedAmong(gaps, 0.3, opens, {0.01}, 0.5);
        EXPECT_EQ(report.closedByField, 1u);
        EXPECT_NEAR(report.opensBelow, 0.05, 0.001) << opens[0];
    }
}

} // namespace
} // namespace molsurf
