// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/pore_ways.h"

#include "molsurf/analysis/pockets/void_paths.h"
#include "molsurf/kernel/core/orthonormal_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// What a ball on the way out comes to: bits.
enum Reached : std::uint8_t { Nothing = 0, First = 1, Second = 2, Both = 3, Beside = 4 };

/// Tells what a ball about a place outside the outermost neck has come to.
using Ending = std::function<std::uint8_t(const Vec3d&, double)>;

/// The outline of the centres of balls, seen along an axis, and what lies before and behind it.
class Outline
{
public:
    /// The convex hull of the centres seen along the axis, and the ends of the balls along it.
    Outline(const std::vector<Ball>& balls, const Vec3d& axis)
        : axis_(axis), across_(perpendicular(axis))
    {
        std::vector<Point> points;
        for (const Ball& ball : balls) {
            points.push_back(seen(ball.center));
            low_ = std::min(low_, ball.center.dot(axis) - ball.radius);
            high_ = std::max(high_, ball.center.dot(axis) + ball.radius);
        }
        std::sort(points.begin(), points.end());
        // Andrew's monotone chain: the lower hull, then the upper one.
        for (int pass = 0; pass < 2; ++pass) {
            const std::size_t begin = hull_.size();
            for (const Point& p : points) {
                while (hull_.size() >= begin + 2 &&
                       turn(hull_[hull_.size() - 2], hull_.back(), p) <= 0.0)
                    hull_.pop_back();
                hull_.push_back(p);
            }
            hull_.pop_back();
            std::reverse(points.begin(), points.end());
        }
    }

    std::uint8_t operator()(const Vec3d& x, double clearance) const
    {
        const double height = x.dot(axis_);
        const bool isBelow = height - clearance <= low_, isAbove = height + clearance >= high_;
        if (isBelow != isAbove) return isBelow ? First : Second;
        return holds(x) ? Nothing : Beside;
    }

    /// Whether it lies before, in or behind the outline.
    bool holds(const Vec3d& x) const { return holds(seen(x)); }

private:
    using Point = std::array<double, 2>;

    Point seen(const Vec3d& x) const { return {x.dot(across_[0]), x.dot(across_[1])}; }
    static double turn(const Point& o, const Point& p, const Point& q)
    {
        return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    }
    bool holds(const Point& p) const
    {
        for (std::size_t i = 0; i < hull_.size(); ++i)
            if (turn(hull_[i], hull_[(i + 1) % hull_.size()], p) < 0.0) return false;
        return true;
    }

    Vec3d axis_;
    std::array<Vec3d, 2> across_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
    std::vector<Point> hull_;
};

/// A way out: a passage, and its end that is outside.
struct Port {
    std::int32_t edge;
    std::size_t end;
    std::uint8_t reached;
};

