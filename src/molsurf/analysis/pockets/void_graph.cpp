// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/void_graph.h"

#include "molsurf/analysis/pockets/void_curve.h"
#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/orthonormal_basis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Triple = std::array<std::int32_t, 3>;
using Quad = std::array<std::int32_t, 4>;

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::int32_t noBall = VoidGraph::none;

/// Radii grow by up to this, by their order [Å]: far above what rounding does to clearances, so
/// that of balls about one place it is clear which is nearer.
constexpr double mostGrown = 1e-6;

/// Beside the box of the centres a ball as large as this only gets farther from it [Å].
constexpr double mostOutside = 20.0;

/// The clearance of nodes that are in a ball, until they are left out.
constexpr double notFree = -unbounded;

/// A place touches a ball if the clearance is off by no more than this [Å].
constexpr double tangent = 1e-9;

/// What lies between the outermost centres along 13 directions: those of the faces, edges and
/// corners of a cube. Beside it d grows on the way straight from it.
class Slabs
{
public:
    explicit Slabs(const std::vector<Ball>& balls)
    {
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (9 * x + 3 * y + z > 0) slabs_.push_back({Vec3d(x, y, z)});
        for (Slab& slab : slabs_)
            for (const Ball& ball : balls) {
                const double at = ball.center.dot(slab.way);
                slab.low = std::min(slab.low, at);
                slab.high = std::max(slab.high, at);
            }
    }

    /// Whether a ball touches the molecule from beside it, where it only gets farther from it.
    bool isFar(const Vec3d& x, double clearance) const
    {
        if (clearance <= mostOutside) return false;
        return std::any_of(slabs_.begin(), slabs_.end(), [&](const Slab& slab) {
            const double at = x.dot(slab.way);
            return at < slab.low || at > slab.high;
        });
    }

private:
    struct Slab {
        Vec3d way;
        double low = unbounded, high = -unbounded;
    };
    std::vector<Slab> slabs_;
};

struct HashOfBalls {
    template<std::size_t N>
    std::size_t operator()(const std::array<std::int32_t, N>& balls) const
    {
        std::uint64_t hash = 0;
        for (const std::int32_t ball : balls)
            hash = (hash ^ std::uint32_t(ball)) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
        return std::size_t(hash);
    }
};

/// The balls, each moved by less than 1e-9 Å and grown by less than mostGrown, along a Z-order
/// curve; of equal ones the first.
std::vector<Ball> inGeneralPosition(const std::vector<Ball>& balls)
{
    std::vector<Ball> out;
    for (const PlacedBall& ball : placedBalls(balls, 0.0)) {
        const std::uint64_t hash = (out.size() + 1) * 0x9e3779b97f4a7c15ull;
        const double share = double(hash >> 11) * 0x1p-53;
        out.push_back({ball.centre(), ball.radius + share * mostGrown, ball.index});
    }
    return out;
}

/// A place on a curve, and the direction in which it is followed.
struct Start {
    double clearance;
    int side;             ///< of the plane of the balls
    bool rises;           ///< whether the clearance grows
    std::int32_t skipped; ///< the ball that it leaves there, or none
    double left;          ///< the clearance where it leaves that [Å]
};

/// What a curve comes to.
struct Stop {
    enum class What { Ball, Floor, Top, Outside } what;
    double clearance;
    int side;
    std::int32_t ball; ///< the one that it touches there
    bool bottom;       ///< whether it passed the bottom of the curve
};

/// Makes the graph, edge by edge.
class Tracer
{
public:
    Tracer(VoidGraph& graph, const Progress& progress)
        : graph_(graph), balls_(graph.balls), index_(balls_, {1.0, 0.0, 3.0}), progress_(progress),
          slabs_(balls_)
    {
        graph_.nodes.push_back({Vec3d(0.0), unbounded, {noBall, noBall, noBall, noBall}});
        done_.push_back(0xff);
        next_.push_back(noBall);
        touched_.assign(balls_.size(), 0);
    }

    /// Climbs from a place, which may be no place of the graph.
    /// @return its node; none if it is below the floor
    std::int32_t climbFrom(const Vec3d& x)
    {
        double gap = 1.0, least = unbounded;
        std::int32_t nearest = noBall;
        do { // until no ball that was not looked at can be nearer
            gap *= 2.0;
            index_.forEachNear(x, x, gap, [&](const Ball& b, std::int32_t i) {
                const double d = (x - b.center).length() - b.radius;
                if (d >= least && (d > least || i > nearest)) return;
                least = d;
                nearest = i;
            });
        } while (least > gap);
        return least < graph_.floor ? noBall : climbFrom(x, least, nearest, noBall);
    }

