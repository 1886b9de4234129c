// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/mouth_ways.h"

#include "molsurf/core/parallel.h"
#include "molsurf/pockets/void_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// A way out of a basin: from a node of it to where an edge comes to the cut.
struct Exit {
    std::int32_t node;
    double least;    ///< clearance on the way there [Å]
    Vec3d narrowest; ///< the place of that [Å]
    VoidPoint end;
};

/// The part of a graph in a basin.
struct BasinPart {
    std::vector<std::int32_t> nodes;
    std::vector<std::int32_t> edges;
    std::vector<Exit> exits;
};

/// Where a way along an edge comes to the cut, by halving; `least` and `narrowest` of what is
/// before that.
Exit exitAlong(const VoidGraph& graph, const VoidGraph::Edge& edge, std::int32_t node,
               const BelowCut& below)
{
    constexpr double step = 0.3; // [Å]
    Exit out{node, std::numeric_limits<double>::infinity(), Vec3d(0.0), {Vec3d(0.0), 0.0}};
    const auto note = [&](const VoidPoint& p) {
        out.end = p;
        if (p.clearance >= out.least) return;
        out.least = p.clearance;
        out.narrowest = p.place;
    };
    const auto isIn = [&](const VoidPoint& p) { return below(p.place, p.clearance) > 0.0; };
    std::vector<VoidPoint> points = graph.pointsFrom(edge, node, step);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == 0 || isIn(points[i])) {
            note(points[i]);
            continue;
        }
        VoidPoint in = points[i - 1], beyond = points[i];
        for (int k = 0; k < 10; ++k) { // to 0.3 mÅ
            const VoidPoint middle{0.5 * (in.place + beyond.place),
                                   0.5 * (in.clearance + beyond.clearance)};
            (isIn(middle) ? in : beyond) = middle;
        }
        note(in);
        break;
    }
    return out;
}

/// The parts of a graph in each basin.
std::vector<BasinPart> partsOf(const VoidGraph& graph, const VoidField& space, const Basins& basins,
                               const BelowCut& below, const Progress& progress)
{
    std::vector<std::int32_t> basinOf(graph.nodes.size(), -1);
    constexpr std::size_t chunk = 256;
    parallelFor((graph.nodes.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t n = std::max<std::size_t>(c * chunk, 1);
             n < std::min(graph.nodes.size(), (c + 1) * chunk); ++n) {
            const VoidGraph::Node& node = graph.nodes[n];
            const std::int32_t basin = basinAbout(space, basins, node.place);
            if (basin >= 0 && below(node.place, node.clearance) > 0.0) basinOf[n] = basin;
        }
    });
    std::vector<BasinPart> out(basins.count());
    for (std::size_t n = 0; n < basinOf.size(); ++n)
        if (basinOf[n] >= 0) out[std::size_t(basinOf[n])].nodes.push_back(std::int32_t(n));
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const VoidGraph::Edge& edge = graph.edges[e];
        const std::int32_t a = basinOf[std::size_t(edge.nodes[0])],
                           b = basinOf[std::size_t(edge.nodes[1])];
        if (a >= 0 && a == b) out[std::size_t(a)].edges.push_back(std::int32_t(e));
        if ((a < 0) == (b < 0)) continue;
        const std::size_t end = a >= 0 ? 0 : 1;
        out[std::size_t(std::max(a, b))].exits.push_back(
            exitAlong(graph, edge, edge.nodes[end], below));
    }
    return out;
}

/// Widest paths from the widest place of a part.
class PartWays
{
public:
    PartWays(const VoidGraph& graph, const BasinPart& part) : part_(part)
    {
        for (const std::int32_t e : part.edges)
            for (const std::int32_t n : graph.edges[std::size_t(e)].nodes) near_[n].push_back(e);
        for (const std::int32_t n : part.nodes) {
            const VoidGraph::Node& node = graph.nodes[std::size_t(n)];
            consider(node.clearance, node.place, n);
        }
        for (const Exit& exit : part.exits) consider(exit.end.clearance, exit.end.place, exit.node);
        if (start_ == VoidGraph::none) return;
        MouthWay begin{widest_, place_, false};
        for (const Exit& exit : part.exits)
            if (exit.node == start_ && exit.end.place == place_)
                begin = narrowed(begin, exit.least, exit.narrowest);
        search(graph, begin);
    }

