// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_point.h"

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

/// The direction from an arc's centre to the point of its circle that is nearest to x.
Vec3d onCircle(const Arc& arc, const Vec3d& x)
{
    const Vec3d offset = x - arc.centre;
    const Vec3d across = offset - offset.dot(arc.axis) * arc.axis;
    const double length = across.length();
    // A point on the axis is equally far from the whole circle.
    return length > 0.0 ? across / length : arc.middle;
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

BoundaryPoints::BoundaryPoints(const BallBoundary& boundary, const BoundaryMeasure& measure,
                               const std::vector<char>& keptPieces)
    : BoundaryPoints(boundary)
{
    const auto isIn = [&](std::int32_t piece) {
        return piece >= 0 && keptPieces[std::size_t(piece)];
    };
    for (const std::int32_t piece : measure.arcPieces) arcKept_.push_back(isIn(piece));
    for (const std::int32_t piece : cornerPieces(boundary, measure))
        cornerKept_.push_back(isIn(piece));
    std::vector<int> kept(boundary.patches.size(), 0), left(kept);
    for (const BoundaryFace& face : measure.faces) ++(isIn(face.piece) ? kept : left)[face.patch];
    std::vector<std::size_t> patchOf(boundary.balls.size(), 0);
    for (std::size_t p = 0; p < boundary.patches.size(); ++p) {
        patchKept_.push_back(kept[p] > 0);
        patchOf[std::size_t(boundary.patches[p].ball)] = p;
    }
    for (std::size_t a = 0; a < boundary.arcs.size(); ++a) {
        for (const std::size_t side : {0, 1}) {
            const std::size_t p = patchOf[std::size_t(boundary.arcs[a].balls[side])];
            const std::uint32_t face = measure.arcFaces[a][side];
            if (kept[p] > 0 && left[p] > 0)
                mixed_[p].push_back({std::uint32_t(a), isIn(measure.faces[face].piece)});
        }
    }
}

/// Whether a point of a patch is on a face that is not left out: that of the patch's nearest arc.
bool BoundaryPoints::isKept(std::size_t patch, const Vec3d& point) const
{
    const auto sides = mixed_.find(patch);
    if (sides == mixed_.end()) return true;
    double least = std::numeric_limits<double>::infinity();
    bool kept = true;
    for (const Side& side : sides->second) {
        const Arc& arc = boundary_.arcs[side.arc];
        Vec3d across = onCircle(arc, point);
        if (across.dot(arc.middle) < cosines_[side.arc])
            across = arc.end(arc.axis.cross(arc.middle).dot(across) > 0.0 ? 1 : 0);
        const double square = (arc.centre + arc.radius * across - point).lengthSqr();
        if (square >= least) continue;
        least = square;
        kept = side.kept;
    }
    return kept;
}

void BoundaryPoints::search(const Vec3d& x, BoundaryPoint& best) const
{
    const auto offer = [&](BoundaryPart part, std::size_t i, const Vec3d& point) {
        const double square = (point - x).lengthSqr();
        if (square >= best.distance * best.distance) return;
        const double distance = std::sqrt(square);
        if (distance < best.distance) best = {part, std::uint32_t(i), point, distance};
    };
    const auto isLeftOut = [](const std::vector<char>& kept, std::size_t i) {
        return !kept.empty() && !kept[i];
    };
    forEachNear(corners_, boundary_.corners.size(), x, best.distance, [&](std::size_t i) {
        if (isLeftOut(cornerKept_, i)) return;
        offer(BoundaryPart::Corner, i, boundary_.corners[i].position);
    });
    forEachNear(arcs_, boundary_.arcs.size(), x, best.distance, [&](std::size_t i) {
        if (isLeftOut(arcKept_, i)) return;
        const Arc& arc = boundary_.arcs[i];
        const double farthest = best.distance + arc.radius;
        if ((x - arc.centre).lengthSqr() > farthest * farthest) return;
        const Vec3d across = onCircle(arc, x);
        if (across.dot(arc.middle) < cosines_[i]) return;
        offer(BoundaryPart::Arc, i, arc.centre + arc.radius * across);
    });
    forEachNear(patches_, boundary_.patches.size(), x, best.distance, [&](std::size_t i) {
        const Patch& patch = boundary_.patches[i];
        const Vec3d offset = x - patch.centre;
        const double farthest = best.distance + patch.radius;
        if (offset.lengthSqr() >= farthest * farthest) return;
        const double length = offset.length();
        if (isLeftOut(patchKept_, i) || std::abs(length - patch.radius) >= best.distance) return;
        // Of a whole sphere all points are equally far from its centre; else the arcs are as near.
        if (length == 0.0 && patch.capsBegin < patch.capsEnd) return;
        const Vec3d direction = length > 0.0 ? offset / length : Vec3d(1.0, 0.0, 0.0);
        const Vec3d point = patch.centre + patch.radius * direction;
        if (isCovered(boundary_, patch, direction) || !isKept(i, point)) return;
        offer(BoundaryPart::Patch, i, point);
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