    /// Follows the edges that cross the floor, and all that these lead to.
    void run()
    {
        const BallBoundary boundary = ballBoundary(balls_, graph_.floor, progress_);
        for (const Corner& corner : boundary.corners) {
            Triple balls;
            for (std::size_t k = 0; k < 3; ++k)
                balls[k] = boundary.balls[std::size_t(corner.balls[k])].index;
            std::sort(balls.begin(), balls.end());
            seed(balls, corner.position);
            followAll();
        }
        seedIslands(boundary);
    }

private:
    const Ball& ball(std::int32_t i) const { return balls_[std::size_t(i)]; }

    std::optional<VoidCurve> curveOf(const Triple& balls) const
    {
        return VoidCurve::ofThree(ball(balls[0]), ball(balls[1]), ball(balls[2]));
    }

    /// Balls near a place: all that are within clearance + slack.
    struct Near {
        Vec3d place{0.0};
        double clearance = 0.0, slack = -1.0;
        std::vector<std::int32_t> balls;
    };

    void look(const Vec3d& x, double clearance, double slack)
    {
        near_.place = x;
        near_.clearance = clearance;
        near_.slack = slack;
        near_.balls.clear();
        const double reach = std::max(clearance + slack, 0.0);
        index_.forEachNear(x, x, reach, [&](const Ball& b, std::int32_t i) {
            const double most = clearance + slack + b.radius;
            if ((b.center - x).lengthSqr() <= most * most) near_.balls.push_back(i);
        });
    }

    /// Whether all balls that touch a ball about a place of a curve are known.
    bool isCovered(const Vec3d& x, double clearance) const
    {
        return (x - near_.place).length() + std::max(clearance - near_.clearance, 0.0) <=
               near_.slack;
    }

    /// The first ball of those near that half of a curve comes to between two clearances.
    Stop nextOn(const VoidCurve& curve, const Triple& own, const Start& from, double till) const
    {
        Stop out{Stop::What::Floor, till, from.side, noBall, false};
        for (const std::int32_t i : near_.balls) {
            if (i == own[0] || i == own[1] || i == own[2]) continue;
            const VoidCurve::Seen seen = curve.seen(ball(i).center, ball(i).radius);
            const std::array<double, 2> roots = curve.roots(seen);
            std::size_t skipped = 2;
            if (i == from.skipped)
                skipped = std::abs(roots[0] - from.left) <= std::abs(roots[1] - from.left) ? 0 : 1;
            for (std::size_t k = 0; k < 2; ++k) {
                const double d = roots[k];
                const bool first = from.rises ? d >= from.clearance && d < out.clearance
                                              : d <= from.clearance && d > out.clearance;
                if (!first || k == skipped || !VoidCurve::isOn(seen, d, from.side)) continue;
                if (curve.turn(seen, d, from.side) * (from.rises ? 1.0 : -1.0) < 0.0) continue;
                out.clearance = d;
                out.ball = i;
                out.what = Stop::What::Ball;
            }
        }
        return out;
    }

