// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/tunnel_ways.h"

#include "molsurf/analysis/pockets/void_paths.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// A way that begins at a node and leads outside, along an edge and perhaps up from there.
struct WayOutside {
    std::int32_t node;
    std::vector<VoidPoint> points; ///< from the node to the first that is outside
    double least;                  ///< clearance of these [Å]
    Vec3d narrowest;               ///< the place of that [Å]
    double width;                  ///< clearance of the widest way from the start [Å]
    double value;                  ///< integral of the best of these
    Vec3d centre;                  ///< of the large probe at its end [Å]
};

/// Where a way that was found ends.
struct Mouth {
    VoidPoint end;
    Vec3d centre; ///< of the large probe there [Å]
};

/// Finds the ways out of a node.
class TunnelSearch
{
public:
    TunnelSearch(const VoidGraph& graph, const Rooms& rooms, std::int32_t start, double probe,
                 const DepthAt& depth)
        : graph_(graph), rooms_(rooms), start_(start), probe_(probe), depth_(depth), paths_(graph),
          out_(graph.nodes.size(), unknown), width_(graph.nodes.size(), -1.0)
    {
    }

    std::vector<VoidWay> run()
    {
        spread();
        std::stable_sort(exits_.begin(), exits_.end(),
                         [](const auto& a, const auto& b) { return a.width > b.width; });
        std::vector<VoidWay> ways;
        for (std::size_t i = 0, end = 0; i < exits_.size(); i = end) {
            while (end < exits_.size() && exits_[end].width == exits_[i].width) ++end;
            addWays(i, end, ways);
        }
        return ways;
    }

private:
    static constexpr std::uint8_t unknown = 2;

    const VoidGraph::Edge& edge(std::int32_t e) const { return graph_.edges[std::size_t(e)]; }

    /// Whether a way has come out that comes to a node.
    bool isOut(std::int32_t n)
    {
        std::uint8_t& known = out_[std::size_t(n)];
        if (known == unknown) {
            const VoidGraph::Node& node = graph_.nodes[std::size_t(n)];
            known =
                rooms_.of[std::size_t(n)] == 0 || depth_(node.place, node.clearance).value <= 0.0;
        }
        return known != 0;
    }

    /// Adds points up to the first that is outside.
    /// @return whether one is
    bool addPoints(const std::vector<VoidPoint>& points, WayOutside& to) const
    {
        for (std::size_t i = to.points.empty() ? 0 : 1; i < points.size(); ++i) {
            to.points.push_back(points[i]);
            const OuterDepth::Depth depth = depth_(points[i].place, points[i].clearance);
            to.centre = depth.centre;
            if (depth.value <= 0.0) return true;
        }
        return false;
    }

    /// The way outside along an edge from a node, or up from it if there is no edge.
    WayOutside wayBy(std::int32_t e, std::int32_t n) const
    {
        WayOutside out{n,   {},        std::numeric_limits<double>::infinity(), Vec3d(0.0), 0.0,
                       0.0, Vec3d(0.0)};
        std::int32_t at = n;
        bool ended = false;
        if (e != VoidGraph::none) {
            ended = addPoints(graph_.pointsFrom(edge(e), n, wayStep), out);
            at = paths_.beyond(e, n);
        }
        while (!ended && at != VoidGraph::outside &&
               rooms_.up[std::size_t(at)] != VoidGraph::none) {
            const std::int32_t up = rooms_.up[std::size_t(at)];
            ended = addPoints(graph_.pointsFrom(edge(up), at, wayStep), out);
            at = paths_.beyond(up, at);
        }
        for (const VoidPoint& point : out.points) {
            if (point.clearance >= out.least) continue;
            out.least = point.clearance;
            out.narrowest = point.place;
        }
        constexpr double same = 1e-5; // points are of balls that are moved, by less [Å]
        if (e != VoidGraph::none && edge(e).isNeck && edge(e).clearance < out.least + same) {
            out.least = edge(e).clearance;
            out.narrowest = edge(e).narrowest;
        }
        return out;
    }

    void addExit(std::int32_t e, std::int32_t n)
    {
        exits_.push_back(wayBy(e, n));
        WayOutside& exit = exits_.back();
        if (exit.points.size() < 2)
            exits_.pop_back();
        else
            exit.width = std::min(width_[std::size_t(n)], exit.least);
    }

