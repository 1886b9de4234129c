// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Ways through the void between balls.

#include "molsurf/analysis/pockets/void_graph.h"

#include <openvdb/Types.h>

#include <array>
#include <vector>

namespace molsurf
{

/// A way along the edges of a VoidGraph.
struct VoidWay {
    std::vector<VoidPoint> points; ///< from end to end; the narrowest place is one of them
    double clearance;              ///< of that; infinite if it passes no neck [Å]
    openvdb::Vec3d narrowest;      ///< [Å]
    double length;                 ///< between its outermost necks, straight [Å]
};

/// The ways through along an axis, each from below to above, the widest first.
///
/// A way leads through if it goes from below the balls to above them. Beyond its outermost necks
/// the clearance only grows, and the ball there comes to reach beyond the lowest ball, and beyond
/// the highest, before its centre leaves the outline of all centres, seen along the axis. Parts of
/// the void that come to lead through at different widths are different ways. Of all ways that are
/// as wide at their narrowest place it is the one with the least integral of ds / d^2.
/// @param[in] axis   a unit vector
/// @param[in] least  the first is found, and others that are no narrower than this [Å]
std::vector<VoidWay> waysThrough(const VoidGraph& graph, const Rooms& rooms,
                                 const openvdb::Vec3d& axis, double least);

/// How large a way is: its narrowest radius times how far a ball of that reaches from its first
/// outermost neck to its last [Å^2].
double sizeOf(double clearance, double length);

/// The axes of large ways, from the outside to the outside by the widest way on both sides of a
/// neck: from the outermost neck on one side to that on the other.
/// @param[in] most  no more than these, the largest first
std::vector<openvdb::Vec3d> likelyAxes(const VoidGraph& graph, std::size_t most);

/// Every node but the outside as a room of its own, for ways along clefts of the outside.
Rooms everyNode(const VoidGraph& graph);

/// The widest way between two places that does not go through the outside, and of these that with
/// the least integral. A place outside is reached by a way out if the ball of a place on that, of
/// 20 Å or less, holds it. If both are outside they have to lie before and behind the balls.
/// @param[in] ends  of VoidGraph::starts, the first two
/// @return one, or none if there is none in the graph
std::vector<VoidWay> waysBetween(const VoidGraph& graph, const Rooms& rooms,
                                 const std::array<openvdb::Vec3d, 2>& ends);

} // namespace molsurf