    /// What a curve comes to if the balls near are all that there are; `known` gets whether that is
    /// so on the way.
    Stop stopAmongNear(const VoidCurve& curve, const Triple& own, Start from, bool& known) const
    {
        bool passed = false;
        if (!from.rises) {
            Stop stop = nextOn(curve, own, from, std::max(curve.bottom(), graph_.floor));
            const Vec3d x = curve.at(stop.clearance, stop.side);
            known = isCovered(x, stop.clearance);
            if (stop.what == Stop::What::Ball || curve.bottom() < graph_.floor || !known)
                return stop;
            passed = true;
            from = {curve.bottom(), -from.side, true, from.skipped, from.left};
        }
        Stop stop = nextOn(curve, own, from, curve.top());
        stop.bottom = passed;
        if (stop.what == Stop::What::Floor && std::isfinite(stop.clearance))
            stop.what = Stop::What::Top;
        if (stop.what != Stop::What::Floor) {
            known = isCovered(curve.at(stop.clearance, stop.side), stop.clearance);
            if (known) return stop;
        }
        // Up to where all balls are known it comes to none.
        double low = from.clearance, high = std::min(from.clearance + near_.slack, stop.clearance);
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (low + high);
            (isCovered(curve.at(middle, from.side), middle) ? low : high) = middle;
        }
        known = slabs_.isFar(curve.at(low, from.side), low);
        return {Stop::What::Outside, low, from.side, noBall, passed};
    }

    /// Follows a curve from a place.
    Stop follow(const VoidCurve& curve, const Triple& own, const Start& from)
    {
        const Vec3d x = curve.at(from.clearance, from.side);
        for (double slack = std::max(near_.slack, 1.0 + 0.3 * std::max(from.clearance, 0.0));;
             slack *= 2.0) {
            if (near_.slack < slack || (near_.place - x).length() > tangent)
                look(x, from.clearance, slack);
            bool known = false;
            const Stop stop = stopAmongNear(curve, own, from, known);
            if (known) return stop;
        }
    }

    /// The node of four balls at a place, which is new if there is none.
    std::int32_t nodeAt(Quad balls, const VoidCurve& curve, const Stop& stop)
    {
        constexpr double same = 1e-3; // [Å]
        std::sort(balls.begin(), balls.end());
        VoidGraph::Node node{curve.at(stop.clearance, stop.side), stop.clearance, balls};
        polish(node);
        const auto [found, isNew] = nodes_.emplace(balls, std::int32_t(graph_.nodes.size()));
        if (!isNew)
            for (std::int32_t n = found->second; n != noBall; n = next_[std::size_t(n)])
                if ((graph_.nodes[std::size_t(n)].place - node.place).length() < same) return n;
        next_.push_back(isNew ? noBall : found->second);
        found->second = std::int32_t(graph_.nodes.size());
        graph_.nodes.push_back(node);
        done_.push_back(0);
        open_.push_back(std::int32_t(graph_.nodes.size()) - 1);
        return open_.back();
    }

    /// A step of Newton's method towards the place that touches all four balls.
    void polish(VoidGraph::Node& node) const
    {
        std::array<Vec3d, 4> way;
        std::array<double, 4> off;
        for (std::size_t k = 0; k < 4; ++k) {
            const Ball& b = ball(node.balls[k]);
            way[k] = node.place - b.center;
            const double length = way[k].length();
            off[k] = length - b.radius - node.clearance;
            way[k] /= std::max(length, 1e-12);
        }
        // (way_k - way_0) . dx = off_0 - off_k
        const Vec3d a = way[1] - way[0], b = way[2] - way[0], c = way[3] - way[0];
        const double det = a.dot(b.cross(c));
        if (!(std::abs(det) > 1e-3)) return;
        const Vec3d dx = (b.cross(c) * (off[0] - off[1]) + c.cross(a) * (off[0] - off[2]) +
                          a.cross(b) * (off[0] - off[3])) /
                         det;
        node.place += dx;
        node.clearance += off[0] + way[0].dot(dx);
    }

    /// The top of an ellipse.
    std::int32_t topAt(const Triple& balls, const VoidCurve& curve)
    {
        const Quad name = {balls[0], balls[1], balls[2], noBall};
        const auto [found, isNew] = nodes_.emplace(name, std::int32_t(graph_.nodes.size()));
        if (!isNew) return found->second;
        next_.push_back(noBall);
        graph_.nodes.push_back({curve.at(curve.top(), 1), curve.top(), name});
        done_.push_back(0);
        open_.push_back(found->second);
        return found->second;
    }

    /// The end of an edge: a node that is marked as reached this way, or none at the floor.
    std::int32_t endOf(const Triple& own, const VoidCurve& curve, const Stop& stop)
    {
        if (stop.what == Stop::What::Outside) return VoidGraph::outside;
        if (stop.what == Stop::What::Floor) {
            ends_.insert({own[0], own[1], own[2], stop.side});
            return noBall;
        }
        if (stop.what == Stop::What::Top) {
            const std::int32_t node = topAt(own, curve);
            done_[std::size_t(node)] |= std::uint8_t(stop.side > 0 ? 1 : 2);
            return node;
        }
        const std::int32_t node = nodeAt({own[0], own[1], own[2], stop.ball}, curve, stop);
        if (node == VoidGraph::outside) return node;
        const Quad& balls = graph_.nodes[std::size_t(node)].balls;
        const auto slot = std::find(balls.begin(), balls.end(), stop.ball) - balls.begin();
        done_[std::size_t(node)] |= std::uint8_t(1 << slot);
        return node;
    }

    /// Adds the edge on which a probe rolls along three balls, from a node to where the curve ends,
    /// with the narrowest place on it.
    void addEdge(std::int32_t from, const Triple& own, const VoidCurve& curve, const Start& start,
                 const Stop& stop)
    {
        for (const std::int32_t i : own) touched_[std::size_t(i)] = 1;
        const std::int32_t to = endOf(own, curve, stop);
        if (from == noBall || to == noBall) return addStub(from, to, own, start, stop);
        VoidGraph::Edge edge{{from, to},
                             0.0,
                             Vec3d(0.0),
                             false,
                             own,
                             {start.clearance, stop.clearance},
                             {std::int8_t(start.side), std::int8_t(stop.side)},
                             Vec3d(0.0)};
        if (to != VoidGraph::outside) edge.ends[1] = graph_.nodes[std::size_t(to)].clearance;
        const bool first = edge.ends[0] <= edge.ends[1];
        edge.clearance = stop.bottom ? curve.bottom() : edge.ends[first ? 0 : 1];
        edge.narrowest = stop.bottom ? curve.at(curve.bottom(), 1)
                                     : curve.at(edge.clearance, first ? start.side : stop.side);
        edge.isNeck = stop.bottom && isWithin(edge.narrowest, own, curve.normal());
        graph_.edges.push_back(edge);
        // Of a ring of balls all edges run beside its axis and meet far away, if at all.
        const bool isAlone = stop.what == Stop::What::Outside && stop.bottom && !edge.isNeck &&
                             graph_.nodes[std::size_t(from)].balls[3] == noBall;
        if (isAlone && alone_.insert({own[0], own[1], own[2], noBall}).second)
            climb(landAt(edge.narrowest, edge.clearance, own), true);
    }

    /// Adds an edge of which an end is at the floor, if the other one is a node.
    void addStub(std::int32_t from, std::int32_t to, const Triple& own, const Start& start,
                 const Stop& stop)
    {
        if (from == to) return;
        const bool falls = to == noBall;
        const double high = falls ? start.clearance : stop.clearance;
        const auto highSide = std::int8_t(falls ? start.side : stop.side),
                   lowSide = std::int8_t(falls ? stop.side : start.side);
        graph_.stubs.push_back({{falls ? from : to, noBall},
                                graph_.floor,
                                Vec3d(0.0),
                                false,
                                own,
                                {high, graph_.floor},
                                {highSide, lowSide},
                                Vec3d(0.0)});
    }

    /// Whether a place in the plane of three centres lies in their triangle.
    bool isWithin(const Vec3d& x, const Triple& own, const Vec3d& normal) const
    {
        bool all = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3d a = ball(own[k]).center - x, b = ball(own[(k + 1) % 3]).center - x;
            all = all && a.cross(b).dot(normal) >= -tangent;
        }
        return all;
    }

    /// Follows the edge of three balls that crosses the floor near a place.
    void seed(const Triple& balls, const Vec3d& x)
    {
        const auto curve = curveOf(balls);
        if (!curve || curve->bottom() > graph_.floor || curve->top() < graph_.floor) return;
        const int side = (x - curve->origin()).dot(curve->normal()) >= 0.0 ? 1 : -1;
        if (!ends_.insert({balls[0], balls[1], balls[2], side}).second) return;
        const Vec3d at = curve->at(graph_.floor, side);
        near_.slack = -1.0;
        look(at, graph_.floor, 1.0);
        for (const std::int32_t i : near_.balls) {
            const bool isOwn = std::count(balls.begin(), balls.end(), i) > 0;
            const double gap = (at - ball(i).center).length() - ball(i).radius;
            if (!isOwn && gap < graph_.floor - tangent) return; // another ball covers it
        }
        const Start start{graph_.floor, side, true, noBall, 0.0};
        addEdge(noBall, balls, *curve, start, follow(*curve, balls, start));
    }

    void followAll()
    {
        while (!open_.empty()) {
            const std::int32_t node = open_.back();
            open_.pop_back();
            near_.slack = -1.0;
            leave(node);
            if ((++steps_ & 4095) == 0 && progress_.cancelled()) throw Cancelled();
        }
    }

    /// Follows the edges of a node that no edge came by.
    void leave(std::int32_t n)
    {
        const VoidGraph::Node node = graph_.nodes[std::size_t(n)];
        if (node.balls[3] == noBall) return leaveTop(n);
        if (slabs_.isFar(node.place, node.clearance)) return;
        look(node.place, node.clearance, 1.0 + 0.3 * std::max(node.clearance, 0.0));
        if (!isFree(node)) {
            graph_.nodes[std::size_t(n)].clearance = notFree;
            return;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (done_[std::size_t(n)] >> k & 1) continue;
            done_[std::size_t(n)] |= std::uint8_t(1 << k);
            Triple own;
            for (std::size_t i = 0, j = 0; i < 4; ++i)
                if (i != k) own[j++] = node.balls[i];
            const auto curve = curveOf(own);
            if (!curve) continue;
            // Away from the fourth ball: to where L of it falls.
            const double height = (node.place - curve->origin()).dot(curve->normal());
            const int side = height >= 0.0 ? 1 : -1;
            const Ball& last = ball(node.balls[k]);
            const double turn =
                curve->turn(curve->seen(last.center, last.radius), node.clearance, side);
            const Start start{node.clearance, side, turn < 0.0, node.balls[k], node.clearance};
            addEdge(n, own, *curve, start, follow(*curve, own, start));
        }
    }

    /// Whether no ball near is nearer to a node than its own. Where very many balls touch one ball
    /// a curve may pass a ball that it meets at an angle which rounding hides.
    bool isFree(const VoidGraph::Node& node) const
    {
        constexpr double nearer = 1e-6; // [Å]
        return std::none_of(near_.balls.begin(), near_.balls.end(), [&](std::int32_t i) {
            const double most = node.clearance + ball(i).radius - nearer;
            return most > 0.0 && (node.place - ball(i).center).lengthSqr() < most * most;
        });
    }

    /// Follows the other half of an ellipse from its top, and the way up from there.
    void leaveTop(std::int32_t n)
    {
        const VoidGraph::Node node = graph_.nodes[std::size_t(n)];
        std::array<std::int32_t, 3> own;
        std::copy_n(node.balls.begin(), 3, own.begin());
        const auto curve = curveOf(own);
        if (!curve) return;
        for (const int side : {1, -1}) {
            const auto bit = std::uint8_t(side > 0 ? 1 : 2);
            if (done_[std::size_t(n)] & bit) continue;
            done_[std::size_t(n)] |= bit;
            const Start start{node.clearance, side, false, noBall, 0.0};
            addEdge(n, own, *curve, start, follow(*curve, own, start));
        }
        climb(n);
    }

    /// A node between others, on the way up from a place.
    std::int32_t landAt(const Vec3d& x, double clearance, const Triple& balls)
    {
        next_.push_back(noBall);
        done_.push_back(0xff);
        graph_.nodes.push_back({x, clearance, {balls[0], balls[1], balls[2], noBall}});
        return std::int32_t(graph_.nodes.size()) - 1;
    }

    /// Goes up from a place that touches one, two or three balls, along a curve that touches fewer
    /// if it is the top of an edge, until it comes to an edge, and along that.
    /// @param[in] leaves  whether it leaves the edge of three balls at first
    void climb(std::int32_t n, bool leaves = false)
    {
        for (; n != VoidGraph::outside; leaves = false) {
            const VoidGraph::Node node = graph_.nodes[std::size_t(n)];
            Triple own;
            std::copy_n(node.balls.begin(), 3, own.begin());
            const bool isTop = nodes_.count(node.balls) > 0 && nodes_.at(node.balls) == n;
            if (own[2] != noBall && !isTop && !leaves) return climbEdge(n, own);
            const auto way = wayUp(node, own);
            if (!way) return;
            const auto& [curve, kept] = *way;
            near_.slack = -1.0;
            const Start start{node.clearance, 1, true, noBall, 0.0};
            const Stop stop = follow(curve, own, start);
            const Vec3d x = curve.at(stop.clearance, 1);
            Triple next = kept;
            *std::find(next.begin(), next.end(), noBall) = stop.ball;
            std::sort(next.begin(), next.end(), [](auto a, auto b) {
                return std::uint32_t(a) < std::uint32_t(b); // none is the last
            });
            const std::int32_t to = stop.what == Stop::What::Ball ? landAt(x, stop.clearance, next)
                                                                  : VoidGraph::outside;
            graph_.edges.push_back({{n, to},
                                    node.clearance,
                                    node.place,
                                    false,
                                    kept,
                                    {node.clearance, stop.clearance},
                                    {1, 1},
                                    curve.normal()});
            if (kept[1] == noBall) graph_.edges.back().away = node.place - ball(kept[0]).center;
            n = to;
        }
    }

    /// The curve of the most of some balls on which the clearance grows and the others are left.
    std::optional<std::pair<VoidCurve, Triple>> wayUp(const VoidGraph::Node& node,
                                                      const Triple& own) const
    {
        constexpr int subsets[6][2] = {{0, 1}, {0, 2}, {1, 2}, {0, -1}, {1, -1}, {2, -1}};
        for (const auto& subset : subsets) {
            const std::int32_t a = own[std::size_t(subset[0])],
                               b = subset[1] < 0 ? noBall : own[std::size_t(subset[1])];
            if (a == noBall || (b == noBall && subset[1] >= 0)) continue;
            const auto curve = b == noBall ? VoidCurve::ofOne(ball(a), node.place)
                                           : VoidCurve::ofTwo(ball(a), ball(b), node.place);
            if (!curve) continue;
            bool leaves = true;
            for (const std::int32_t i : own) {
                if (i == noBall || i == a || i == b) continue;
                const auto seen = curve->seen(ball(i).center, ball(i).radius);
                leaves = leaves &&
                         (b == noBall ? seen.slope : curve->turn(seen, node.clearance, 1)) < 0.0;
            }
            if (leaves) return std::pair(*curve, Triple{a, b, noBall});
        }
        return {};
    }

    /// Goes up an edge from a place on it.
    void climbEdge(std::int32_t n, const Triple& own)
    {
        const auto curve = curveOf(own);
        if (!curve) return;
        const VoidGraph::Node node = graph_.nodes[std::size_t(n)];
        const int side = (node.place - curve->origin()).dot(curve->normal()) >= 0.0 ? 1 : -1;
        near_.slack = -1.0;
        for (const bool rises : {true, false}) {
            const Start start{node.clearance, side, rises, noBall, 0.0};
            addEdge(n, own, *curve, start, follow(*curve, own, start));
        }
    }

    /// Climbs from a place that touches one or two balls.
    /// @param[in] b  the second, or none
    std::int32_t climbFrom(const Vec3d& x, double clearance, std::int32_t a, std::int32_t b)
    {
        if (b != noBall && b < a) std::swap(a, b);
        const std::int32_t n = landAt(x, clearance, {a, b, noBall});
        climb(n);
        followAll();
        return n;
    }

    /// Climbs from between balls that no edge touches and others: what is about them may not come
    /// down to the floor, as in a ring whose gaps are closed.
    void seedIslands(const BallBoundary& boundary)
    {
        for (const Patch& patch : boundary.patches) {
            const std::int32_t a = boundary.balls[std::size_t(patch.ball)].index;
            if (touched_[std::size_t(a)]) continue;
            std::vector<std::int32_t> near;
            index_.forEachNear(ball(a).center, ball(a).center, 2.0 * mostOutside,
                               [&](const Ball&, std::int32_t b) {
                                   if (b != a) near.push_back(b);
                               });
            for (const std::int32_t b : near) seedBetween(a, b);
        }
    }

    /// Climbs from the narrowest places between two balls, about their line.
    void seedBetween(std::int32_t a, std::int32_t b)
    {
        constexpr int ways = 8;
        const auto [first, second] =
            perpendicular((ball(b).center - ball(a).center + Vec3d(1e-30, 0.0, 0.0)).unit());
        for (int k = 0; k < ways; ++k) {
            const double angle = 6.283185307179586 * k / ways;
            const auto curve = VoidCurve::ofTwo(ball(a), ball(b),
                                                ball(a).center + first * std::cos(angle) +
                                                    second * std::sin(angle));
            if (!curve) return;
            const double d = std::max(curve->bottom() + tangent, graph_.floor);
            const Vec3d x = curve->at(d, 1);
            const bool isHeld = index_.anyNear(x, x, std::max(d, 0.0), [&](const Ball& o) {
                return (o.center - x).length() - o.radius < d - tangent;
            });
            if (!isHeld) climbFrom(x, d, a, b);
        }
    }

    VoidGraph& graph_;
    const std::vector<Ball>& balls_;
    BallIndex index_;
    const Progress& progress_;
    Slabs slabs_;
    Near near_;
    std::unordered_map<Quad, std::int32_t, HashOfBalls> nodes_; // the last one of four balls
    std::vector<std::int32_t> next_;                            // one of the same balls, or none
    std::unordered_set<Quad, HashOfBalls> alone_; // edges without nodes that were left
    std::unordered_set<Quad, HashOfBalls> ends_;  // at the floor: three balls and a side
    std::vector<std::uint8_t> done_;              // of each node the edges that are known
    std::vector<char> touched_;                   // balls that edges touch
    std::vector<std::int32_t> open_;              // nodes whose edges are not known
    std::size_t steps_ = 0;
};

