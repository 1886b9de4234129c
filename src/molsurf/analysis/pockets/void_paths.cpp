// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/void_paths.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace molsurf
{

double integralOf(const std::vector<VoidPoint>& points)
{
    const auto weight = [](double d) { return 1.0 / (std::max(d, 0.1) * std::max(d, 0.1)); };
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
        sum += 0.5 * (weight(points[i].clearance) + weight(points[i - 1].clearance)) *
               (points[i].place - points[i - 1].place).length();
    return sum;
}

VoidPaths::VoidPaths(const VoidGraph& graph)
    : graph_(graph), weights_(graph.edges.size(), -1.0), begins_(graph.nodes.size() + 1, 0)
{
    for (const VoidGraph::Edge& edge : graph.edges)
        for (const std::int32_t n : edge.nodes) ++begins_[std::size_t(n) + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    edges_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
        for (const std::int32_t n : graph.edges[e].nodes)
            edges_[next[std::size_t(n)]++] = std::int32_t(e);
}

double VoidPaths::weightOf(std::int32_t e)
{
    double& weight = weights_[std::size_t(e)];
    if (weight < 0.0) weight = integralOf(graph_.pointsOf(graph_.edges[std::size_t(e)], wayStep));
    return weight;
}

std::vector<VoidPaths::Found> VoidPaths::search(const std::vector<Begin>& begins,
                                                const Passes& passes)
{
    std::vector<Found> found(graph_.nodes.size());
    using Entry = std::pair<double, std::int32_t>; // the lower node of equals first
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Begin& begin : begins) {
        if (begin.value >= found[std::size_t(begin.node)].value) continue;
        found[std::size_t(begin.node)] = {begin.value, VoidGraph::none, begin.name};
        queue.emplace(begin.value, begin.node);
    }
    while (!queue.empty()) {
        const auto [value, n] = queue.top();
        queue.pop();
        if (value > found[std::size_t(n)].value) continue;
        const double here = value;
        const std::int32_t from = n;
        forEachEdge(n, [&](std::int32_t e) {
            const std::int32_t to = beyond(e, from);
            if (!passes(e, to)) return;
            const double there = here + weightOf(e);
            if (there >= found[std::size_t(to)].value) return;
            found[std::size_t(to)] = {there, e, VoidGraph::none};
            queue.emplace(there, to);
        });
    }
    return found;
}

VoidPaths::Path VoidPaths::pathTo(std::int32_t node, const std::vector<Found>& found) const
{
    Path out{node, VoidGraph::none, {}};
    while (found[std::size_t(out.node)].edge != VoidGraph::none) {
        out.edges.push_back(found[std::size_t(out.node)].edge);
        out.node = beyond(out.edges.back(), out.node);
    }
    out.begin = found[std::size_t(out.node)].begin;
    std::reverse(out.edges.begin(), out.edges.end());
    return out;
}

} // namespace molsurf
