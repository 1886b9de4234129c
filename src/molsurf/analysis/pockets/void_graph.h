// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The void between balls as a graph.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace molsurf
{

/// A place in the void, and how large a ball about it may be.
struct VoidPoint {
    openvdb::Vec3d place; ///< [Å]
    double clearance;     ///< [Å]
};

/// The graph of the clearance d(x) = min_i (|x - x_i| - r_i) of balls, where it is above a floor.
///
/// Its nodes are the places that touch four balls, its edges the curves that touch three: the edges
/// of the Voronoi diagram of the balls. What a ball of radius r >= floor passes are the edges whose
/// narrowest place is r or more: every maximum of d is a node, and every saddle where two parts of
/// {d > r} meet is the narrowest place of an edge. A saddle has its centre in the triangle of its
/// three balls (a neck); from both sides of it edges lead up, from node to node, to a maximum (a
/// room) or to the outside.
///
/// Balls are moved, and radii changed, by 1e-6 Å at most, so that no five balls touch one ball: d
/// changes by no more, and so does what passes from place to place. Necks are those of the balls as
/// they are. A ring of many balls then is a bundle of edges between the same two rooms.
struct VoidGraph {
    /// The node that stands for all that is outside: of a place beside the box of all centres d
    /// grows on the way straight from the box.
    static constexpr std::int32_t outside = 0;
    static constexpr std::int32_t none = -1;

    /// A place that touches four balls; three if it is the top of an edge that is an ellipse.
    struct Node {
        openvdb::Vec3d place;              ///< [Å]
        double clearance;                  ///< [Å]; infinite outside
        std::array<std::int32_t, 4> balls; ///< places in `balls`, ascending; none: there are fewer
    };

    /// A curve that touches three balls, or two or one on the way up from the top of an ellipse.
    struct Edge {
        std::array<std::int32_t, 2> nodes;
        double clearance;                  ///< of its narrowest place [Å]
        openvdb::Vec3d narrowest;          ///< [Å]
        bool isNeck;                       ///< whether that is a saddle, not an end of it
        std::array<std::int32_t, 3> balls; ///< places in `balls`, ascending; none: there are fewer
        std::array<double, 2> ends;        ///< clearance at both ends; that of the outside is
                                           ///< where it leaves the box of the centres [Å]
        std::array<std::int8_t, 2> sides;  ///< of the plane of the balls, of both ends: 1 or -1
        openvdb::Vec3d away;               ///< from the line of two balls, or from the one
    };

    double floor;            ///< [Å]
    std::vector<Ball> balls; ///< moved; Ball::atom is the index in the caller's vector
    std::vector<Node> nodes; ///< the first is the outside
    std::vector<Edge> edges;
    std::vector<Edge> stubs; ///< edges from a node down to the floor: the other node is none
    std::vector<std::int32_t> starts; ///< nodes of places from which edges lead up into the graph;
                                      ///< none: it is below the floor

    /// Points of an edge from its first node to its second, no farther apart than a step.
    std::vector<VoidPoint> pointsOf(const Edge& edge, double step) const;
    /// The same way from a node that it ends at.
    std::vector<VoidPoint> pointsFrom(const Edge& edge, std::int32_t node, double step) const;
};

/// Makes the graph; linear in the number of balls that have few near them.
/// @param[in] balls  at least one, every one finite
/// @param[in] floor   above minus the least radius [Å]
/// @param[in] starts  places of VoidGraph::starts
VoidGraph voidGraph(const std::vector<Ball>& balls, double floor,
                    const std::vector<openvdb::Vec3d>& starts, const Progress& progress);

/// Of each node whether a ball of the floor gets out from there.
std::vector<char> leadingOut(const VoidGraph& graph);

/// The maxima of the clearance, and what lies between them.
struct Rooms {
    std::vector<std::int32_t> up; ///< of each node the edge by which the way up goes on, or none
    std::vector<std::int32_t> of; ///< of each node the room that this way leads to, from 1; 0: the
                                  ///< outside
    std::vector<std::int32_t> nodes;    ///< of each room; the first is the outside
    std::vector<std::int32_t> passages; ///< edges between different rooms, and necks between the
                                        ///< outside and itself; the widest first
};

/// Finds them.
Rooms roomsOf(const VoidGraph& graph);

} // namespace molsurf
