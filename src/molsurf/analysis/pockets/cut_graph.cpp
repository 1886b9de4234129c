// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/cut_graph.h"

#include "molsurf/kernel/core/bracketed_root.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// Whether a place is below the cut: by the nearest voxel if the cut is farther away than that.
bool isPlaceBelow(const Vec3d& place, double room, const VoidField& space, const BelowCut& below)
{
    const auto voxel = space.find(openvdb::Coord::round(place / space.voxelSize));
    if (!voxel) return false;
    const float there = space.below.leaf(*voxel / leafSize)[*voxel % leafSize];
    if (std::abs(there) > space.voxelSize) return there > 0.0f; // it changes by 1 Å per Å
    return below(place, room).value > 0.0;
}

/// Where a line from a place below the cut to one above it crosses it.
VoidPoint crossingOf(const VoidPoint& in, double inValue, const VoidPoint& out, double outValue,
                     const BelowCut& below)
{
    constexpr ZeroAccuracy accuracy{8, 0.0, 1e-4}; // [Å]
    const auto at = [&](double t) {
        return VoidPoint{in.place + (out.place - in.place) * t,
                         in.clearance + (out.clearance - in.clearance) * t};
    };
    return at(zeroBetween(-inValue, -outValue, accuracy,
                          [&](double t) { return -below(at(t).place, at(t).clearance).value; }));
}

/// Finds where a way along an edge from a place below the cut comes to it.
/// @param[in] points  of the edge, the first below the cut
void followToCut(const std::vector<VoidPoint>& points, const BelowCut& below, CutGraph::Exit& out)
{
    out.least = std::numeric_limits<double>::infinity();
    const auto note = [&](const VoidPoint& p) {
        out.end = p;
        if (p.clearance >= out.least) return;
        out.least = p.clearance;
        out.narrowest = p.place;
    };
    const auto valueAt = [&](const VoidPoint& p) { return below(p.place, p.clearance).value; };
    Vec3d from = points.front().place;
    double left = std::max(valueAt(points.front()), 0.0);
    note(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
        if ((points[i].place - from).length() >= left) { // nearer ones are below the cut
            const double value = valueAt(points[i]);
            if (value <= 0.0) {
                const double before = valueAt(points[i - 1]);
                if (before > 0.0) note(crossingOf(points[i - 1], before, points[i], value, below));
                break;
            }
            from = points[i].place;
            left = value;
        }
        note(points[i]);
    }
}

/// Two edges with two balls in common bound a face, and the cut goes through that from one to the
/// other.
std::vector<CutGraph::Arc> arcsOf(const std::vector<CutGraph::Exit>& exits)
{
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> faces;
    for (std::size_t i = 0; i < exits.size(); ++i)
        for (const auto& [j, k] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
            const std::int32_t a = exits[i].balls[std::size_t(j)],
                               b = exits[i].balls[std::size_t(k)];
            if (b != VoidGraph::none) faces[{a, b}].push_back(std::int32_t(i));
        }
    std::vector<CutGraph::Arc> out;
    for (const auto& [balls, own] : faces)
        for (std::size_t i = 0; i < own.size(); ++i)
            for (std::size_t j = i + 1; j < own.size(); ++j)
                out.push_back({{own[i], own[j]}, {balls.first, balls.second}});
    return out;
}

/// Moves a place to where two balls are equally near, and onto the cut: Newton's method with the
/// shortest steps.
/// @return whether it came there
bool moveOnto(const Ball& a, const Ball& b, const Clearance& clearance, const BelowCut& below,
              Vec3d& x)
{
    constexpr int steps = 8;
    constexpr double there = 1e-4; // [Å]
    for (int k = 0; k < steps; ++k) {
        const OuterDepth::Depth depth = below(x, clearance.at(x));
        const Vec3d toA = x - a.center, toB = x - b.center;
        const double lengthA = toA.length(), lengthB = toB.length();
        const double off = lengthA - a.radius - (lengthB - b.radius);
        if (std::abs(off) < there && std::abs(depth.value) < there) return true;
        const Vec3d g = toA / std::max(lengthA, 1e-9) - toB / std::max(lengthB, 1e-9);
        Vec3d n = x - depth.centre;
        if (!n.normalize(1e-9)) return false;
        // x + s g + t n with (s g + t n) . g = -off and (s g + t n) . n = -depth.
        const double gg = g.lengthSqr(), gn = g.dot(n), det = gg - gn * gn;
        if (!(det > 1e-6)) return false;
        const double s = (-off + depth.value * gn) / det, t = (-depth.value * gg + off * gn) / det;
        x += g * s + n * t;
    }
    return false;
}

} // namespace

