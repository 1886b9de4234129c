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
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Station = Report::Pore::Station;

/// The room of a site, whose atoms may fill their middle x: of the rooms from which the small probe
/// gets out, and which the large one does not reach, that with the largest R^2 / (|x - c|^2 + P^2),
/// the share of the view that its ball has from a place beside x by the radius P of the large
/// probe. c is the centre of the ball and R its radius, at most P. If the small probe gets out of
/// none, it is the same of all; none: there is no room.
///
/// measured with the tests of PLIP, as bench/tunnel_starts.py does it: of 375 sites each of one,
/// two and three residues 67, 81 and 84 % begin at the ligand, by the steepest way up from x 21, 47
/// and 61 %, in the widest room within 12 Å less 0.2 Å for each Å 65, 77 and 81 %.
std::int32_t roomBeside(const VoidGraph& graph, const Rooms& rooms, const Vec3d& x, double most,
                        const DepthAt& depth)
{
    const std::vector<char> leadsOut = leadingOut(graph);
    struct Candidate {
        bool leadsOut;
        double view;
        std::int32_t node;
    };
    std::vector<Candidate> all;
    for (std::size_t r = 1; r < rooms.nodes.size(); ++r) {
        const std::int32_t n = rooms.nodes[r];
        const VoidGraph::Node& node = graph.nodes[std::size_t(n)];
        const double radius = std::min(node.clearance, most);
        all.push_back({leadsOut[std::size_t(n)] != 0,
                       radius * radius / ((node.place - x).lengthSqr() + most * most), n});
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
        return std::pair(a.leadsOut, a.view) > std::pair(b.leadsOut, b.view);
    });
    for (const Candidate& one : all) {
        const VoidGraph::Node& node = graph.nodes[std::size_t(one.node)];
        if (depth(node.place, node.clearance).value > 0.0) return one.node;
    }
    return VoidGraph::none;
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
/// @param[in] clearance  at the place [Å]
std::int32_t startOf(const VoidGraph& graph, const Rooms& rooms, const SearchPlaces::End& from,
                     double clearance, const TunnelOptions& options, const DepthAt& depth)
{
    const std::int32_t start = from.isPoint
                                   ? climbed(graph, rooms, graph.starts.front())
                                   : roomBeside(graph, rooms, from.place, options.probeOut, depth);
    // of a point the room counts, as it may be wider than the large probe
    VoidPoint inside{from.place, clearance};
    if (from.isPoint && start > VoidGraph::outside)
        inside = {graph.nodes[std::size_t(start)].place, graph.nodes[std::size_t(start)].clearance};
    const bool fits = !from.isPoint || start != VoidGraph::none;
    if (fits && (start == VoidGraph::outside || depth(inside.place, inside.clearance).value <= 0.0))
        throw Error(ErrorKind::Input,
                    formatted("`tunnelsFrom`: expected a place within the molecule, got %s, which "
                              "a ball of %g Å reaches from outside [hint: a larger `probeOut`]",
                              placeText(from.place).c_str(), options.probeOut));
    if (start == VoidGraph::none)
        throw Error(ErrorKind::Input,
                    formatted("`tunnelsFrom`: expected a place where a ball of %g Å fits, got %s "
                              "[hint: atoms beside it, as resid 57, or a smaller `tunnelProbe`]",
                              options.probe, placeText(from.place).c_str()));
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

Report::Tunnels findTunnels(const std::vector<Ball>& balls, const SearchPlaces::End& from,
                            const TunnelOptions& options, const Progress& progress)
{
    const Clearance clearance(balls);
    const OuterDepth outer(balls, options.probeOut, OuterDepth::Reach::Passed, progress);
    // How deep a place lies below what the large probe reaches. A poor guess costs time alone.
    const DepthAt depth = [&](const Vec3d& x, double room) {
        constexpr double near = 4.0; // [Å]
        return outer.at(x, room >= options.probeOut, options.probeOut + near);
    };
    const std::vector<Vec3d> points(from.isPoint ? 1 : 0, from.place);
    const VoidGraph graph = voidGraph(balls, options.probe, points, progress);
    const Rooms rooms = roomsOf(graph);
    const std::int32_t start =
        startOf(graph, rooms, from, clearance.at(from.place), options, depth);
    const std::vector<VoidWay> ways = // the widest first
        waysOut(graph, rooms, start, options.probeOut, depth);
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
    for (std::size_t i = 0; i < out.list.size(); ++i) out.list[i].number = i + 1;
    out.start = out.list.front().stations.front().place;
    out.startRadius = out.list.front().stations.front().radius;
    return out;
}

} // namespace molsurf
