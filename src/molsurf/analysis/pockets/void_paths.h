// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Ways along the edges of a VoidGraph that are as short and as wide as can be.

#include "molsurf/analysis/pockets/void_graph.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace molsurf
{

/// Points of ways are no farther apart [Å].
constexpr double wayStep = 0.25;

/// The integral of ds / d^2 over points, with d at least 0.1 Å: by the trapezoidal rule [1/Å].
double integralOf(const std::vector<VoidPoint>& points);

/// The ways with the least integral, by Dijkstra's search.
class VoidPaths
{
public:
    explicit VoidPaths(const VoidGraph& graph);

    /// Where ways begin, perhaps with a part that is no edge.
    struct Begin {
        std::int32_t node;
        double value;      ///< the integral of that part
        std::int32_t name; ///< of it, for the caller
    };
    /// What a search found of a node.
    struct Found {
        double value = std::numeric_limits<double>::infinity(); ///< the least integral
        std::int32_t edge = VoidGraph::none;  ///< by which the way came; none: it begins here
        std::int32_t begin = VoidGraph::none; ///< Begin::name of that
    };
    /// Tells whether ways may take an edge to a node.
    using Passes = std::function<bool(std::int32_t edge, std::int32_t to)>;

    std::vector<Found> search(const std::vector<Begin>& begins, const Passes& passes);

    /// The edges of a way, the first first.
    struct Path {
        std::int32_t node, begin; ///< where it begins
        std::vector<std::int32_t> edges;
    };
    /// The way to a node that a search found.
    Path pathTo(std::int32_t node, const std::vector<Found>& found) const;

    /// The integral of an edge.
    double weightOf(std::int32_t edge);

    /// The node at the other end of an edge.
    std::int32_t beyond(std::int32_t edge, std::int32_t node) const
    {
        const auto& ends = graph_.edges[std::size_t(edge)].nodes;
        return ends[ends[0] == node ? 1 : 0];
    }

    /// Calls f(edge) for the edges of a node.
    template<typename F>
    void forEachEdge(std::int32_t node, const F& f) const
    {
        for (std::size_t i = begins_[std::size_t(node)]; i < begins_[std::size_t(node) + 1]; ++i)
            f(edges_[i]);
    }

private:
    const VoidGraph& graph_;
    std::vector<double> weights_;     // of edges; negative: not known yet
    std::vector<std::size_t> begins_; // of each node in edges_
    std::vector<std::int32_t> edges_;
};

} // namespace molsurf