    /// Finds the widest way from the start to each node that is not outside (Prim's search), and
    /// what leads out of these.
    void spread()
    {
        std::vector<char> done(graph_.nodes.size(), 0);
        std::priority_queue<std::pair<double, std::int32_t>> queue;
        width_[std::size_t(start_)] = graph_.nodes[std::size_t(start_)].clearance;
        if (rooms_.of[std::size_t(start_)] == 0) { // it only widens from here on
            addExit(VoidGraph::none, start_);
            return;
        }
        queue.emplace(width_[std::size_t(start_)], start_);
        while (!queue.empty()) {
            const std::int32_t n = queue.top().second;
            queue.pop();
            if (std::exchange(done[std::size_t(n)], 1)) continue;
            paths_.forEachEdge(n, [&](std::int32_t e) {
                const std::int32_t to = paths_.beyond(e, n);
                if (isOut(to)) return addExit(e, n);
                const double width = std::min(width_[std::size_t(n)], edge(e).clearance);
                if (width <= width_[std::size_t(to)]) return;
                width_[std::size_t(to)] = width;
                queue.emplace(width, to);
            });
        }
    }

    /// Whether an exit has the mouth of a way.
    bool isTaken(const WayOutside& exit) const
    {
        const VoidPoint& end = exit.points.back();
        return std::any_of(mouths_.begin(), mouths_.end(), [&](const Mouth& mouth) {
            return (end.place - mouth.end.place).length() < end.clearance + mouth.end.clearance ||
                   (exit.centre - mouth.centre).length() < probe_;
        });
    }

    /// Whether a place lies in the ball at the end of a way.
    bool isInMouth(const Vec3d& x) const
    {
        return std::any_of(mouths_.begin(), mouths_.end(), [&](const Mouth& mouth) {
            return (x - mouth.end.place).length() < mouth.end.clearance;
        });
    }

    /// Adds the ways by exits that are as wide, those with the least integral first.
    void addWays(std::size_t begin, std::size_t end, std::vector<VoidWay>& ways)
    {
        std::vector<WayOutside*> open;
        for (std::size_t i = begin; i < end; ++i)
            if (!isTaken(exits_[i])) open.push_back(&exits_[i]);
        if (open.empty()) return;
        const double width = exits_[begin].width;
        const auto found =
            paths_.search({{start_, 0.0, VoidGraph::none}}, [&](std::int32_t e, std::int32_t to) {
                return edge(e).clearance >= width && !isOut(to) &&
                       !isInMouth(graph_.nodes[std::size_t(to)].place);
            });
        for (WayOutside* exit : open)
            exit->value = found[std::size_t(exit->node)].value + integralOf(exit->points);
        std::stable_sort(open.begin(), open.end(),
                         [](const auto* a, const auto* b) { return a->value < b->value; });
        for (const WayOutside* exit : open) {
            if (!(exit->value < std::numeric_limits<double>::infinity()) || isTaken(*exit))
                continue;
            VoidWay way = wayTo(*exit, paths_.pathTo(exit->node, found).edges);
            if (std::any_of(way.points.begin() + 1, way.points.end(),
                            [&](const VoidPoint& p) { return isInMouth(p.place); }))
                continue;
            ways.push_back(std::move(way));
            mouths_.push_back({exit->points.back(), exit->centre});
        }
    }

    /// The whole way by an exit.
    VoidWay wayTo(const WayOutside& exit, const std::vector<std::int32_t>& edges) const
    {
        VoidWay out{{}, exit.least, exit.narrowest, 0.0};
        std::int32_t n = start_;
        for (const std::int32_t e : edges) {
            const std::vector<VoidPoint> points = graph_.pointsFrom(edge(e), n, wayStep);
            out.points.insert(out.points.end(), points.begin() + (out.points.empty() ? 0 : 1),
                              points.end());
            n = paths_.beyond(e, n);
            if (edge(e).clearance >= out.clearance) continue;
            out.clearance = edge(e).clearance;
            out.narrowest = edge(e).narrowest;
        }
        out.points.insert(out.points.end(), exit.points.begin() + (out.points.empty() ? 0 : 1),
                          exit.points.end());
        return out;
    }

    const VoidGraph& graph_;
    const Rooms& rooms_;
    std::int32_t start_;
    double probe_;
    const DepthAt& depth_;
    VoidPaths paths_;
    std::vector<std::uint8_t> out_; // of nodes
    std::vector<double> width_;     // of the widest way from the start to each node; -1: none
    std::vector<WayOutside> exits_;
    std::vector<Mouth> mouths_; // of the ways that were found
};

} // namespace

std::vector<VoidWay> waysOut(const VoidGraph& graph, const Rooms& rooms, std::int32_t start,
                             double probe, const DepthAt& depth)
{
    return TunnelSearch(graph, rooms, start, probe, depth).run();
}

} // namespace molsurf
