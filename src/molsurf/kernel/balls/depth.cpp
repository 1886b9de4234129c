// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/depth.h"

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"

#include <algorithm>

namespace molsurf
{

namespace
{

/// For each piece one ball that has a part of it, as a patch, and a box about all of them.
struct PiecePlaces {
    std::vector<std::uint32_t> patches;
    std::vector<openvdb::BBoxd> boxes;

    PiecePlaces(const BallBoundary& boundary, const BoundaryMeasure& measure)
        : patches(measure.pieces.size(), 0), boxes(measure.pieces.size())
    {
        for (const BoundaryFace& face : measure.faces) {
            if (face.piece < 0) continue;
            const Patch& patch = boundary.patches[face.patch];
            patches[std::size_t(face.piece)] = face.patch;
            openvdb::BBoxd& box = boxes[std::size_t(face.piece)];
            box.expand(patch.centre - openvdb::Vec3d(patch.radius));
            box.expand(patch.centre + openvdb::Vec3d(patch.radius));
        }
    }
};

/// The cavity that each outer piece lies in, or -1. That is so if the way from a ball of it to the
/// nearest point of the cavity's wall arrives from the void: then the point is on a patch, which
/// bulges into the void. From the other side, out of the solid, it is on an edge.
std::vector<std::int32_t> enclosingCavities(const BallBoundary& boundary,
                                            const BoundaryMeasure& measure)
{
    const std::vector<BoundaryPiece>& pieces = measure.pieces;
    std::vector<std::int32_t> out(pieces.size(), -1);
    const auto isOuter = [](const BoundaryPiece& piece) { return piece.outer; };
    if (std::count_if(pieces.begin(), pieces.end(), isOuter) < 2) return out;
    const PiecePlaces places(boundary, measure);
    for (std::size_t cavity = 0; cavity < pieces.size(); ++cavity) {
        if (pieces[cavity].outer) continue;
        std::unique_ptr<const BoundaryPoints> wall;
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const Patch& patch = boundary.patches[places.patches[p]];
            if (!pieces[p].outer || pieces[p].component == pieces[cavity].component ||
                pieces[p].volume >= -pieces[cavity].volume ||
                !places.boxes[cavity].isInside(patch.centre))
                continue;
            if (!wall) {
                std::vector<char> kept(pieces.size(), 0);
                kept[cavity] = 1;
                wall = std::make_unique<const BoundaryPoints>(boundary, measure, kept);
            }
            if (wall->nearest(patch.centre, patch.radius).part == BoundaryPart::Patch)
                out[p] = std::int32_t(cavity);
        }
    }
    return out;
}

/// Whether the centre of a probe gets to each piece from outside.
std::vector<char> passedFromOutside(const BallBoundary& boundary, const BoundaryMeasure& measure)
{
    const std::vector<std::int32_t> cavityOf = enclosingCavities(boundary, measure);
    std::vector<char> out;
    for (std::size_t p = 0; p < measure.pieces.size(); ++p)
        out.push_back(measure.pieces[p].outer && cavityOf[p] < 0);
    return out;
}

/// Whether probes reach each piece from outside: a cavity's probes that overlap those of a piece
/// outside wash one void with them. Nearest places of two pieces are corners, since patches and
/// arcs bulge into voids.
std::vector<char> reachedFromOutside(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                     double probe)
{
    const std::vector<std::int32_t> pieceOf = cornerPieces(boundary, measure);
    const std::vector<std::int32_t> cavityOf = enclosingCavities(boundary, measure);
    const auto isOutside = [&](std::size_t piece) {
        return measure.pieces[piece].outer && cavityOf[piece] < 0;
    };
    std::vector<Ball> places(pieceOf.size()); // corners; Ball::atom is their piece
    for (std::size_t c = 0; c < places.size(); ++c)
        places[c] = {boundary.corners[c].position, 0.0, pieceOf[c]};
    const BallIndex index(places, {0.0, 0.0, 2.0});
    DisjointSets sets(measure.pieces.size());
    for (std::size_t p = 0; p < cavityOf.size(); ++p)
        if (cavityOf[p] >= 0) sets.join(std::uint32_t(p), std::uint32_t(cavityOf[p]));
    for (const Ball& place : places) {
        if (place.atom < 0 || isOutside(std::size_t(place.atom))) continue;
        index.forEachNear(place.center, place.center, 2.0 * probe, [&](const Ball& o, auto) {
            if (o.atom >= 0 && (o.center - place.center).length() < 2.0 * probe)
                sets.join(std::uint32_t(place.atom), std::uint32_t(o.atom));
        });
    }
    std::vector<char> roots(measure.pieces.size(), 0), out;
    for (std::uint32_t p = 0; p < roots.size(); ++p)
        if (isOutside(p)) roots[sets.find(p)] = 1;
    for (std::uint32_t p = 0; p < roots.size(); ++p) out.push_back(roots[sets.find(p)]);
    return out;
}

/// The radius of the largest ball that a box about the corners of a piece may hold: patches and
/// arcs bulge into voids, so that these lie among their corners.
double largestVoid(const BallBoundary& boundary, const BoundaryMeasure& measure,
                   const std::vector<char>& closed)
{
    std::vector<openvdb::BBoxd> boxes(closed.size());
    const std::vector<std::int32_t> pieceOf = cornerPieces(boundary, measure);
    for (std::size_t c = 0; c < pieceOf.size(); ++c)
        if (pieceOf[c] >= 0) boxes[std::size_t(pieceOf[c])].expand(boundary.corners[c].position);
    double most = 0.0;
    for (std::size_t p = 0; p < closed.size(); ++p) {
        if (!closed[p] || !boxes[p]) continue;
        const openvdb::Vec3d size = boxes[p].extents();
        most = std::max(most, 0.5 * std::min({size[0], size[1], size[2]}));
    }
    return most;
}

} // namespace