/// Of each node the edge by which the way up goes on: the one to the highest node; -1 for rooms.
std::vector<std::int32_t> upwardEdges(const VoidGraph& graph)
{
    std::vector<std::int32_t> out(graph.nodes.size(), VoidGraph::none);
    std::vector<double> highest(graph.nodes.size(), -unbounded);
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const VoidGraph::Edge& edge = graph.edges[e];
        for (const std::size_t k : {0u, 1u}) {
            const auto from = std::size_t(edge.nodes[k]);
            const double own = graph.nodes[from].clearance,
                         other = graph.nodes[std::size_t(edge.nodes[1 - k])].clearance;
            if (edge.clearance < own || other <= std::max(own, highest[from])) continue;
            highest[from] = other;
            out[from] = std::int32_t(e);
        }
    }
    return out;
}

/// Makes one node of all that are outside, and leaves out those that are in a ball.
void joinOutside(VoidGraph& graph)
{
    openvdb::BBoxd box;
    for (const Ball& ball : graph.balls) box.expand(ball.center);
    const Slabs slabs(graph.balls);
    std::vector<std::int32_t> numbers(graph.nodes.size(), VoidGraph::outside);
    std::int32_t count = 1;
    for (std::size_t n = 1; n < numbers.size(); ++n) {
        if (graph.nodes[n].clearance == notFree) numbers[n] = VoidGraph::none;
        const auto& [place, clearance, own] = graph.nodes[n];
        if (numbers[n] == VoidGraph::none || !box.isInside(place) || slabs.isFar(place, clearance))
            continue;
        graph.nodes[std::size_t(count)] = graph.nodes[n];
        numbers[n] = count++;
    }
    graph.nodes.resize(std::size_t(count));
    std::size_t kept = 0;
    for (VoidGraph::Edge edge : graph.edges) {
        for (std::int32_t& n : edge.nodes) n = numbers[std::size_t(n)];
        if (std::min(edge.nodes[0], edge.nodes[1]) == VoidGraph::none) continue;
        if (edge.nodes[0] != edge.nodes[1] || edge.isNeck) graph.edges[kept++] = edge;
    }
    graph.edges.resize(kept);
    kept = 0;
    for (VoidGraph::Edge stub : graph.stubs) {
        stub.nodes[0] = numbers[std::size_t(stub.nodes[0])];
        if (stub.nodes[0] != VoidGraph::none) graph.stubs[kept++] = stub;
    }
    graph.stubs.resize(kept);
    for (std::int32_t& start : graph.starts)
        if (start != noBall) start = numbers[std::size_t(start)];
}

