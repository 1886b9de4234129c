// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/basins.h"
#include "molsurf/analysis/pockets/measure_basins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// A wall of balls of 1.5 Å, an Å apart, about two round rooms along x with a tunnel between them.
/// @param[in] gap  the rooms are 2 gap apart
std::vector<Ball> twoRooms(double first, double second, double gap, double tunnel)
{
    std::vector<Ball> out;
    const double half = 2.0 + std::max(first, second);
    for (double x = -gap - first - 2.0; x <= gap + second + 2.0; x += 1.0)
        for (double y = -half; y <= half; y += 1.0)
            for (double z = -half; z <= half; z += 1.0) {
                const Vec3d at(x, y, z);
                const bool isHole = (at - Vec3d(-gap, 0.0, 0.0)).length() < first ||
                                    (at - Vec3d(gap, 0.0, 0.0)).length() < second ||
                                    (std::abs(x) < gap && std::hypot(y, z) < tunnel);
                if (!isHole) out.push_back({at, 1.5, std::int32_t(out.size())});
            }
    return out;
}

/// A split space, without a cut.
struct Split {
    std::vector<Ball> balls;
    PocketOptions options;
    VoidField space;
    RoomBasins rooms;

    Split(std::vector<Ball> wall, double share, double voxel = 0.5) : balls(std::move(wall))
    {
        space = voidField(balls, options, voxel, Progress());
        const BelowCut below = [this](const Vec3d& x, double room) {
            OuterDepth::Depth depth = space.outer->at(x, room >= options.probeOut, 6.0);
            depth.value -= options.cut;
            return depth;
        };
        rooms = splitAtRooms(balls, options.probeIn, space, share, below, Progress());
    }

    std::size_t count() const { return rooms.basins.count(); }

    /// The basin of the voxel at a place.
    std::int32_t at(const Vec3d& x) const
    {
        const openvdb::Coord voxel = openvdb::Coord::round(x / space.voxelSize);
        return rooms.basins.of.leaf(std::size_t(
            space.table.find(voxel)))[(voxel[0] & 7) << 6 | (voxel[1] & 7) << 3 | (voxel[2] & 7)];
    }
};

/// The radius of the largest ball in a room, and of that which passes the tunnel.
struct Widths {
    double room = 0.0, tunnel = 0.0;

    explicit Widths(const VoidGraph& graph)
    {
        double rooms[2] = {0.0, 0.0};
        for (std::size_t n = 1; n < graph.nodes.size(); ++n) {
            double& most = rooms[graph.nodes[n].place.x() > 0.0];
            most = std::max(most, graph.nodes[n].clearance);
        }
        room = std::min(rooms[0], rooms[1]);
        for (const VoidGraph::Edge& edge : graph.edges)
            if (graph.nodes[std::size_t(edge.nodes[0])].place.x() *
                    graph.nodes[std::size_t(edge.nodes[1])].place.x() <
                0.0)
                tunnel = std::max(tunnel, edge.clearance);
    }
};

TEST(Basins, ANeckBelowTheShareOfTheSmallerRoomSplits)
{
    const std::vector<Ball> balls = twoRooms(5.6, 4.6, 7.5, 3.1);
    const Widths widths(Split(balls, 0.5).rooms.graph);
    ASSERT_GT(widths.tunnel, 1.4);
    const double share = widths.tunnel / widths.room;
    EXPECT_EQ(Split(balls, share - 1e-3).count(), 1u);
    const Split two(balls, share + 1e-3);
    ASSERT_EQ(two.count(), 2u);
    EXPECT_NE(two.at({-7.5, 0.0, 0.0}), two.at({7.5, 0.0, 0.0}));
    ASSERT_EQ(two.rooms.basins.necks.size(), 1u);
    EXPECT_NEAR(two.rooms.basins.necks[0].clearance, widths.tunnel, 1e-5);
    EXPECT_EQ(Split(balls, 0.0).count(), 1u);
}

