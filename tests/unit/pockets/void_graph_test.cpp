// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/void_graph.h"

#include "molsurf/analysis/pockets/void_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

double clearanceOf(const std::vector<Ball>& balls, const Vec3d& x)
{
    double least = 1e30;
    for (const Ball& ball : balls)
        least = std::min(least, (x - ball.center).length() - ball.radius);
    return least;
}

/// Random balls in a cube, of an edge and radii that are random, too.
std::vector<Ball> randomBalls(std::mt19937& random, int most)
{
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const int count = 10 + int(random() % std::uint32_t(most - 9));
    const double edge = 4.0 + 8.0 * share(random), spread = random() % 2 == 0 ? 0.6 : 1.4;
    std::vector<Ball> out;
    for (int i = 0; i < count; ++i) {
        const double x = share(random), y = share(random), z = share(random);
        out.push_back({Vec3d(x, y, z) * edge, 0.6 + spread * share(random), i});
    }
    return out;
}

/// Whether directions from balls to a place leave no side free; three of them lie in a plane.
bool isHeldBy(const VoidGraph& graph, const std::vector<std::int32_t>& balls, const Vec3d& x)
{
    std::vector<Vec3d> way;
    for (const std::int32_t i : balls)
        way.push_back((x - graph.balls[std::size_t(i)].center).unit());
    if (way.size() == 3) {
        const Vec3d normal = (way[1] - way[0]).cross(way[2] - way[0]);
        for (std::size_t k = 0; k < 3; ++k)
            if (way[k].cross(way[(k + 1) % 3]).dot(normal) < 0.0) return false;
        return true;
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3d &a = way[(k + 1) % 4], &b = way[(k + 2) % 4], &c = way[(k + 3) % 4];
        const Vec3d normal = (b - a).cross(c - a);
        if ((normal.dot(a) < 0.0) != (normal.dot(way[k] - a) > 0.0)) return false;
    }
    return true;
}

/// All necks above the floor, or all rooms, by trying all triples, or quadruples, of balls.
std::vector<VoidPoint> byTrying(const VoidGraph& graph, bool rooms)
{
    const std::vector<Ball>& balls = graph.balls;
    const auto n = std::int32_t(balls.size());
    std::vector<VoidPoint> out;
    const auto tryPlace = [&](const std::vector<std::int32_t>& own, const Vec3d& x, double d) {
        const auto touches = [&](std::int32_t i) {
            const Ball& ball = balls[std::size_t(i)];
            return std::abs((x - ball.center).length() - ball.radius - d) < 1e-7;
        };
        if (d > graph.floor && std::all_of(own.begin(), own.end(), touches) &&
            isHeldBy(graph, own, x) && clearanceOf(balls, x) > d - 1e-8)
            out.push_back({x, d});
    };
    for (std::int32_t i = 0; i < n; ++i)
        for (std::int32_t j = i + 1; j < n; ++j)
            for (std::int32_t k = j + 1; k < n; ++k) {
                const auto curve = VoidCurve::ofThree(balls[std::size_t(i)], balls[std::size_t(j)],
                                                      balls[std::size_t(k)]);
                if (!curve) continue;
                if (!rooms) tryPlace({i, j, k}, curve->at(curve->bottom(), 1), curve->bottom());
                for (std::int32_t l = k + 1; rooms && l < n; ++l) {
                    const Ball& last = balls[std::size_t(l)];
                    const auto seen = curve->seen(last.center, last.radius);
                    for (const double d : curve->roots(seen))
                        for (const int side : {1, -1})
                            if (std::isfinite(d) && VoidCurve::isOn(seen, d, side))
                                tryPlace({i, j, k, l}, curve->at(d, side), d);
                }
            }
    return out;
}

bool isAmong(const VoidPoint& point, const std::vector<VoidPoint>& points)
{
    return std::any_of(points.begin(), points.end(), [&](const VoidPoint& p) {
        return std::abs(p.clearance - point.clearance) < 3e-6 &&
               (p.place - point.place).length() < 1e-3;
    });
}