    /// The widest way to the end of an exit.
    MouthWay to(const Exit& exit) const
    {
        const auto found = best_.find(exit.node);
        if (found == best_.end()) return {};
        if (exit.end.place == place_) return {widest_, place_, false};
        return narrowed(found->second, exit.least, exit.narrowest);
    }

private:
    void consider(double clearance, const Vec3d& place, std::int32_t node)
    {
        if (clearance <= widest_) return;
        widest_ = clearance;
        place_ = place;
        start_ = node;
    }

    static MouthWay narrowed(const MouthWay& way, double clearance, const Vec3d& place)
    {
        if (clearance >= way.radius) return way;
        return {clearance, place, true};
    }

    void search(const VoidGraph& graph, const MouthWay& begin)
    {
        std::priority_queue<std::pair<double, std::int32_t>> open;
        best_[start_] = begin;
        open.emplace(begin.radius, start_);
        while (!open.empty()) {
            const auto [radius, n] = open.top();
            open.pop();
            if (radius < best_.at(n).radius) continue;
            const auto near = near_.find(n);
            if (near == near_.end()) continue;
            for (const std::int32_t e : near->second) {
                const VoidGraph::Edge& edge = graph.edges[std::size_t(e)];
                const std::int32_t other = edge.nodes[edge.nodes[0] == n ? 1 : 0];
                const MouthWay way = narrowed(best_.at(n), edge.clearance, edge.narrowest);
                MouthWay& there = best_[other];
                if (way.radius <= there.radius) continue;
                there = way;
                open.emplace(way.radius, other);
            }
        }
    }

    const BasinPart& part_;
    std::map<std::int32_t, std::vector<std::int32_t>> near_; // edges of nodes
    std::map<std::int32_t, MouthWay> best_;                  // to nodes
    double widest_ = -1.0;
    Vec3d place_{0.0};
    std::int32_t start_ = VoidGraph::none;
};

/// The mouth whose voxels are nearest to a place, or the number of mouths.
std::size_t mouthAt(const VoidField& space, const std::vector<BasinMeasure::Mouth>& mouths,
                    const Vec3d& x)
{
    const double reach = 2.0 * space.voxelSize; // of voxels beside the cut
    double least = reach * reach;
    std::size_t best = mouths.size();
    for (std::size_t m = 0; m < mouths.size(); ++m)
        for (const VoxelPlace place : mouths[m].voxels) {
            const int v = int(place % leafSize);
            const Vec3d at =
                space.table.origin(place / leafSize).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
                space.voxelSize;
            const double square = (at - x).lengthSqr();
            if (square >= least) continue;
            least = square;
            best = m;
        }
    return best;
}

} // namespace

std::vector<std::vector<MouthWay>> mouthWays(const VoidField& space, const RoomBasins& split,
                                             const std::vector<BasinMeasure>& measures,
                                             const BelowCut& below, const Progress& progress)
{
    const auto& [basins, graph] = split;
    const std::vector<BasinPart> parts = partsOf(graph, space, basins, below, progress);
    std::vector<std::vector<MouthWay>> out(basins.count());
    for (std::size_t b = 0; b < basins.count(); ++b) {
        const auto& mouths = measures[b].mouths;
        out[b].resize(mouths.size());
        if (mouths.empty() || parts[b].nodes.empty()) continue;
        const PartWays ways(graph, parts[b]);
        for (const Exit& exit : parts[b].exits) {
            const std::size_t mouth = mouthAt(space, mouths, exit.end.place);
            if (mouth == mouths.size()) continue;
            const MouthWay way = ways.to(exit);
            if (way.radius > out[b][mouth].radius) out[b][mouth] = way;
        }
    }
    return out;
}

} // namespace molsurf