/// Takes the necks of the balls as they are, not as they are moved.
void takeExactNecks(const std::vector<Ball>& balls, VoidGraph& graph)
{
    for (VoidGraph::Edge& edge : graph.edges) {
        if (!edge.isNeck) continue;
        const auto ball = [&](std::size_t k) -> const Ball& {
            return balls[std::size_t(graph.balls[std::size_t(edge.balls[k])].atom)];
        };
        const auto curve = VoidCurve::ofThree(ball(0), ball(1), ball(2));
        if (!curve || !(std::abs(curve->bottom() - edge.clearance) < 2.0 * mostGrown)) continue;
        if (curve->bottom() >= std::min(edge.ends[0], edge.ends[1])) continue; // it stays a neck
        edge.clearance = curve->bottom();
        edge.narrowest = curve->at(curve->bottom(), 1);
    }
}

/// The curve of an edge.
std::optional<VoidCurve> curveOf(const VoidGraph& graph, const VoidGraph::Edge& edge)
{
    const auto ball = [&](std::size_t k) -> const Ball& {
        return graph.balls[std::size_t(edge.balls[k])];
    };
    if (edge.balls[2] != noBall) return VoidCurve::ofThree(ball(0), ball(1), ball(2));
    const Vec3d x = ball(0).center + edge.away;
    if (edge.balls[1] != noBall) return VoidCurve::ofTwo(ball(0), ball(1), x);
    return VoidCurve::ofOne(ball(0), x);
}

} // namespace