/// Joins rooms by passages, the widest first, until some lead from one ending to the other.
class WaySearch
{
public:
    WaySearch(const VoidGraph& graph, const Rooms& rooms, Ending ending)
        : graph_(graph), rooms_(rooms), ending_(std::move(ending)), parent_(rooms.nodes.size()),
          flags_(rooms.nodes.size(), Nothing), reached_(graph.nodes.size(), unknown), paths_(graph)
    {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    /// Makes a node in a room an ending.
    void endAt(std::int32_t node, std::uint8_t flag)
    {
        inner_[flag == First ? 0 : 1] = node;
        widest_ = std::min(widest_, graph_.nodes[std::size_t(node)].clearance);
        flags_[std::size_t(roomOf(node))] |= flag;
    }

    /// Joins rooms over passages, the widest first. A way is found where a room comes to reach both
    /// ends. Passages below `least` [Å] end the search once there is a way.
    std::vector<VoidWay> run(double least)
    {
        std::vector<VoidWay> out;
        const auto add = [&](std::int32_t root, double clearance) {
            VoidWay way = wayIn(root, std::min(clearance, widest_));
            if (!way.points.empty()) out.push_back(std::move(way));
        };
        for (const std::int32_t n : inner_)
            if (n != VoidGraph::none && flags_[std::size_t(roomOf(n))] == Both) {
                add(roomOf(n), widest_);
                return out;
            }
        for (const std::int32_t e : rooms_.passages) {
            const VoidGraph::Edge& edge = graph_.edges[std::size_t(e)];
            if (!out.empty() && edge.clearance < least) break;
            const std::int32_t a = find(roomOf(edge.nodes[0])), b = find(roomOf(edge.nodes[1]));
            std::array<std::uint8_t, 2> ends = {Nothing, Nothing};
            for (const std::size_t k : {0u, 1u}) {
                if (roomOf(edge.nodes[k]) != 0) continue;
                ends[k] = reachedBy(e, k);
                if (ends[k] & Both) ports_.push_back({e, k, ends[k]});
            }
            if (a == 0 && b == 0) {
                if ((ends[0] | ends[1]) == Both && ends[0] != Both && ends[1] != Both)
                    out.push_back(wayOver(e, ends[0] == First ? 0 : 1));
                continue;
            }
            const std::int32_t root = std::max(a, b);
            const bool wasThrough =
                flags_[std::size_t(a)] == Both || flags_[std::size_t(b)] == Both;
            auto& flags = flags_[std::size_t(root)];
            if (a != 0 && b != 0) {
                flags |= flags_[std::size_t(std::min(a, b))];
                parent_[std::size_t(std::min(a, b))] = root;
            } else {
                flags |= std::uint8_t((ends[0] | ends[1]) & Both);
            }
            if (flags == Both && !wasThrough) add(root, edge.clearance);
        }
        return out;
    }

private:
    static constexpr std::uint8_t unknown = 255;

    std::int32_t roomOf(std::int32_t node) const { return rooms_.of[std::size_t(node)]; }
    std::int32_t find(std::int32_t room)
    {
        while (parent_[std::size_t(room)] != room)
            room = parent_[std::size_t(room)] = parent_[std::size_t(parent_[std::size_t(room)])];
        return room;
    }

    /// Points of an edge towards an end, from its narrowest place on.
    std::vector<VoidPoint> outwards(std::int32_t e, std::size_t end) const
    {
        const VoidGraph::Edge& edge = graph_.edges[std::size_t(e)];
        std::vector<VoidPoint> points = graph_.pointsOf(edge, wayStep);
        if (end == 0) std::reverse(points.begin(), points.end());
        const auto least = std::min_element(
            points.begin(), points.end(),
            [](const VoidPoint& a, const VoidPoint& b) { return a.clearance < b.clearance; });
        points.erase(points.begin(), least);
        return points;
    }

    std::uint8_t firstOf(const std::vector<VoidPoint>& points) const
    {
        for (const VoidPoint& p : points)
            if (const std::uint8_t reached = ending_(p.place, p.clearance)) return reached;
        return Nothing;
    }

    /// What the way up from a node beside all rooms comes to first.
    std::uint8_t reachedFrom(std::int32_t node)
    {
        std::vector<std::int32_t> passed;
        std::uint8_t reached = Nothing;
        for (std::int32_t n = node; n != VoidGraph::outside && !reached;) {
            if (reached_[std::size_t(n)] != unknown) {
                reached = reached_[std::size_t(n)];
                break;
            }
            passed.push_back(n);
            const VoidGraph::Edge& edge = graph_.edges[std::size_t(rooms_.up[std::size_t(n)])];
            reached = firstOf(graph_.pointsFrom(edge, n, wayStep));
            n = edge.nodes[edge.nodes[0] == n ? 1 : 0];
        }
        for (const std::int32_t n : passed) reached_[std::size_t(n)] = reached;
        return reached;
    }

    std::uint8_t reachedBy(std::int32_t e, std::size_t end)
    {
        const std::uint8_t reached = firstOf(outwards(e, end));
        return reached ? reached : reachedFrom(graph_.edges[std::size_t(e)].nodes[end]);
    }

    /// The points of a way out from the narrowest place of its passage to where it ends.
    std::vector<VoidPoint> wayOut(std::int32_t e, std::size_t end) const
    {
        std::vector<VoidPoint> out;
        const auto add = [&](const std::vector<VoidPoint>& points) {
            for (const VoidPoint& p : points) {
                out.push_back(p);
                if (ending_(p.place, p.clearance)) return true;
            }
            return false;
        };
        if (add(outwards(e, end))) return out;
        for (std::int32_t n = graph_.edges[std::size_t(e)].nodes[end]; n != VoidGraph::outside;) {
            const VoidGraph::Edge& edge = graph_.edges[std::size_t(rooms_.up[std::size_t(n)])];
            if (add(graph_.pointsFrom(edge, n, wayStep))) return out;
            n = edge.nodes[edge.nodes[0] == n ? 1 : 0];
        }
        return out;
    }

    /// A way over a neck between the outside and itself.
    VoidWay wayOver(std::int32_t e, std::size_t first) const
    {
        std::vector<VoidPoint> points = wayOut(e, first);
        std::reverse(points.begin(), points.end());
        const std::vector<VoidPoint> rest = wayOut(e, 1 - first);
        points.insert(points.end(), rest.begin() + 1, rest.end());
        const VoidGraph::Edge& edge = graph_.edges[std::size_t(e)];
        return {std::move(points), edge.clearance, edge.narrowest, 0.0};
    }

    std::size_t innerEnd(const Port& port) const { return 1 - port.end; }
    std::int32_t innerNode(const Port& port) const
    {
        return graph_.edges[std::size_t(port.edge)].nodes[innerEnd(port)];
    }
    bool isOf(const Port& port, std::int32_t root, Reached flag)
    {
        return (port.reached & flag) && find(roomOf(innerNode(port))) == root;
    }
    double valueOf(const Port& port)
    {
        return paths_.weightOf(port.edge) + integralOf(wayOut(port.edge, port.end));
    }

    /// The way with the least integral through rooms that are joined by now.
    VoidWay wayIn(std::int32_t root, double least)
    {
        std::vector<VoidPaths::Begin> begins;
        if (inner_[0] != VoidGraph::none)
            begins.push_back({inner_[0], 0.0, VoidGraph::none});
        else
            for (std::size_t p = 0; p < ports_.size(); ++p)
                if (isOf(ports_[p], root, First))
                    begins.push_back({innerNode(ports_[p]), valueOf(ports_[p]), std::int32_t(p)});
        return trace(root, paths_.search(begins, [&](std::int32_t e, std::int32_t to) {
            return graph_.edges[std::size_t(e)].clearance >= least && roomOf(to) != 0 &&
                   find(roomOf(to)) == root;
        }));
    }

    /// The way that a search found, to the best of the second endings.
    VoidWay trace(std::int32_t root, const std::vector<VoidPaths::Found>& found)
    {
        constexpr double infinitely = std::numeric_limits<double>::infinity();
        VoidWay way{{}, infinitely, Vec3d(0.0), 0.0};
        const Port* last = nullptr;
        std::int32_t at = inner_[1];
        double best = at == VoidGraph::none ? infinitely : found[std::size_t(at)].value;
        if (at == VoidGraph::none)
            for (const Port& port : ports_) {
                if (!isOf(port, root, Second)) continue;
                const double value = found[std::size_t(innerNode(port))].value + valueOf(port);
                if (value >= best) continue;
                best = value;
                last = &port;
                at = innerNode(port);
            }
        if (!(best < infinitely)) return way;
        const VoidPaths::Path path = paths_.pathTo(at, found);
        const Port* first =
            path.begin == VoidGraph::none ? nullptr : &ports_[std::size_t(path.begin)];
        if (first) addPort(*first, true, way);
        std::int32_t n = path.node;
        for (const std::int32_t e : path.edges) {
            addEdge(e, n, way);
            n = paths_.beyond(e, n);
        }
        if (last) addPort(*last, false, way);
        if (path.edges.empty() && !first && !last) {
            const VoidGraph::Node& node = graph_.nodes[std::size_t(at)];
            way.points = {{node.place, node.clearance}};
        }
        if (first && last)
            way.length = (graph_.edges[std::size_t(first->edge)].narrowest -
                          graph_.edges[std::size_t(last->edge)].narrowest)
                             .length();
        return way;
    }

    void note(const VoidGraph::Edge& edge, VoidWay& way) const
    {
        // An end may be narrower: it is no place that the way has to pass.
        if (!edge.isNeck || edge.clearance >= way.clearance) return;
        way.clearance = edge.clearance;
        way.narrowest = edge.narrowest;
    }

    void append(const std::vector<VoidPoint>& points, VoidWay& way) const
    {
        way.points.insert(way.points.end(), points.begin() + (way.points.empty() ? 0 : 1),
                          points.end());
    }

    void addEdge(std::int32_t e, std::int32_t from, VoidWay& way) const
    {
        const VoidGraph::Edge& edge = graph_.edges[std::size_t(e)];
        note(edge, way);
        append(graph_.pointsFrom(edge, from, wayStep), way);
    }

    /// Adds a passage to the outside and the way out.
    void addPort(const Port& port, bool inwards, VoidWay& way) const
    {
        note(graph_.edges[std::size_t(port.edge)], way);
        std::vector<VoidPoint> inner = outwards(port.edge, innerEnd(port)),
                               outer = wayOut(port.edge, port.end);
        if (inwards) {
            std::reverse(outer.begin(), outer.end());
            append(outer, way);
            append(inner, way);
        } else {
            std::reverse(inner.begin(), inner.end());
            append(inner, way);
            append(outer, way);
        }
    }

    const VoidGraph& graph_;
    const Rooms& rooms_;
    Ending ending_;
    std::vector<std::int32_t> parent_;  // of rooms
    std::vector<std::uint8_t> flags_;   // of joined rooms what they lead to
    std::vector<std::uint8_t> reached_; // by nodes outside
    VoidPaths paths_;
    std::vector<Port> ports_;                                                // of passages by now
    std::array<std::int32_t, 2> inner_ = {VoidGraph::none, VoidGraph::none}; // endings in rooms
    double widest_ = std::numeric_limits<double>::infinity();                // at these
};

/// The edges by which the outside is reached from each node by the widest way, as a tree.
class WidestTree
{
public:
    /// The maximum spanning tree by clearance (Kruskal), and the steps in it from the outside.
    /// Necks that close a loop with the outside are kept apart.
    explicit WidestTree(const VoidGraph& graph)
        : graph_(graph), parent_(graph.nodes.size()), back_(graph.nodes.size(), VoidGraph::none)
    {
        std::iota(parent_.begin(), parent_.end(), 0);
        std::vector<std::int32_t> order(graph.edges.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
            return edge(a).clearance > edge(b).clearance;
        });
        std::vector<std::vector<std::int32_t>> kept(graph.nodes.size());
        for (const std::int32_t e : order) {
            const std::int32_t a = find(edge(e).nodes[0]), b = find(edge(e).nodes[1]);
            if (a == b) {
                if (edge(e).isNeck && a == find(VoidGraph::outside)) loops_.push_back(e);
                continue;
            }
            parent_[std::size_t(std::max(a, b))] = std::min(a, b);
            for (const std::int32_t n : edge(e).nodes) kept[std::size_t(n)].push_back(e);
        }
        std::vector<std::int32_t> open = {VoidGraph::outside};
        while (!open.empty()) {
            const std::int32_t n = open.back();
            open.pop_back();
            for (const std::int32_t e : kept[std::size_t(n)]) {
                if (e == back_[std::size_t(n)]) continue;
                const std::int32_t to = edge(e).nodes[edge(e).nodes[0] == n ? 1 : 0];
                back_[std::size_t(to)] = e;
                open.push_back(to);
            }
        }
    }