OuterDepth::OuterDepth(const std::vector<Ball>& balls, double probe, Reach reach,
                       const Progress& progress)
    : boundary_(ballBoundary(balls, probe, progress)),
      measure_(measureBoundary(boundary_, progress)), probe_(probe)
{
    std::vector<char> kept = reach == Reach::Washed ? reachedFromOutside(boundary_, measure_, probe)
                                                    : passedFromOutside(boundary_, measure_);
    open_ = std::make_unique<BoundaryPoints>(boundary_, measure_, kept);
    if (std::all_of(kept.begin(), kept.end(), [](char k) { return k != 0; })) return;
    for (char& k : kept) k = k ? 0 : 1;
    closed_ = std::make_unique<BoundaryPoints>(boundary_, measure_, kept);
    voidRadius_ = largestVoid(boundary_, measure_, kept);
}

OuterDepth::Depth OuterDepth::at(const openvdb::Vec3d& x, bool hasRoom, double guess) const
{
    const auto [part, index, centre, distance] = open_->nearest(x, guess);
    const bool outside = hasRoom && !(closed_ && closed_->nearest(x, guess).distance < distance);
    return {(outside ? -distance : distance) - probe_, centre};
}

bool OuterDepth::isOutside(const openvdb::Vec3d& x, double guess) const
{
    return !closed_ || open_->nearest(x, guess).distance <= closed_->nearest(x, guess).distance;
}

std::vector<double> depthsOf(const std::vector<Ball>& balls, double probe,
                             const std::vector<openvdb::Vec3d>& points, const Progress& progress)
{
    constexpr double typical = 2.0; // depth of an atom at the surface [Å]
    const OuterDepth depth(balls, probe, OuterDepth::Reach::Washed, progress);
    std::vector<double> out(points.size());
    parallelFor(points.size(), progress, [&](std::size_t i) {
        out[i] = std::max(depth.at(points[i], false, probe + typical).value, 0.0);
    });
    return out;
}

} // namespace molsurf
