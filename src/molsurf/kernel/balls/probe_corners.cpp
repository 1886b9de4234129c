// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/probe_corners.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The place of a corner relative to the first of its balls, in quadruple precision [Å].
QuadVector exactPlace(const BallBoundary& boundary, const CornerName& name)
{
    const auto ball = [&](int k) -> const PlacedBall& {
        return boundary.balls[std::size_t(name.balls[k])];
    };
    const QuadPlane a = quadPlane(ball(0), ball(1)), b = quadPlane(ball(0), ball(2));
    const QuadVector normal = a.way.cross(b.way);
    const Quad square = normal.dot(normal), radius(ball(0).radius);
    // The foot on the line of both planes, and the way along it to the sphere.
    const QuadVector foot =
        (b.way.cross(normal) * a.height - a.way.cross(normal) * b.height) * (1 / square);
    const Quad rest = radius * radius - foot.dot(foot);
    Quad along = sqrt((rest > 0 ? rest : Quad(0)) / square);
    if (!name.above) along = -along;
    return foot + normal * along;
}

[[noreturn]] void cornersDisagree()
{
    throw Error(ErrorKind::Check, "boundary: an arc ends where there is no corner");
}

} // namespace

ProbeCorners::ProbeCorners(const BallBoundary& boundary, const BoundaryMeasure& measure,
                           const Progress& progress)
    : boundary_(boundary), tree_((findEnds(boundary, measure), boxes()))
{
    findPartners(boundary, measure);
    const auto closeOnes = [&](std::size_t c, std::vector<std::size_t>& out) {
        bool any = false;
        const Vec3d& x = corners_[c].position;
        tree_.forEachNear(Box::about(x, close), [&](std::size_t group) {
            const std::size_t begin = BoxTree::group * group;
            const std::size_t end = std::min(begin + BoxTree::group, corners_.size());
            for (std::size_t o = begin; o < end; ++o)
                any |= o != c && (corners_[o].position - x).lengthSqr() < close * close;
        });
        if (any) out.push_back(c);
    };
    // Corners close to others get their places from quadruple precision.
    for (const std::size_t c : parallelCollect<std::size_t>(corners_.size(), progress, closeOnes)) {
        ProbeCorner& corner = corners_[c];
        const QuadVector place = exactPlace(boundary, corner.name);
        corner.position = boundary.balls[std::size_t(corner.name.balls[0])].centre() +
                          Vec3d(double(place.x), double(place.y), double(place.z));
        exact_.emplace(c, place);
    }
}

void ProbeCorners::findEnds(const BallBoundary& boundary, const BoundaryMeasure& measure)
{
    // An arc with a later ball at an end has put the corner there into the list.
    std::vector<CornerName> names;
    std::vector<std::int32_t> numbers; // of those that are kept
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        const Arc& arc = boundary.arcs[a];
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e) {
            if (arc.ends[e] < arc.balls[1]) continue;
            const bool kept = measure.arcPieces[a] >= 0;
            numbers.push_back(kept ? std::int32_t(corners_.size()) : -1);
            if (kept) {
                const Vec3d& x = boundary.corners[names.size()].position;
                corners_.push_back({cornerAt(arc, e), x, {}, {-1, -1, -1}, {}});
            }
            names.push_back(cornerAt(arc, e));
        }
    }
    std::vector<std::size_t> patchOf(boundary.balls.size(), boundary.patches.size());
    for (std::size_t p = 0; p < boundary.patches.size(); ++p)
        patchOf[std::size_t(boundary.patches[p].ball)] = p;
    atEnds_.assign(2 * boundary.arcs.size(), -1);
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        const Arc& arc = boundary.arcs[a];
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e) {
            const CornerName name = cornerAt(arc, e);
            const std::size_t p = patchOf[std::size_t(name.balls[0])];
            if (p == boundary.patches.size()) cornersDisagree();
            const auto begin = names.begin() + boundary.patches[p].cornersBegin;
            const auto end = names.begin() + boundary.patches[p].cornersEnd;
            const auto found = std::find(begin, end, name);
            if (found == end) cornersDisagree();
            const std::int32_t c = numbers[std::size_t(found - names.begin())];
            atEnds_[2 * a + std::size_t(e)] = c;
            if (c < 0) continue;
            ProbeCorner& corner = corners_[std::size_t(c)];
            const int side = arc.balls[0] != name.balls[0]   ? 1
                             : arc.balls[1] == name.balls[1] ? 0
                                                             : 2;
            if (corner.ends[side] >= 0) cornersDisagree();
            corner.arcs[side] = std::uint32_t(a);
            corner.ends[side] = e;
        }
    }
    for (const ProbeCorner& corner : corners_) {
        if (std::min({corner.ends[0], corner.ends[1], corner.ends[2]}) < 0) cornersDisagree();
    }
}

/// Sets the partners of corners: the last end of each arc of a circle and the next one's first.
void ProbeCorners::findPartners(const BallBoundary& boundary, const BoundaryMeasure& measure)
{
    // The arcs of a circle follow each other, in their order about its axis.
    const std::vector<Arc>& arcs = boundary.arcs;
    std::vector<std::size_t> circle; // its arcs
    const auto finish = [&] {
        for (std::size_t k = 0; k < circle.size(); ++k) {
            const std::int32_t before = at(circle[k], 1);
            const std::int32_t after = at(circle[(k + 1) % circle.size()], 0);
            if (before < 0) continue;
            const auto set = [&](std::int32_t corner, std::size_t arc, std::int32_t partner) {
                ProbeCorner& c = corners_[std::size_t(corner)];
                for (int side = 0; side < 3; ++side)
                    if (c.arcs[side] == arc) c.partners[side] = partner;
            };
            set(before, circle[k], after);
            set(after, circle[(k + 1) % circle.size()], before);
        }
        circle.clear();
    };
    for (std::size_t a = 0; a < arcs.size(); ++a) {
        if (!circle.empty() && (arcs[a].balls[0] != arcs[circle[0]].balls[0] ||
                                arcs[a].balls[1] != arcs[circle[0]].balls[1]))
            finish();
        if (measure.arcPieces[a] >= 0) circle.push_back(a);
    }
    finish();
}

std::vector<Box> ProbeCorners::boxes() const
{
    std::vector<Box> out;
    out.reserve(corners_.size());
    for (const ProbeCorner& corner : corners_) out.push_back(Box::about(corner.position, 0.0));
    return out;
}

Vec3d ProbeCorners::exactWay(std::size_t from, std::size_t to) const
{
    const auto a = exact_.find(from), b = exact_.find(to);
    if (a == exact_.end() || b == exact_.end())
        return corners_[to].position - corners_[from].position;
    const PlacedBall& first = boundary_.balls[std::size_t(corners_[from].name.balls[0])];
    const PlacedBall& second = boundary_.balls[std::size_t(corners_[to].name.balls[0])];
    const auto between = [&](std::size_t axis, const Quad& x, const Quad& y) {
        return double(Quad(second.place[axis] - first.place[axis]) * Quad(placeUnit) + y - x);
    };
    return Vec3d(between(0, a->second.x, b->second.x), between(1, a->second.y, b->second.y),
                 between(2, a->second.z, b->second.z));
}

} // namespace molsurf