    /// Necks that join the outside with itself, the widest first.
    const std::vector<std::int32_t>& loops() const { return loops_; }

    /// The outermost neck on the way out from an end of a neck.
    const Vec3d& outermost(std::int32_t neck, std::size_t end) const
    {
        std::int32_t last = neck;
        for (std::int32_t n = edge(neck).nodes[end]; n != VoidGraph::outside;) {
            const std::int32_t e = back_[std::size_t(n)];
            if (edge(e).isNeck) last = e;
            n = edge(e).nodes[edge(e).nodes[0] == n ? 1 : 0];
        }
        return edge(last).narrowest;
    }

private:
    const VoidGraph::Edge& edge(std::int32_t e) const { return graph_.edges[std::size_t(e)]; }
    std::int32_t find(std::int32_t n)
    {
        while (parent_[std::size_t(n)] != n)
            n = parent_[std::size_t(n)] = parent_[std::size_t(parent_[std::size_t(n)])];
        return n;
    }

    const VoidGraph& graph_;
    std::vector<std::int32_t> parent_, back_, loops_;
};

} // namespace

double sizeOf(double clearance, double length)
{
    return clearance * (length + 2.0 * clearance);
}

std::vector<Vec3d> likelyAxes(const VoidGraph& graph, std::size_t most)
{
    const WidestTree tree(graph);
    std::vector<std::pair<double, Vec3d>> found;
    for (const std::int32_t e : tree.loops()) {
        Vec3d way = tree.outermost(e, 1) - tree.outermost(e, 0);
        const double length = way.length();
        if (!way.normalize(1e-3)) continue;
        found.emplace_back(sizeOf(graph.edges[std::size_t(e)].clearance, length), way);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Vec3d> out;
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) out.push_back(found[i].second);
    return out;
}