// Every neck and every room is found, and nothing else is one.
TEST(VoidGraph, NecksAndRoomsAreThoseOfAllTriplesAndQuadruples)
{
    std::mt19937 random(7);
    std::size_t necks = 0, rooms = 0;
    for (int molecule = 0; molecule < 150; ++molecule) {
        const double floor = std::array{0.3, 0.0, -0.4}[std::size_t(molecule % 3)];
        const VoidGraph graph =
            voidGraph(randomBalls(random, molecule % 5 == 0 ? 60 : 25), floor, {}, Progress());
        std::vector<VoidPoint> found;
        for (const VoidGraph::Edge& edge : graph.edges)
            if (edge.isNeck) found.push_back({edge.narrowest, edge.clearance});
        for (const VoidPoint& neck : byTrying(graph, false)) {
            EXPECT_TRUE(isAmong(neck, found)) << molecule << " " << neck.place;
            ++necks;
        }
        for (const VoidPoint& neck : found)
            EXPECT_NEAR(clearanceOf(graph.balls, neck.place), neck.clearance, 3e-6) << molecule;
        for (const VoidGraph::Node& node : graph.nodes)
            if (std::isfinite(node.clearance)) {
                EXPECT_NEAR(clearanceOf(graph.balls, node.place), node.clearance, 1e-7) << molecule;
            }
        if (graph.balls.size() > 25) continue;
        const Rooms highest = roomsOf(graph);
        found.clear();
        for (std::size_t r = 1; r < highest.nodes.size(); ++r) {
            const VoidGraph::Node& node = graph.nodes[std::size_t(highest.nodes[r])];
            found.push_back({node.place, node.clearance});
        }
        const std::vector<VoidPoint> all = byTrying(graph, true);
        EXPECT_EQ(found.size(), all.size()) << molecule;
        for (const VoidPoint& room : all) EXPECT_TRUE(isAmong(room, found)) << molecule;
        rooms += all.size();
    }
    EXPECT_GT(necks, 3000u);
    EXPECT_GT(rooms, 500u);
}

/// The largest ball that passes between the first two starts of a graph, or minus 1.
double passing(const VoidGraph& graph)
{
    std::vector<std::int32_t> order(graph.edges.size()), parent(graph.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::iota(parent.begin(), parent.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return graph.edges[std::size_t(a)].clearance > graph.edges[std::size_t(b)].clearance;
    });
    const auto find = [&](std::int32_t n) {
        while (parent[std::size_t(n)] != n) n = parent[std::size_t(n)];
        return n;
    };
    if (find(graph.starts[0]) == find(graph.starts[1])) return 1e9;
    for (const std::int32_t e : order) {
        const VoidGraph::Edge& edge = graph.edges[std::size_t(e)];
        parent[std::size_t(find(edge.nodes[0]))] = find(edge.nodes[1]);
        if (find(graph.starts[0]) == find(graph.starts[1])) return edge.clearance;
    }
    return -1.0;
}

/// The same by points of a lattice that are joined to their six neighbours.
double passingOnLattice(const std::vector<Ball>& balls, const std::array<Vec3d, 2>& ends, double h)
{
    openvdb::BBoxd box;
    for (const Ball& ball : balls) box.expand(ball.center);
    const Vec3d low = box.min() - Vec3d(5.0);
    std::array<int, 3> count;
    for (int k = 0; k < 3; ++k)
        count[std::size_t(k)] = int(std::ceil((box.extents()[k] + 10.0) / h)) + 1;
    const auto index = [&](int x, int y, int z) { return (x * count[1] + y) * count[2] + z; };
    const auto place = [&](int i) {
        return low + Vec3d(i / (count[1] * count[2]), i / count[2] % count[1], i % count[2]) * h;
    };
    std::array<int, 2> at;
    for (std::size_t k = 0; k < 2; ++k) {
        const Vec3d x = (ends[k] - low) / h;
        at[k] = index(int(std::lround(x[0])), int(std::lround(x[1])), int(std::lround(x[2])));
    }
    std::vector<char> seen(std::size_t(count[0] * count[1] * count[2]), 0);
    std::priority_queue<std::pair<double, int>> open;
    open.emplace(clearanceOf(balls, place(at[0])), at[0]);
    while (!open.empty()) {
        const auto [d, i] = open.top();
        open.pop();
        if (seen[std::size_t(i)]) continue;
        seen[std::size_t(i)] = 1;
        if (i == at[1]) return d;
        const std::array<int, 3> own = {i / (count[1] * count[2]), i / count[2] % count[1],
                                        i % count[2]};
        for (int k = 0; k < 6; ++k) {
            std::array<int, 3> to = own;
            to[std::size_t(k / 2)] += k % 2 == 0 ? 1 : -1;
            if (to[std::size_t(k / 2)] < 0 || to[std::size_t(k / 2)] >= count[std::size_t(k / 2)])
                continue;
            const int other = index(to[0], to[1], to[2]);
            if (!seen[std::size_t(other)])
                open.emplace(std::min(d, clearanceOf(balls, place(other))), other);
        }
    }
    return -1.0;
}

/// Balls on a lattice, all alike, some of them gone; or random ones, each of them twice.
std::vector<Ball> degenerateBalls(std::mt19937& random, bool twice)
{
    std::vector<Ball> out;
    if (twice) {
        out = randomBalls(random, 20);
        const std::vector<Ball> same = out;
        out.insert(out.end(), same.begin(), same.end());
        return out;
    }
    const double radius = 0.7 + 0.1 * double(random() % 8);
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 4; ++z)
                if (random() % 3 != 0)
                    out.push_back({Vec3d(x, y, z) * 2.0, radius, std::int32_t(out.size())});
    return out;
}