std::vector<VoidPoint> VoidGraph::pointsOf(const Edge& edge, double step) const
{
    std::vector<VoidPoint> out;
    const auto curve = curveOf(*this, edge);
    if (!curve) return out;
    // The height over the plane grows as the root of the clearance above the bottom.
    const double bottom = curve->bottom();
    const auto rootOf = [&](std::size_t k) {
        return edge.sides[k] * std::sqrt(std::max(edge.ends[k] - bottom, 0.0));
    };
    const double from = rootOf(0), to = rootOf(1);
    const auto pointAt = [&](double root) {
        const double d = bottom + root * root;
        return VoidPoint{curve->at(d, root >= 0.0 ? 1 : -1), d};
    };
    const auto refine = [&](const auto& self, double low, const VoidPoint& a, double high,
                            const VoidPoint& b) -> void {
        const double middle = 0.5 * (low + high);
        const VoidPoint m = pointAt(middle);
        const double length = (m.place - a.place).length() + (b.place - m.place).length();
        if (length > step && std::abs(high - low) > 1e-9) {
            self(self, low, a, middle, m);
            self(self, middle, m, high, b);
        } else {
            out.push_back(b);
        }
    };
    out.push_back(pointAt(from));
    const VoidPoint first = out.front();
    if (from * to < 0.0) { // the narrowest place is one of the points
        const VoidPoint middle = pointAt(0.0);
        refine(refine, from, first, 0.0, middle);
        refine(refine, 0.0, middle, to, pointAt(to));
    } else {
        refine(refine, from, first, to, pointAt(to));
    }
    return out;
}

