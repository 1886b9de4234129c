// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/ball_boundary.h"

#include "molsurf/balls/ball_caps.h"
#include "molsurf/balls/boundary_check.h"
#include "molsurf/balls/circle_cover.h"
#include "molsurf/balls/quad.h"
#include "molsurf/core/disjoint_sets.h"
#include "molsurf/core/parallel.h"
#include "molsurf/error.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The arcs and corners of a ball with later balls, the number of its caps and its cell.
struct BallParts {
    std::vector<Arc> arcs;
    std::vector<Corner> corners;
    std::uint32_t caps = 0;
    CellVolume cell{};
};

/// Room for one ball, kept from ball to ball by a thread.
struct Scratch {
    CapFinder::Scratch finder;
    CapArrays caps;
    CircleScratch circle;
    std::vector<Gap> gaps;
};

/// Adds a gap of a circle as an arc, with the corners at its ends that no other circle adds.
void addArc(const PlacedBall& ball, std::int32_t i, const Cap& cap, const Circle& circle,
            const Gap& gap, const CapArrays& caps, BallParts& parts)
{
    const Vec3d centre = ball.centre() + ball.radius * circle.cosine * circle.axis;
    const double radius = ball.radius * circle.sine;
    if (gap.before < 0) {
        parts.arcs.push_back(
            {centre, radius, circle.axis, circle.e1, M_PI, {i, cap.other}, {-1, -1}});
        return;
    }
    const auto at = [&](double x, double y) { return x * circle.e1 + y * circle.e2; };
    double angle = std::atan2(gap.beginX * gap.endY - gap.beginY * gap.endX,
                              gap.beginX * gap.endX + gap.beginY * gap.endY);
    if (angle <= 0.0) angle += 2.0 * M_PI;
    const double half = 0.5 * angle, c = std::cos(half), s = std::sin(half);
    const std::int32_t before = caps.other[std::size_t(gap.before)];
    const std::int32_t after = caps.other[std::size_t(gap.after)];
    parts.arcs.push_back({centre,
                          radius,
                          circle.axis,
                          at(gap.beginX * c - gap.beginY * s, gap.beginY * c + gap.beginX * s),
                          half,
                          {i, cap.other},
                          {before, after}});
    // Each corner lies on three circles: the one of the two first balls keeps it.
    if (before > cap.other)
        parts.corners.push_back(
            {centre + radius * at(gap.beginX, gap.beginY), {i, cap.other, before}});
    if (after > cap.other)
        parts.corners.push_back({centre + radius * at(gap.endX, gap.endY), {i, cap.other, after}});
}

/// A number for a corner, such that sums of different ones differ.
std::uint64_t fingerprint(const CornerName& name)
{
    std::uint64_t hash = name.above ? 0x9e3779b97f4a7c15ull : 0x94d049bb133111ebull;
    for (const std::int32_t ball : name.balls) {
        hash = (hash ^ std::uint64_t(ball)) * 0xbf58476d1ce4e5b9ull;
        hash ^= hash >> 29;
    }
    return hash;
}

/// Whether every corner ends one arc of the balls 0 and 1, one of 0 and 2, and one of 1 and 2 of
/// its name: these count 1, 1 and -2.
bool cornersFit(const std::vector<Arc>& arcs)
{
    std::uint64_t sum = 0;
    for (const Arc& arc : arcs) {
        for (int e = 0; e < 2 && arc.ends[e] >= 0; ++e) {
            const CornerName name = cornerAt(arc, e);
            sum += fingerprint(name) * (arc.ends[e] == name.balls[0] ? std::uint64_t(-2) : 1);
        }
    }
    return sum == 0;
}

/// Numbers the parts of the union that hang together, each of which has a patch.
/// @return how many there are
std::size_t numberComponents(std::vector<Patch>& patches, DisjointSets& joined)
{
    std::unordered_map<std::uint32_t, std::int32_t> numbers; // of the roots
    for (Patch& patch : patches) {
        const std::uint32_t root = joined.find(std::uint32_t(patch.ball));
        patch.component = numbers.emplace(root, std::int32_t(numbers.size())).first->second;
    }
    return numbers.size();
}

/// A boundary with the patches of exposed balls, and with room for their caps, arcs and corners.
BallBoundary arranged(const std::vector<PlacedBall>& balls,
                      const std::vector<std::uint8_t>& exposed, const std::vector<BallParts>& parts)
{
    BallBoundary boundary;
    std::uint32_t caps = 0, arcs = 0, corners = 0;
    for (std::size_t n = 0; n < balls.size(); ++n) {
        if (!exposed[n]) continue;
        Patch patch{
            balls[n].centre(), balls[n].radius, std::int32_t(n), -1, caps, 0, arcs, 0, corners, 0};
        patch.capsEnd = caps += parts[n].caps;
        patch.arcsEnd = arcs += std::uint32_t(parts[n].arcs.size());
        patch.cornersEnd = corners += std::uint32_t(parts[n].corners.size());
        boundary.patches.push_back(patch);
    }
    boundary.caps.resize(caps);
    boundary.arcs.resize(arcs);
    boundary.corners.resize(corners);
    return boundary;
}