std::vector<VoidWay> waysThrough(const VoidGraph& graph, const Rooms& rooms, const Vec3d& axis,
                                 double least)
{
    return WaySearch(graph, rooms, Outline(graph.balls, axis)).run(least);
}

Rooms everyNode(const VoidGraph& graph)
{
    Rooms out = roomsOf(graph);
    std::iota(out.of.begin(), out.of.end(), 0);
    out.nodes = out.of;
    out.passages.clear();
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const auto& ends = graph.edges[e].nodes;
        if (std::min(ends[0], ends[1]) != VoidGraph::outside)
            out.passages.push_back(std::int32_t(e));
    }
    std::stable_sort(out.passages.begin(), out.passages.end(), [&](std::int32_t a, std::int32_t b) {
        return graph.edges[std::size_t(a)].clearance > graph.edges[std::size_t(b)].clearance;
    });
    return out;
}

std::vector<VoidWay> waysBetween(const VoidGraph& graph, const Rooms& rooms,
                                 const std::array<Vec3d, 2>& ends)
{
    constexpr double mostBefore = 20.0; // of a ball in front of a mouth [Å]
    std::array<bool, 2> isInside;
    for (const std::size_t k : {0u, 1u}) {
        if (graph.starts[k] == VoidGraph::none) return {};
        isInside[k] = rooms.of[std::size_t(graph.starts[k])] != 0;
    }
    const Outline outline(graph.balls, (ends[1] - ends[0]).unit());
    if (!isInside[0] && !isInside[1] && !outline.holds(ends[0])) return {};
    const auto ending = [&](const Vec3d& x, double clearance) {
        std::uint8_t out = Nothing;
        for (const std::size_t k : {0u, 1u})
            if (!isInside[k] && clearance <= mostBefore && (ends[k] - x).length() <= clearance)
                out |= std::uint8_t(k == 0 ? First : Second);
        return out;
    };
    WaySearch search(graph, rooms, ending);
    for (const std::size_t k : {0u, 1u})
        if (isInside[k]) search.endAt(graph.starts[k], k == 0 ? First : Second);
    std::vector<VoidWay> out = search.run(std::numeric_limits<double>::infinity());
    for (VoidWay& way : out) {
        way.points.insert(way.points.begin(), {ends[0], way.points.front().clearance});
        way.points.push_back({ends[1], way.points.back().clearance});
    }
    return out;
}

} // namespace molsurf
