// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_tunnels.h"

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/analysis/pockets/find_pore.h"
#include "molsurf/analysis/pockets/tunnel_ways.h"
#include "molsurf/analysis/pockets/void_graph.h"
#include "molsurf/error.h"
#include "molsurf/kernel/balls/depth.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Station = Report::Pore::Station;

/// The room beside the middle of atoms: of those within 12 Å that with the largest ball, less 0.2 Å
/// for each Å of way, as ends of pores are found; none: there is none.
std::int32_t roomBeside(const VoidGraph& graph, const Rooms& rooms, const Vec3d& x,
                        const DepthAt& depth)
{
    // measured: 1ACJ and 1EVE, the catalytic residues, whose middle is 7 to 10 Å from the gorge and
    // within 3 Å of gaps with balls of 1.3 Å
    constexpr double farthest = 12.0, perLength = 0.2;
    std::int32_t best = VoidGraph::none;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t r = 1; r < rooms.nodes.size(); ++r) {
        const VoidGraph::Node& node = graph.nodes[std::size_t(rooms.nodes[r])];
        const double distance = (node.place - x).length();
        const double there = node.clearance - perLength * distance;
        if (distance > farthest || there <= most || depth(node.place, node.clearance).value <= 0.0)
            continue;
        most = there;
        best = rooms.nodes[r];
    }
    return best;
}

/// The room that the way up from a node leads to; the node itself if that is the outside.
std::int32_t climbed(const VoidGraph& graph, const Rooms& rooms, std::int32_t n)
{
    if (n == VoidGraph::none || rooms.of[std::size_t(n)] == 0) return n;
    while (rooms.up[std::size_t(n)] != VoidGraph::none) {
        const auto& ends = graph.edges[std::size_t(rooms.up[std::size_t(n)])].nodes;
        n = ends[ends[0] == n ? 1 : 0];
    }
    return n;
}

/// The node where tunnels begin.
/// @param[in] beside  the room beside the atoms, for a place where the small probe does not fit
std::int32_t startOf(const VoidGraph& graph, const Rooms& rooms, const BallSet::PoreWay::End& from,
                     const TunnelOptions& options, const DepthAt& depth, std::int32_t beside)
{
    std::int32_t start = climbed(graph, rooms, graph.starts.front());
    if (start == VoidGraph::none) start = beside;
    if (start == VoidGraph::none)
        throw Error(ErrorKind::Input,
                    formatted("`tunnelsFrom`: expected a place where a ball of %g Å fits, got %s "
                              "[hint: atoms beside it, as resid 57, or a smaller `tunnelProbe`]",
                              options.probe, placeText(from.place).c_str()));
    const VoidGraph::Node& node = graph.nodes[std::size_t(start)];
    if (start == VoidGraph::outside || depth(node.place, node.clearance).value <= 0.0)
        throw Error(ErrorKind::Input,
                    formatted("`tunnelsFrom`: expected a place within the molecule, got %s, which "
                              "a ball of %g Å reaches from outside [hint: a larger `probeOut`]",
                              placeText(from.place).c_str(), options.probeOut));
    return start;
}

/// The directions of a way at its points, of what is within 1 Å.
std::vector<Vec3d> directionsOf(const std::vector<VoidPoint>& points,
                                const std::vector<double>& distances)
{
    constexpr double half = 1.0; // [Å]
    std::vector<Vec3d> out;
    std::size_t a = 0, b = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        while (distances[a] < distances[i] - half) ++a;
        while (b + 1 < points.size() && distances[b] < distances[i] + half) ++b;
        Vec3d way = points[b].place - points[a].place;
        if (!way.normalize(1e-9)) way = out.empty() ? Vec3d(0.0, 0.0, 1.0) : out.back();
        out.push_back(way);
    }
    return out;
}

/// The places of a way, no closer than 0.25 Å but for its narrow ones.
Report::Tunnels::Tunnel tunnelOf(const Clearance& clearance, const VoidWay& way)
{
    constexpr double apart = 0.25; // [Å]
    const std::vector<VoidPoint>& points = way.points;
    std::vector<double> distances = {0.0};
    std::size_t narrowest = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        distances.push_back(distances.back() + (points[i].place - points[i - 1].place).length());
        if ((points[i].place - way.narrowest).length() <
            (points[narrowest].place - way.narrowest).length())
            narrowest = i;
    }
    constexpr double near = 1e-3; // the ball there, exactly: the graph's balls are moved [Å]
    const auto neck = clearance.neckNear(way.narrowest, near, way.clearance + near);
    const std::vector<Vec3d> directions = directionsOf(points, distances);
    Report::Tunnels::Tunnel out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool isEnd = i == 0 || i + 1 == points.size();
        const bool isNarrow =
            i == narrowest || (!isEnd && points[i].clearance < points[i - 1].clearance &&
                               points[i].clearance < points[i + 1].clearance);
        if (!isEnd && !isNarrow && distances[i] < out.stations.back().distance + apart) continue;
        const Vec3d& x = i == narrowest && neck ? neck->place : points[i].place;
        out.stations.push_back(stationOf({x, clearance.at(x)}, directions[i]));
        out.stations.back().distance = distances[i];
    }
    for (const std::size_t i : necksOf(out.stations)) out.stations[i].isBottleneck = true;
    for (Station& station : out.stations) addLining(clearance, station);
    return out;
}

} // namespace

Report::Tunnels findTunnels(const std::vector<Ball>& balls, const BallSet::PoreWay::End& from,
                            const TunnelOptions& options, const Progress& progress)
{
    const Clearance clearance(balls);
    const OuterDepth outer(balls, options.probeOut, OuterDepth::Reach::Passed, progress);
    const DepthAt depth = [&](const Vec3d& x, double room) {
        constexpr double near = 4.0; // a guess at how far below the surface places are [Å]
        return outer.at(x, room >= options.probeOut, options.probeOut + near);
    };
    const VoidGraph graph = voidGraph(balls, options.probe, {from.place}, progress);
    const Rooms rooms = roomsOf(graph);
    const std::int32_t beside = from.isPoint || graph.starts.front() != VoidGraph::none
                                    ? VoidGraph::none
                                    : roomBeside(graph, rooms, from.place, depth);
    const std::int32_t start = startOf(graph, rooms, from, options, depth, beside);
    const std::vector<VoidWay> ways = waysOut(graph, rooms, start, options.probeOut, depth);
    const VoidGraph::Node& node = graph.nodes[std::size_t(start)];
    if (ways.empty())
        throw Error(ErrorKind::Input,
                    formatted("`tunnelsFrom`: expected a way out of %s for a ball of %g Å, found "
                              "none [hint: a smaller `tunnelProbe`]",
                              placeText(node.place).c_str(), options.probe));
    Report::Tunnels out;
    out.probe = options.probe;
    out.probeOut = options.probeOut;
    out.list.resize(ways.size());
    parallelFor(ways.size(), progress,
                [&](std::size_t i) { out.list[i] = tunnelOf(clearance, ways[i]); });
    out.start = out.list.front().stations.front().place;
    out.startRadius = out.list.front().stations.front().radius;
    return out;
}

} // namespace molsurf
