// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/boundary_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

std::vector<Box> boxesOf(const std::vector<Patch>& patches)
{
    std::vector<Box> boxes;
    boxes.reserve(patches.size());
    for (const Patch& patch : patches) boxes.push_back(Box::about(patch.centre, patch.radius));
    return boxes;
}

std::vector<Box> boxesOf(const std::vector<Arc>& arcs)
{
    std::vector<Box> boxes;
    boxes.reserve(arcs.size());
    for (const Arc& arc : arcs) {
        // An arc of less than half a circle lies in the ball over its chord.
        const bool whole = arc.half >= 0.5 * M_PI;
        const Vec3d aside = whole ? Vec3d(0.0) : arc.radius * std::cos(arc.half) * arc.middle;
        boxes.push_back(
            Box::about(arc.centre + aside, whole ? arc.radius : arc.radius * std::sin(arc.half)));
    }
    return boxes;
}

std::vector<Box> boxesOf(const std::vector<Corner>& corners)
{
    std::vector<Box> boxes;
    boxes.reserve(corners.size());
    for (const Corner& corner : corners) boxes.push_back(Box::about(corner.position, 0.0));
    return boxes;
}

/// Calls f(i) for the things of a tree whose boxes may meet that about x.
template<typename F>
void forEachNear(const BoxTree& tree, std::size_t size, const Vec3d& x, double reach, const F& f)
{
    tree.forEachNear(Box::about(x, reach), [&](std::size_t group) {
        const std::size_t first = BoxTree::group * group;
        for (std::size_t i = first; i < std::min(size, first + BoxTree::group); ++i) f(i);
    });
}

} // namespace

BoundaryPoints::BoundaryPoints(const BallBoundary& boundary)
    : boundary_(boundary), patches_(boxesOf(boundary.patches)), arcs_(boxesOf(boundary.arcs)),
      corners_(boxesOf(boundary.corners))
{
    cosines_.reserve(boundary.arcs.size());
    for (const Arc& arc : boundary.arcs)
        cosines_.push_back(arc.ends[0] < 0 ? -2.0 : std::cos(arc.half));
}

void BoundaryPoints::search(const Vec3d& x, BoundaryPoint& best) const
{
    const auto offer = [&](BoundaryPart part, std::size_t i, const Vec3d& point) {
        const double distance = (point - x).length();
        if (distance < best.distance) best = {part, std::uint32_t(i), point, distance};
    };
    forEachNear(corners_, boundary_.corners.size(), x, best.distance, [&](std::size_t i) {
        offer(BoundaryPart::Corner, i, boundary_.corners[i].position);
    });
    forEachNear(arcs_, boundary_.arcs.size(), x, best.distance, [&](std::size_t i) {
        const Arc& arc = boundary_.arcs[i];
        const Vec3d offset = x - arc.centre;
        Vec3d across = offset - offset.dot(arc.axis) * arc.axis;
        const double length = across.length();
        // A point on the axis is equally far from the whole circle.
        across = length > 0.0 ? across / length : arc.middle;
        if (across.dot(arc.middle) < cosines_[i]) return;
        offer(BoundaryPart::Arc, i, arc.centre + arc.radius * across);
    });
    forEachNear(patches_, boundary_.patches.size(), x, best.distance, [&](std::size_t i) {
        const Patch& patch = boundary_.patches[i];
        const Vec3d offset = x - patch.centre;
        const double length = offset.length();
        if (length == 0.0 || std::abs(length - patch.radius) >= best.distance) return;
        const Vec3d direction = offset / length;
        if (isCovered(boundary_, patch, direction)) return;
        offer(BoundaryPart::Patch, i, patch.centre + patch.radius * direction);
    });
}

BoundaryPoint BoundaryPoints::nearest(const Vec3d& x, double guess) const
{
    for (double reach = guess;; reach *= 2.0) {
        BoundaryPoint best{BoundaryPart::Patch, 0, x, reach};
        search(x, best);
        if (best.distance < reach) return best;
        if (reach > std::numeric_limits<float>::max()) return best; // there are no patches
    }
}

} // namespace molsurf
