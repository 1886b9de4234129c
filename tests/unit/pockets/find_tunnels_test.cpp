// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_tunnels.h"

#include "molsurf/analysis/pockets/find_pore.h"
#include "molsurf/analysis/pockets/void_paths.h"
#include "molsurf/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using Tunnel = Report::Tunnels::Tunnel;

const Progress quiet;
constexpr TunnelOptions usual = {0.9, 4.0};

/// Balls of 1.5 Å, an Å apart, about a chamber of 8 Å from which square shafts lead out: along x
/// with its walls at 3 Å and along y with its walls at 4 Å from the axis. In their middles the
/// largest balls have 1.5 and 2.5 Å.
struct Chamber {
    openvdb::Mat3d turn = openvdb::Mat3d::identity();
    Vec3d away = Vec3d(0.0);
    bool hasShafts = true;

    Vec3d at(const Vec3d& x) const { return turn * x + away; }
    std::vector<Ball> balls() const
    {
        std::vector<Ball> out;
        for (int x = -6; x <= 9; ++x)
            for (int y = -6; y <= 9; ++y)
                for (int z = -6; z <= 6; ++z) {
                    const auto within = [](int half, int a, int b) {
                        return std::abs(a) < half && std::abs(b) < half;
                    };
                    const bool shaft = (x > 0 && within(3, y, z)) || (y > 0 && within(4, x, z));
                    if (within(4, x, std::max(std::abs(y), std::abs(z))) || (hasShafts && shaft))
                        continue;
                    out.push_back({at(Vec3d(x, y, z)), 1.5, std::int32_t(out.size())});
                }
        return out;
    }
};

/// The angle between a direction and the way from start to end of a tunnel has this cosine.
double cosineOf(const Tunnel& tunnel, const Vec3d& way)
{
    const Vec3d straight = placeOf(tunnel.stations.back()) - placeOf(tunnel.stations.front());
    return straight.unit().dot(way.unit());
}

TEST(FindTunnels, ShaftsOfAChamberAreTheWaysOutOfIt)
{
    const std::vector<Ball> balls = Chamber().balls();
    const Report::Tunnels found = findTunnels(balls, {Vec3d(0.1, 0.2, 0.1), true}, usual, quiet);
    ASSERT_EQ(found.list.size(), 2u);
    EXPECT_NEAR(found.list[0].narrowest().radius, 2.5, 1e-6);
    EXPECT_NEAR(found.list[1].narrowest().radius, 1.5, 1e-6);
    EXPECT_GT(cosineOf(found.list[0], Vec3d(0.0, 1.0, 0.0)), 0.95);
    EXPECT_GT(cosineOf(found.list[1], Vec3d(1.0, 0.0, 0.0)), 0.95);
    EXPECT_EQ(found.probe, 0.9);
    EXPECT_EQ(found.probeOut, 4.0);
    EXPECT_EQ(found.list[0].stations.front().place, found.start);
    for (const Tunnel& tunnel : found.list) {
        EXPECT_GE(tunnel.curvature(), 1.0);
        EXPECT_LT(tunnel.curvature(), 1.3);
        EXPECT_EQ(std::count_if(tunnel.stations.begin(), tunnel.stations.end(),
                                [&](const auto& s) {
                                    return s.radius == tunnel.narrowest().radius && s.isBottleneck;
                                }) > 0,
                  true);
    }
}

// Each ball of a tunnel is free and touches the balls that line it.
TEST(FindTunnels, EachRadiusIsTheClearanceOfItsPlace)
{
    const std::vector<Ball> balls = Chamber().balls();
    const Report::Tunnels found = findTunnels(balls, {Vec3d(0.1, 0.2, 0.1), true}, usual, quiet);
    for (const Tunnel& tunnel : found.list) {
        double distance = 0.0;
        EXPECT_LT(double(tunnel.stations.size()), tunnel.length() / 0.25 + 2.0);
        for (std::size_t i = 0; i < tunnel.stations.size(); ++i) {
            const auto& s = tunnel.stations[i];
            double least = 1e9;
            std::size_t touching = 0;
            for (const Ball& ball : balls)
                least = std::min(least, (ball.center - placeOf(s)).length() - ball.radius);
            EXPECT_NEAR(s.radius, least, 1e-9);
            for (const Ball& ball : balls)
                touching += (ball.center - placeOf(s)).length() - ball.radius < least + 1e-5;
            EXPECT_GE(touching, 3u) << i;
            EXPECT_GE(s.lining.size(), touching);
            EXPECT_GT(Vec3d(s.normal.data())
                          .dot(placeOf(tunnel.stations.back()) - placeOf(tunnel.stations.front())),
                      0.0); // it leads out
            if (i > 0) distance += (placeOf(s) - placeOf(tunnel.stations[i - 1])).length();
            EXPECT_GE(s.distance, distance - 1e-9); // along the way, not across its bends
        }
    }
}