CutGraph cutGraph(const VoidGraph& graph, const VoidField& space, const BelowCut& below,
                  const Progress& progress)
{
    constexpr double step = 0.3, whole = 1e9; // [Å]
    constexpr std::size_t chunk = 256;
    CutGraph out;
    out.isBelow.assign(graph.nodes.size(), 0);
    parallelFor((graph.nodes.size() + chunk - 1) / chunk, progress, [&](std::size_t c) {
        for (std::size_t n = std::max<std::size_t>(c * chunk, 1);
             n < std::min(graph.nodes.size(), (c + 1) * chunk); ++n)
            out.isBelow[n] =
                isPlaceBelow(graph.nodes[n].place, graph.nodes[n].clearance, space, below);
    });
    const auto add = [&](std::int32_t node, std::int32_t above, const VoidGraph::Edge& edge,
                         const std::vector<VoidPoint>& points) {
        if (points.empty()) return;
        out.exits.push_back({node, above, 0.0, Vec3d(0.0), {Vec3d(0.0), 0.0}, edge.balls});
        followToCut(points, below, out.exits.back());
    };
    for (const VoidGraph::Edge& edge : graph.edges) {
        const bool a = out.isBelow[std::size_t(edge.nodes[0])] != 0,
                   b = out.isBelow[std::size_t(edge.nodes[1])] != 0;
        if (a == b) continue;
        const std::int32_t node = edge.nodes[a ? 0 : 1];
        add(node, edge.nodes[a ? 1 : 0], edge, graph.pointsFrom(edge, node, step));
    }
    for (const VoidGraph::Edge& edge : graph.stubs) {
        if (out.isBelow[std::size_t(edge.nodes[0])]) continue;
        const std::vector<VoidPoint> ends = graph.pointsOf(edge, whole);
        if (ends.empty() || !isPlaceBelow(ends.back().place, ends.back().clearance, space, below))
            continue;
        std::vector<VoidPoint> points = graph.pointsOf(edge, step);
        std::reverse(points.begin(), points.end());
        add(VoidGraph::none, edge.nodes[0], edge, points);
    }
    out.arcs = arcsOf(out.exits);
    return out;
}

double widthOf(const CutGraph::Arc& arc, const CutGraph& cut, const VoidGraph& graph,
               const Clearance& clearance, const BelowCut& below)
{
    constexpr int pieces = 6;
    const Ball &a = graph.balls[std::size_t(arc.balls[0])],
               &b = graph.balls[std::size_t(arc.balls[1])];
    const VoidPoint &from = cut.exits[std::size_t(arc.exits[0])].end,
                    &to = cut.exits[std::size_t(arc.exits[1])].end;
    const auto at = [&](double t) {
        Vec3d x = from.place + (to.place - from.place) * t;
        return moveOnto(a, b, clearance, below, x) ? clearance.at(x) : -1.0;
    };
    std::array<double, pieces + 1> widths;
    widths.front() = from.clearance;
    widths.back() = to.clearance;
    for (std::size_t k = 1; k < pieces; ++k) {
        widths[k] = at(double(k) / pieces);
        if (widths[k] < graph.floor) return widths[k];
    }
    const auto least = std::min_element(widths.begin(), widths.end());
    if (least == widths.begin() || least + 1 == widths.end()) return *least;
    // The lowest place of the parabola through three.
    const double bend = *(least - 1) - 2.0 * *least + *(least + 1);
    if (!(bend > 0.0)) return *least;
    const double off = 0.5 * (*(least - 1) - *(least + 1)) / bend;
    return std::min(*least, at((double(least - widths.begin()) + off) / pieces));
}

} // namespace molsurf