// What passes is what passes on a lattice: no less than half a step below that, as the clearance
// changes by no more between two points, and no more above than half of a cell's diagonal.
TEST(VoidGraph, WhatPassesIsThatOfALattice)
{
    constexpr double h = 0.4, floor = 0.05, most = 3.0;
    std::mt19937 random(3);
    int compared = 0;
    for (int molecule = 0; molecule < 45; ++molecule) {
        const std::vector<Ball> balls = molecule % 3 == 0
                                            ? randomBalls(random, 60)
                                            : degenerateBalls(random, molecule % 3 == 1);
        openvdb::BBoxd box;
        for (const Ball& ball : balls) box.expand(ball.center);
        std::array<Vec3d, 2> ends;
        std::uniform_real_distribution<double> share(0.0, 1.0);
        for (Vec3d& end : ends) do {
                const double x = share(random), y = share(random), z = share(random);
                end = box.min() + box.extents() * Vec3d(x, y, z);
            } while (clearanceOf(balls, end) < floor);
        const VoidGraph graph = voidGraph(balls, floor, {ends[0], ends[1]}, Progress());
        const double own = std::min(clearanceOf(balls, ends[0]), clearanceOf(balls, ends[1]));
        const double found = std::min({passing(graph), own, most});
        const double lattice = std::min({passingOnLattice(balls, ends, h), own, most});
        if (lattice <= floor + h) continue;
        EXPECT_GE(found, lattice - 0.5 * h) << molecule;
        EXPECT_LE(found, lattice + 0.87 * h) << molecule;
        ++compared;
    }
    EXPECT_GT(compared, 10);
}

// A ring of many balls is a neck, whose radius is that of its closed form.
TEST(VoidGraph, ARingIsANeck)
{
    std::vector<Ball> balls;
    for (int k = 0; k < 24; ++k) {
        const double angle = 2.0 * M_PI * k / 24;
        balls.push_back({Vec3d(5.5 * std::cos(angle), 5.5 * std::sin(angle), 0.0), 1.7, k});
    }
    const VoidGraph graph = voidGraph(balls, 0.0, {}, Progress());
    double widest = 0.0;
    for (const VoidGraph::Edge& edge : graph.edges)
        if (edge.isNeck) widest = std::max(widest, edge.clearance);
    EXPECT_NEAR(widest, 5.5 - 1.7, 2e-6);
}

// Three balls on a line, a small one between two: the ball that touches all of them goes round.
TEST(VoidGraph, ASmallBallBetweenTwoLeavesNoPocket)
{
    for (const double off : {0.0, 0.2, 0.7}) {
        const std::vector<Ball> balls = {{Vec3d(-3.0, 0.0, 0.0), 2.8, 0},
                                         {Vec3d(0.0, off, 0.0), 0.5, 1},
                                         {Vec3d(3.0, 0.0, 0.0), 2.8, 2}};
        const VoidGraph graph =
            voidGraph(balls, 0.0, {Vec3d(0.0, off + 1.5, 0.0), Vec3d(0.0, -9.0, 0.0)}, Progress());
        EXPECT_EQ(roomsOf(graph).nodes.size(), 1u) << off;
        EXPECT_EQ(graph.starts, (std::vector<std::int32_t>(2, VoidGraph::outside))) << off;
        // Within the box the way up from a place leads on.
        const VoidGraph within =
            voidGraph(balls, 0.0, {Vec3d(0.1, 0.0, 0.9), Vec3d(9.0)}, Progress());
        if (within.starts[0] != VoidGraph::outside) {
            EXPECT_GE(passing(within), 0.0);
        }
    }
}

// The points of an edge touch its three balls, and the narrowest place is one of them.
TEST(VoidGraph, PointsOfEdgesAreAsClearAsTheySay)
{
    std::mt19937 random(11);
    const VoidGraph graph = voidGraph(randomBalls(random, 40), 0.0, {}, Progress());
    for (const VoidGraph::Edge& edge : graph.edges) {
        const std::vector<VoidPoint> points = graph.pointsOf(edge, 0.2);
        double least = 1e9;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_NEAR(clearanceOf(graph.balls, points[i].place), points[i].clearance, 1e-6);
            if (i > 0) {
                EXPECT_LT((points[i].place - points[i - 1].place).length(), 0.201);
            }
            least = std::min(least, points[i].clearance);
        }
        EXPECT_NEAR(least, edge.clearance, 2e-6);
    }
}

} // namespace
} // namespace molsurf