// ds / d^2, by the trapezoidal rule, with d at least 0.1 Å.
TEST(VoidPaths, TheIntegralIsThatOfInverseSquares)
{
    const auto pointAt = [](double x, double d) { return VoidPoint{Vec3d(x, 0.0, 0.0), d}; };
    EXPECT_DOUBLE_EQ(integralOf({pointAt(0.0, 2.0), pointAt(3.0, 2.0)}), 0.75);
    EXPECT_DOUBLE_EQ(integralOf({pointAt(1.0, 1.0), pointAt(2.0, 2.0), pointAt(2.5, 2.0)}), 0.75);
    EXPECT_DOUBLE_EQ(integralOf({pointAt(0.0, -1.0), pointAt(0.5, 0.05)}), 50.0);
    EXPECT_EQ(integralOf({pointAt(0.0, 1.0)}), 0.0);
}

TEST(FindTunnels, TheyTurnWithTheBalls)
{
    Chamber chamber;
    chamber.turn = openvdb::math::rotation<openvdb::Mat3d>(Vec3d(0.6, 0.0, 0.8), 0.7);
    chamber.away = Vec3d(31.0, -7.0, 12.0);
    const Report::Tunnels found =
        findTunnels(chamber.balls(), {chamber.at(Vec3d(0.1, 0.2, 0.1)), true}, usual, quiet);
    ASSERT_EQ(found.list.size(), 2u);
    EXPECT_NEAR(found.list[0].narrowest().radius, 2.5, 1e-6);
    EXPECT_NEAR(found.list[1].narrowest().radius, 1.5, 1e-6);
    EXPECT_GT(cosineOf(found.list[1], chamber.turn * Vec3d(1.0, 0.0, 0.0)), 0.95);
}

TEST(FindTunnels, ALargerProbeLeavesOutNarrowOnes)
{
    const std::vector<Ball> balls = Chamber().balls();
    const Report::Tunnels found =
        findTunnels(balls, {Vec3d(0.0, 0.0, 0.0), true}, {2.0, 4.0}, quiet);
    ASSERT_EQ(found.list.size(), 1u);
    EXPECT_NEAR(found.list[0].narrowest().radius, 2.5, 1e-6);
}

// From the middle of atoms in the wall they begin in the chamber beside it.
TEST(FindTunnels, FromAtomsTheyBeginInTheRoomBesideThem)
{
    const std::vector<Ball> balls = Chamber().balls();
    const Report::Tunnels found = findTunnels(balls, {Vec3d(-4.3, 0.2, 0.3), false}, usual, quiet);
    EXPECT_EQ(found.list.size(), 2u);
    EXPECT_LT(Vec3d(found.start[0], found.start[1], found.start[2]).length(), 4.0);
    EXPECT_GE(found.startRadius, 2.5);
}

/// Balls of 1.5 Å, an Å apart, in a box but for what is hollow.
template<typename Hollow>
std::vector<Ball> solid(const Vec3d& low, const Vec3d& high, const Hollow& isHollow)
{
    std::vector<Ball> out;
    for (double x = low[0]; x <= high[0]; ++x)
        for (double y = low[1]; y <= high[1]; ++y)
            for (double z = low[2]; z <= high[2]; ++z)
                if (!isHollow(x, y, z)) out.push_back({{x, y, z}, 1.5, std::int32_t(out.size())});
    return out;
}

/// Whether a place is less than `half` from a middle along each axis.
bool inBox(const Vec3d& x, double half)
{
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) < half;
}

// A shaft of 3.5 Å has a side gallery below its mouth, which leads to another face of the block:
// who takes that has come out already.
TEST(FindTunnels, AWayThroughTheMouthOfAnotherIsNone)
{
    const auto balls =
        solid(Vec3d(-7.0, -7.0, -7.0), Vec3d(7.0, 9.0, 16.0), [](auto x, auto y, auto z) {
            return inBox({x, y, z}, 5.0) || (y > 0.0 && std::max(std::abs(x), std::abs(z)) < 5.0) ||
                   (z > 0.0 && std::abs(x) < 3.0 && std::abs(y - 6.0) < 3.0);
        });
    const Report::Tunnels found = findTunnels(balls, {Vec3d(0.1, 0.2, 0.1), true}, usual, quiet);
    ASSERT_EQ(found.list.size(), 1u);
    EXPECT_NEAR(found.list[0].narrowest().radius, 3.5, 1e-6);
    EXPECT_GT(found.list[0].stations.back().place[1], 7.0);
}

