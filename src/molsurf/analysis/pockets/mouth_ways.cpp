// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/mouth_ways.h"

#include "molsurf/analysis/pockets/void_graph.h"

#include <algorithm>
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
using Exit = CutGraph::Exit;

/// The part of a graph in a basin.
struct BasinPart {
    std::vector<std::int32_t> nodes;
    std::vector<std::int32_t> edges;
    std::vector<Exit> exits;
};

/// The parts of a graph in each basin.
std::vector<BasinPart> partsOf(const RoomBasins& split)
{
    std::vector<BasinPart> out(split.basins.count());
    const auto basinOf = [&](std::int32_t n) { return split.ofNodes[std::size_t(n)]; };
    for (std::size_t n = 0; n < split.ofNodes.size(); ++n)
        if (split.ofNodes[n] >= 0)
            out[std::size_t(split.ofNodes[n])].nodes.push_back(std::int32_t(n));
    for (std::size_t e = 0; e < split.graph.edges.size(); ++e) {
        const auto& [a, b] = split.graph.edges[e].nodes;
        if (basinOf(a) >= 0 && basinOf(a) == basinOf(b))
            out[std::size_t(basinOf(a))].edges.push_back(std::int32_t(e));
    }
    for (const Exit& exit : split.cut.exits)
        if (exit.node != VoidGraph::none && basinOf(exit.node) >= 0)
            out[std::size_t(basinOf(exit.node))].exits.push_back(exit);
    return out;
}

/// Widest paths from the widest place of a part.
class PartWays
{
public:
    /// Searches from the widest place of the part.
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
            const double square = (space.pointOf(place) - x).lengthSqr();
            if (square >= least) continue;
            least = square;
            best = m;
        }
    return best;
}

} // namespace

std::vector<std::vector<MouthWay>> mouthWays(const VoidField& space, const RoomBasins& split,
                                             const std::vector<BasinMeasure>& measures)
{
    const Basins& basins = split.basins;
    const VoidGraph& graph = split.graph;
    const std::vector<BasinPart> parts = partsOf(split);
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