// It is that of the room whose ball, about a node, it lies deepest in.
TEST(Basins, EachPlaceBelongsToTheBallItLiesDeepestIn)
{
    const Split two(twoRooms(5.6, 4.6, 7.5, 3.1), 0.9);
    ASSERT_EQ(two.count(), 2u);
    const VoidGraph& graph = two.rooms.graph;
    std::size_t checked = 0;
    for (double x = -4.0; x <= 5.0; x += 0.5) {
        double least[2] = {1e9, 1e9};
        for (std::size_t n = 1; n < graph.nodes.size(); ++n) {
            const std::int32_t basin = two.rooms.ofNodes[n];
            if (basin < 0 || graph.nodes[n].balls[2] == VoidGraph::none) continue;
            double& own = least[basin];
            own = std::min(own, (Vec3d(x, 0.5, 0.0) - graph.nodes[n].place).length() -
                                    graph.nodes[n].clearance);
        }
        if (std::abs(least[0] - least[1]) < 1e-4) continue;
        EXPECT_EQ(two.at({x, 0.5, 0.0}), least[0] < least[1] ? 0 : 1) << x;
        ++checked;
    }
    EXPECT_GT(checked, 10u);
    EXPECT_NEAR(two.rooms.widest[0]->ball.clearance + two.rooms.widest[1]->ball.clearance,
                Widths(graph).room +
                    two.rooms.widest[std::size_t(two.at({-7.5, 0, 0}))]->ball.clearance,
                1e-9);
}

// The ball of a room may reach through a wall's window into what is of another one.
TEST(Basins, WhatDoesNotHangTogetherStaysApart)
{
    for (const double share : {0.0, 0.55}) {
        const Split apart(twoRooms(5.6, 4.6, 8.5, 0.0), share);
        EXPECT_EQ(apart.count(), 2u);
        EXPECT_TRUE(apart.rooms.basins.necks.empty());
        EXPECT_NE(apart.at({-8.5, 0.0, 0.0}), apart.at({8.5, 0.0, 0.0}));
    }
}

// By voxels, too, the way to a mouth is as wide as where it is narrowest: a ring in a tunnel that
// is wider on both sides of it.
TEST(Basins, AMouthByVoxelsIsAsWideAsTheWayToIt)
{
    std::vector<Ball> balls;
    for (double x = -9.0; x <= 11.0; x += 1.0)
        for (double y = -8.0; y <= 8.0; y += 1.0)
            for (double z = -8.0; z <= 8.0; z += 1.0)
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) >= 4.5 &&
                    (x < 0.0 || std::hypot(y, z) >= 4.3))
                    balls.push_back({Vec3d(x, y, z), 1.5, std::int32_t(balls.size())});
    for (int k = 0; k < 12; ++k) {
        const double angle = M_PI * k / 6.0;
        balls.push_back({Vec3d(6.13, 3.6 * std::cos(angle), 3.6 * std::sin(angle)), 1.5,
                         std::int32_t(balls.size())});
    }
    const Split split(balls, 0.0);
    ASSERT_EQ(split.count(), 1u);
    const std::vector<BasinMeasure> measures =
        measureBasins(split.space, split.rooms.basins, Progress());
    ASSERT_FALSE(measures[0].mouths.empty());
    const BasinMeasure::Mouth& mouth =
        *std::max_element(measures[0].mouths.begin(), measures[0].mouths.end(),
                          [](const auto& a, const auto& b) { return a.area < b.area; });
    EXPECT_LT(mouth.radius, 3.6 - 1.5 + 0.01);
    EXPECT_GT(mouth.radius, 3.6 - 1.5 - 0.5);
    EXPECT_NEAR(mouth.narrowest[0], 6.13, 0.5);
    EXPECT_LT(std::hypot(mouth.narrowest[1], mouth.narrowest[2]), 0.5);
    EXPECT_GT(mouth.widest, mouth.radius + 0.2);
    EXPECT_NEAR(measures[0].widest.length(), 0.0, 0.9);
}

// What belongs to a room does not depend on voxels.
TEST(Basins, SharesDoNotDependOnVoxels)
{
    const std::vector<Ball> balls = twoRooms(5.6, 4.6, 7.5, 3.1);
    std::vector<double> shares;
    for (const double voxel : {0.3, 0.45, 0.6}) {
        const Split split(balls, 0.9, voxel);
        ASSERT_EQ(split.count(), 2u);
        double sizes[2] = {0.0, 0.0};
        for (std::size_t n = 0; n < split.space.table.size(); ++n)
            split.space.table.active(n).forEach(
                [&](int v) { ++sizes[split.rooms.basins.of.leaf(n)[v]]; });
        shares.push_back(sizes[0] / (sizes[0] + sizes[1]));
    }
    EXPECT_NEAR(shares[0], shares[1], 0.005);
    EXPECT_NEAR(shares[0], shares[2], 0.005);
}

} // namespace
} // namespace molsurf