std::vector<VoidPoint> VoidGraph::pointsFrom(const Edge& edge, std::int32_t node, double step) const
{
    std::vector<VoidPoint> out = pointsOf(edge, step);
    if (edge.nodes[0] != node) std::reverse(out.begin(), out.end());
    return out;
}

std::vector<char> leadingOut(const VoidGraph& graph)
{
    DisjointSets sets(graph.nodes.size());
    for (const VoidGraph::Edge& edge : graph.edges)
        sets.join(std::uint32_t(edge.nodes[0]), std::uint32_t(edge.nodes[1]));
    std::vector<char> out;
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n)
        out.push_back(sets.find(n) == sets.find(VoidGraph::outside));
    return out;
}

Rooms roomsOf(const VoidGraph& graph)
{
    Rooms out{upwardEdges(graph), std::vector<std::int32_t>(graph.nodes.size(), 0), {0}, {}};
    std::vector<std::int32_t> order(graph.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return graph.nodes[std::size_t(a)].clearance > graph.nodes[std::size_t(b)].clearance;
    });
    for (const std::int32_t n : order) {
        if (n == VoidGraph::outside) continue;
        std::int32_t& room = out.of[std::size_t(n)];
        const std::int32_t e = out.up[std::size_t(n)];
        if (e == VoidGraph::none) {
            room = std::int32_t(out.nodes.size());
            out.nodes.push_back(n);
        } else {
            const auto& ends = graph.edges[std::size_t(e)].nodes;
            room = out.of[std::size_t(ends[ends[0] == n ? 1 : 0])];
        }
    }
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const auto& ends = graph.edges[e].nodes;
        const std::int32_t a = out.of[std::size_t(ends[0])], b = out.of[std::size_t(ends[1])];
        if (a != b || (a == 0 && graph.edges[e].isNeck)) out.passages.push_back(std::int32_t(e));
    }
    std::stable_sort(out.passages.begin(), out.passages.end(), [&](std::int32_t a, std::int32_t b) {
        return graph.edges[std::size_t(a)].clearance > graph.edges[std::size_t(b)].clearance;
    });
    return out;
}

VoidGraph voidGraph(const std::vector<Ball>& balls, double floor, const std::vector<Vec3d>& starts,
                    const Progress& progress)
{
    VoidGraph out{floor, inGeneralPosition(balls), {}, {}, {}, {}};
    Tracer tracer(out, progress);
    tracer.run();
    for (const Vec3d& x : starts) out.starts.push_back(tracer.climbFrom(x));
    joinOutside(out);
    takeExactNecks(balls, out);
    return out;
}

} // namespace molsurf
