// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/swept_cavities.h"

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/kernel/balls/excluded_measure.h"
#include "molsurf/kernel/core/disjoint_sets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// Balls in parts: those whose grown balls hang together, of parts that line the cavities.
/// @param[in] near  Ball::atom is the ball that the lining names
std::vector<std::vector<Ball>> partsAbout(const std::vector<Ball>& near, double probe,
                                          const std::set<std::size_t>& lining)
{
    const BallIndex index(near, {1.0, probe, 1.0});
    DisjointSets sets(near.size());
    for (std::uint32_t i = 0; i < near.size(); ++i) {
        const Ball& ball = near[i];
        const double touch = ball.radius + 2.0 * probe;
        index.forEachNear(ball.center, ball.center, touch, [&](const Ball& o, std::int32_t k) {
            if ((o.center - ball.center).length() < o.radius + touch)
                sets.join(i, std::uint32_t(k));
        });
    }
    std::map<std::uint32_t, std::vector<Ball>> parts;
    for (std::uint32_t i = 0; i < near.size(); ++i)
        if (lining.count(std::size_t(near[i].atom))) parts[sets.find(i)];
    for (std::uint32_t i = 0; i < near.size(); ++i) {
        const auto part = parts.find(sets.find(i));
        if (part != parts.end()) part->second.push_back(near[i]);
    }
    std::vector<std::vector<Ball>> out;
    for (auto& [root, balls] : parts) out.push_back(std::move(balls));
    return out;
}

/// The boundary of a part, and the cavities that are asked for.
class Part
{
public:
    Part(const std::vector<Ball>& balls, double probe, const Progress& progress)
        : probe_(probe), boundary_(ballBoundary(balls, probe, progress)),
          measure_(measureBoundary(boundary_, progress)), isAsked_(measure_.pieces.size(), 0)
    {
    }

    /// The cavity whose wall is nearest to a place, and how near it is.
    std::pair<double, std::size_t> nearestCavity(const Vec3d& place) const
    {
        std::pair<double, std::size_t> best(std::numeric_limits<double>::infinity(), 0);
        for (std::size_t p = 0; p < measure_.pieces.size(); ++p) {
            if (measure_.pieces[p].outer) continue;
            std::vector<char> isKept(measure_.pieces.size(), 0);
            isKept[p] = 1;
            const BoundaryPoints wall(boundary_, measure_, isKept);
            best = std::min(best, {wall.nearest(place, probe_).distance, p});
        }
        return best;
    }

    void ask(std::size_t cavity) { isAsked_[cavity] = 1; }

    /// The surface of the cavities that are asked for; that outside, if none is: a body in one.
    ExcludedMeasure excluded(const Progress& progress) const
    {
        const bool isBody = std::count(isAsked_.begin(), isAsked_.end(), 1) == 0;
        const auto isKept = [&](std::int32_t piece) {
            const auto p = std::size_t(piece);
            return isBody ? measure_.pieces[p].outer : isAsked_[p] != 0;
        };
        BoundaryMeasure kept = measure_;
        for (BoundaryFace& face : kept.faces)
            if (face.piece >= 0 && !isKept(face.piece)) face.piece = -1;
        for (std::int32_t& piece : kept.arcPieces)
            if (piece >= 0 && !isKept(piece)) piece = -1;
        return measureExcluded(boundary_, kept, probe_, false, progress);
    }

private:
    double probe_;
    BallBoundary boundary_;
    BoundaryMeasure measure_;
    std::vector<char> isAsked_; // of the pieces
};

} // namespace

SweptCavities::SweptCavities(const std::vector<Ball>& balls, double probe)
    : probe_(probe), index_(balls, {1.0, probe, 1.0})
{
}

std::optional<SweptCavities::Measure> SweptCavities::measure(const Query& query,
                                                             const Progress& progress) const
{
    std::vector<Ball> near; // Ball::atom is the ball
    index_.forEachNear(query.box.min(), query.box.max(), 2.5 * probe_,
                       [&](const Ball& ball, std::int32_t i) {
                           near.push_back({ball.center, ball.radius, i});
                       });
    std::vector<Part> parts;
    for (const std::vector<Ball>& part : partsAbout(near, probe_, query.lining))
        parts.emplace_back(part, probe_, progress);
    for (const Vec3d& place : query.places) {
        Part* about = nullptr;
        std::pair<double, std::size_t> nearest(std::numeric_limits<double>::infinity(), 0);
        for (Part& part : parts) {
            const auto cavity = part.nearestCavity(place);
            if (cavity.first >= nearest.first) continue;
            nearest = cavity;
            about = &part;
        }
        if (!about) return {};
        about->ask(nearest.second);
    }
    Measure out{0.0, 0.0};
    for (const Part& part : parts)
        for (const BoundaryPiece& piece : part.excluded(progress).pieces) {
            out.volume -= piece.volume;
            out.area += piece.area;
        }
    return out;
}

} // namespace molsurf