// Two shafts, 5 Å apart, lead into a groove which the large probe enters by the upper half, so that
// its centres there are 5 Å apart, too: the balls at the ends, of 2.8 Å, overlap.
TEST(FindTunnels, MouthsWhoseBallsOverlapAreOne)
{
    const auto balls =
        solid(Vec3d(-9.0, -7.0, -6.0), Vec3d(9.0, 6.0, 6.0), [](auto x, auto y, auto z) {
            const auto within = [&](double halfX, double low, double high, double halfZ) {
                return std::abs(x) < halfX && low < y && y < high && std::abs(z) < halfZ;
            };
            return within(5.0, -6.0, -1.0, 4.0) || within(7.0, 1.0, 7.0, 5.0) ||
                   (within(5.0, -2.0, 2.0, 3.0) && x != 0.0);
        });
    const Report::Tunnels found = findTunnels(balls, {Vec3d(0.1, -3.5, 0.1), true}, usual, quiet);
    ASSERT_EQ(found.list.size(), 1u);
    EXPECT_NEAR(std::abs(found.list[0].stations.back().place[0]), 2.5, 0.1);
    EXPECT_GT(found.list[0].stations.back().radius, 2.5);
}

// A closed room is passed over, though it is nearer.
TEST(FindTunnels, FromAtomsTheyBeginInARoomWithAWayOut)
{
    const auto balls =
        solid(Vec3d(-14.0, -5.0, -5.0), Vec3d(5.0, 7.0, 5.0), [](auto x, auto y, auto z) {
            return inBox({x, y, z}, 4.0) || inBox({x + 9.0, y, z}, 3.0) ||
                   (y > 0.0 && std::max(std::abs(x), std::abs(z)) < 3.0);
        });
    const Report::Tunnels found = findTunnels(balls, {Vec3d(-7.5, 0.1, 0.2), false}, usual, quiet);
    ASSERT_EQ(found.list.size(), 1u);
    EXPECT_NEAR(found.list[0].narrowest().radius, 1.5, 1e-6);
    EXPECT_LT((Vec3d(found.start.data())).length(), 4.0);
}

// R^2 / (D^2 + P^2) decides between rooms, with R at most P. The middles of a chamber of 2.5 Å and
// of a hall of 4.5 Å are 13 Å apart. 5 Å from the chamber it has 0.20 with P = 2.6 Å, the hall
// 0.10, as 2.6 Å count; with P = 4.6 Å they have 0.14 and 0.24. At 3.5 Å the chamber has 0.19, the
// hall 0.18.
TEST(FindTunnels, FromAtomsALargeHallCountsAsALargeProbe)
{
    const auto balls =
        solid(Vec3d(-5.0, -7.0, -7.0), Vec3d(20.0, 8.0, 7.0), [](auto x, auto y, auto z) {
            const bool inChamber = inBox({x, y, z}, 4.0), inHall = inBox({x - 13.0, y, z}, 6.0);
            const auto inShaft = [&](double middle) {
                return y > 0.0 && std::max(std::abs(x - middle), std::abs(z)) < 3.0;
            };
            return inChamber || inHall || inShaft(0.0) || inShaft(13.0);
        });
    const auto startOf = [&](double x, double probeOut) {
        return findTunnels(balls, {Vec3d(x, 0.1, 0.2), false}, {0.9, probeOut}, quiet).start[0];
    };
    EXPECT_LT(startOf(5.0, 2.6), 4.0);
    EXPECT_GT(startOf(5.0, 4.6), 7.0);
    EXPECT_LT(startOf(3.5, 4.6), 4.0);
}

void expectError(const std::vector<Ball>& balls, const SearchPlaces::End& from,
                 const TunnelOptions& options, const char* text)
{
    try {
        findTunnels(balls, from, options, quiet);
        FAIL() << text;
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
}

TEST(FindTunnels, WhereThereAreNone)
{
    const std::vector<Ball> open = Chamber().balls();
    Chamber closed;
    closed.hasShafts = false;
    expectError(closed.balls(), {Vec3d(0.0), true}, usual, "found none");
    expectError(open, {Vec3d(0.0, 0.0, -5.5), true}, usual, "a ball of 0.9 Å fits");
    expectError(open, {Vec3d(0.0, 0.0, -20.0), true}, usual, "reaches from outside");
    expectError(open, {Vec3d(0.1, 0.2, 0.1), true}, {0.9, 2.4}, "reaches from outside");
    expectError(open, {Vec3d(0.0, 0.0, -20.0), false}, usual, "reaches from outside");
    expectError(open, {Vec3d(-5.0, 0.0, 0.0), false}, {3.0, 4.0}, "a ball of 3 Å fits");
}

} // namespace
} // namespace molsurf