/// The boundary of balls in general position.
/// @throws SpecialPosition if they are not
BallBoundary boundaryOf(std::vector<PlacedBall> balls, const Progress& progress)
{
    const CapFinder finder(balls);
    tbb::enumerable_thread_specific<Scratch> scratches;
    std::vector<BallParts> all(balls.size());
    std::vector<std::uint8_t> exposed(balls.size());
    DisjointSets joined(balls.size());
    std::atomic<bool> anyLost{false}; // a ball whose overlaps are not all known
    const std::size_t rays = raysFor(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t n) {
        Scratch& s = scratches.local();
        const auto i = std::int32_t(n);
        const Exposure exposure = finder.find(i, s.finder, s.caps);
        if (exposure.amongMany) anyLost = true;
        if (!exposure.possible) return;
        all[n].caps = std::uint32_t(s.caps.size());
        all[n].cell = sampleCell(s.caps, balls[n].radius, i, rays);
        if (s.caps.size() == 0) exposed[n] = 1;
        for (int k = 0; k < s.caps.size(); ++k) {
            const Cap cap = s.caps[k];
            if (cap.other < i) continue; // found by the other
            joined.join(std::uint32_t(n), std::uint32_t(cap.other));
            Circle circle;
            findGaps(balls, i, s.caps, k, s.circle, circle, s.gaps);
            for (const Gap& gap : s.gaps) addArc(balls[n], i, cap, circle, gap, s.caps, all[n]);
        }
    });
    CellVolume cells{};
    for (const BallParts& parts : all) {
        cells.volume += parts.cell.volume;
        cells.variance += parts.cell.variance;
        for (const Arc& arc : parts.arcs) {
            for (const std::int32_t ball : arc.balls) exposed[std::size_t(ball)] = 1;
        }
    }

    BallBoundary boundary = arranged(balls, exposed, all);
    parallelFor(boundary.patches.size(), progress, [&](std::size_t p) {
        const Patch& patch = boundary.patches[p];
        const auto n = std::size_t(patch.ball);
        Scratch& s = scratches.local();
        finder.find(patch.ball, s.finder, s.caps); // once more: all would take much memory
        for (int k = 0; k < s.caps.size(); ++k)
            boundary.caps[patch.capsBegin + std::size_t(k)] = s.caps[k];
        std::copy(all[n].arcs.begin(), all[n].arcs.end(), boundary.arcs.begin() + patch.arcsBegin);
        std::copy(all[n].corners.begin(), all[n].corners.end(),
                  boundary.corners.begin() + patch.cornersBegin);
        all[n] = BallParts();
    });
    if (!anyLost) {
        boundary.estimate = {numberComponents(boundary.patches, joined), cells.volume,
                             std::sqrt(cells.variance)};
    }
    boundary.balls = std::move(balls);
    return boundary;
}

} // namespace

Vec3d Arc::end(int which) const
{
    const double sine = std::sin(half) * (which == 0 ? -1.0 : 1.0);
    return std::cos(half) * middle + sine * axis.cross(middle);
}

CornerName cornerAt(const Arc& arc, int which)
{
    // The third ball covers the circle up to where an arc begins: ahead of it about the axis, on
    // the side of (c_1 - c_0) x (c_third - c_0). Sorting three balls turns the side over if it
    // exchanges two.
    const std::int32_t a = arc.balls[0], b = arc.balls[1], c = arc.ends[which];
    const bool ahead = which == 0;
    if (c > b) return {{a, b, c}, ahead};
    if (c > a) return {{a, c, b}, !ahead};
    return {{c, a, b}, ahead};
}

bool capsOverlap(const BallBoundary& boundary, const Patch& patch, const Cap& a, const Cap& b)
{
    constexpr double rounding = 1e-12;
    const auto sineOf = [](double cosine) { return std::sqrt((1.0 - cosine) * (1.0 + cosine)); };
    const double sum = a.cosine + b.cosine, sineA = sineOf(a.cosine), sineB = sineOf(b.cosine);
    if (sum < -rounding) return true; // the half angles add up to more than pi
    const double apart = a.axis.dot(b.axis) - a.cosine * b.cosine + sineA * sineB;
    if (sum > rounding && std::abs(apart) > rounding * (1.0 + 1.0 / sineA + 1.0 / sineB))
        return apart > 0.0;

    const auto planeOf = [&](const Cap& cap) {
        return quadPlane(boundary.balls[std::size_t(patch.ball)],
                         boundary.balls[std::size_t(cap.other)]);
    };
    const QuadPlane p = planeOf(a), q = planeOf(b);
    const Quad r(patch.radius), lengthP = sqrt(p.way.dot(p.way)), lengthQ = sqrt(q.way.dot(q.way));
    const Quad cosineP = p.height / (lengthP * r), cosineQ = q.height / (lengthQ * r);
    if (cosineP + cosineQ <= 0) return true;
    const Quad sines = sqrt((1 - cosineP * cosineP) * (1 - cosineQ * cosineQ));
    return p.way.dot(q.way) / (lengthP * lengthQ) > cosineP * cosineQ - sines;
}

BallBoundary ballBoundary(const std::vector<Ball>& balls, double probe, const Progress& progress)
{
    // The chance that balls need another try is that of rounding in quadruple precision.
    constexpr std::uint64_t tries = 4;
    for (std::uint64_t salt = 0; salt < tries; ++salt) {
        try {
            BallBoundary boundary = boundaryOf(placedBalls(balls, probe, salt), progress);
            if (cornersFit(boundary.arcs)) return boundary;
        } catch (const SpecialPosition&) {
        }
    }
    throw Error(ErrorKind::Check, "boundary: arcs do not meet in corners");
}

} // namespace molsurf
