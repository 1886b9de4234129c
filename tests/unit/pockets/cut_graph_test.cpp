// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/cut_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// Balls of 1.7 Å in a ball of 11 Å, no closer than 3.2 Å, turned.
std::vector<Ball> randomBalls(const openvdb::Mat3d& turn)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-11.0, 11.0);
    std::vector<Vec3d> places;
    for (int k = 0; k < 4000 && places.size() < 130; ++k) {
        const Vec3d x(any(random), any(random), any(random));
        const auto isNear = [&](const Vec3d& other) { return (x - other).length() < 3.2; };
        if (x.length() < 11.0 && std::none_of(places.begin(), places.end(), isNear))
            places.push_back(x);
    }
    std::vector<Ball> out;
    for (const Vec3d& x : places)
        out.push_back({turn * x + Vec3d(0.31, -2.2, 7.4), 1.7, std::int32_t(out.size())});
    return out;
}

/// The graph of balls below a cut.
struct Below {
    std::vector<Ball> balls;
    PocketOptions options;
    VoidField space;
    BelowCut below;
    VoidGraph graph;
    CutGraph cut;

    explicit Below(const openvdb::Mat3d& turn) : balls(randomBalls(turn))
    {
        options.cut = 0.5;
        space = voidField(balls, options, 0.5, Progress());
        below = [this](const Vec3d& x, double room) {
            OuterDepth::Depth depth = space.outer->at(x, room >= options.probeOut, 6.0);
            depth.value -= options.cut;
            return depth;
        };
        graph = voidGraph(balls, options.probeIn, {}, Progress());
        cut = cutGraph(graph, space, below, Progress());
    }

    std::vector<double> exits() const
    {
        std::vector<double> out;
        for (const CutGraph::Exit& exit : cut.exits) out.push_back(exit.end.clearance);
        std::sort(out.begin(), out.end());
        return out;
    }
    std::vector<double> widths() const
    {
        const Clearance clearance(balls);
        std::vector<double> out;
        for (const CutGraph::Arc& arc : cut.arcs)
            out.push_back(widthOf(arc, cut, graph, clearance, below));
        std::sort(out.begin(), out.end());
        return out;
    }
};

TEST(CutGraph, ExitsLieOnTheCutAndTouchThreeBalls)
{
    const Below one(openvdb::Mat3d::identity());
    const Clearance clearance(one.balls);
    ASSERT_GT(one.cut.exits.size(), 10u);
    for (const CutGraph::Exit& exit : one.cut.exits) {
        const double own = clearance.at(exit.end.place);
        EXPECT_NEAR(own, exit.end.clearance, 0.02); // of a chord of the edge
        EXPECT_NEAR(one.below(exit.end.place, own).value, 0.0, 2e-4);
        EXPECT_GE(clearance.nearest(exit.end.place, 0.03).size(), 3u);
        EXPECT_LE(exit.least, exit.end.clearance + 1e-9);
    }
    for (std::size_t n = 1; n < one.graph.nodes.size(); ++n) {
        const VoidGraph::Node& node = one.graph.nodes[n];
        const double depth = one.below(node.place, node.clearance).value;
        if (std::abs(depth) > 1e-6) {
            EXPECT_EQ(one.cut.isBelow[n] != 0, depth > 0.0) << depth;
        }
    }
}

// Nothing of it depends on voxels.
TEST(CutGraph, ItTurnsWithTheBalls)
{
    const Below one(openvdb::Mat3d::identity());
    const Below two(openvdb::math::rotation<openvdb::Mat3d>(Vec3d(0.6, 0.0, 0.8), 0.9));
    const std::vector<double> exits = one.exits(), turned = two.exits();
    ASSERT_EQ(exits.size(), turned.size());
    for (std::size_t i = 0; i < exits.size(); ++i) EXPECT_NEAR(exits[i], turned[i], 1e-3);
    const std::vector<double> widths = one.widths(), others = two.widths();
    ASSERT_EQ(widths.size(), others.size());
    ASSERT_GT(widths.size(), 5u);
    for (std::size_t i = 0; i < widths.size(); ++i) EXPECT_NEAR(widths[i], others[i], 5e-3);
}

} // namespace
} // namespace molsurf
