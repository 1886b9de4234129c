// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_boundary.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_caps.h"
#include "molsurf/kernel/balls/circle_cover.h"
#include "molsurf/kernel/balls/quad.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <set>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The numbers of what a ball has: caps, and arcs and corners with later balls.
struct Counts {
    std::uint32_t caps = 0, arcs = 0, corners = 0;
};

/// Patches, arcs and corners of some consecutive balls.
struct BallParts {
    static constexpr std::size_t balls = 16; // of most

    std::vector<std::int32_t> capOthers; // of balls with a part of their sphere that may be
                                         // free; the caps themselves would take much memory
    std::vector<Arc> arcs;
    std::vector<Corner> corners;

    void clear()
    {
        capOthers.clear();
        arcs.clear();
        corners.clear();
    }
};

/// Room for one ball, kept from ball to ball by a thread.
struct Scratch {
    CapFinder::Scratch finder;
    CapArrays caps;
    CircleScratch circle;
    std::vector<Gap> gaps;
    BallParts parts;
};

/// Adds a gap of a circle as an arc, with the corners at its ends that no other circle adds. The
/// circle is on ball i and on cap.other behind it: each circle is found once.
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

/// A hash of a corner: sums of those of different corners differ.
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
/// its name. Its hash is added for the first two and taken away twice for the third, so the sum,
/// modulo 2^64, is 0 then.
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

/// Whether an arc is no longer than the moves of balls make it where several of them meet in a
/// point, or as good as that.
bool isPoint(const Arc& arc, const std::vector<PlacedBall>& balls)
{
    constexpr double small = 1e-4; // of the radius of either ball
    const double length = 2.0 * arc.half * arc.radius;
    return arc.ends[0] >= 0 && length < small * balls[std::size_t(arc.balls[0])].radius &&
           length < small * balls[std::size_t(arc.balls[1])].radius;
}

/// The corners of pieces of the boundary that are points: each ends three arcs that are points. One
/// probe fits there and cannot move, or just does not fit: the moves would decide. Union-find joins
/// such arcs to pieces; a piece with a corner of fewer than three of them is no point.
std::set<CornerName> pointCorners(const std::vector<BallParts>& all,
                                  const std::vector<PlacedBall>& balls)
{
    std::map<CornerName, std::vector<std::uint32_t>> arcsAt;
    std::uint32_t count = 0;
    for (const BallParts& parts : all) {
        for (const Arc& arc : parts.arcs) {
            if (!isPoint(arc, balls)) continue;
            for (int e = 0; e < 2; ++e) arcsAt[cornerAt(arc, e)].push_back(count);
            ++count;
        }
    }
    DisjointSets pieces(count);
    for (const auto& [corner, arcs] : arcsAt)
        for (const std::uint32_t arc : arcs) pieces.join(arcs.front(), arc);
    std::set<std::uint32_t> open;
    for (const auto& [corner, arcs] : arcsAt)
        if (arcs.size() < 3) open.insert(pieces.find(arcs.front()));
    std::set<CornerName> out;
    for (const auto& [corner, arcs] : arcsAt)
        if (open.count(pieces.find(arcs.front())) == 0) out.insert(corner);
    return out;
}

/// Whether a sphere that lost all its arcs is free. It is covered or free as a whole, so that one
/// direction decides, which is none of a crystal.
/// @param[in] all  in blocks, with the caps of their balls one after the other
bool isBare(const std::vector<PlacedBall>& balls, std::size_t n, const std::vector<BallParts>& all,
            const std::vector<Counts>& counts)
{
    const Vec3d direction(0.36137, 0.48291, -0.79764);
    const std::size_t first = n / BallParts::balls;
    auto other = all[first].capOthers.begin();
    for (std::size_t i = first * BallParts::balls; i < n; ++i) other += counts[i].caps;
    return std::none_of(other, other + counts[n].caps, [&](std::int32_t o) {
        const Cap cap = meetingCap(balls[n], balls[std::size_t(o)], o);
        return direction.dot(cap.axis) > cap.cosine * direction.length();
    });
}

/// Takes the pieces that are points from what balls have.
/// @param[in,out] exposed  whether a ball has any part in the boundary
void dropPoints(const std::vector<PlacedBall>& balls, std::vector<BallParts>& all,
                std::vector<Counts>& counts, std::vector<std::uint8_t>& exposed)
{
    const std::set<CornerName> points = pointCorners(all, balls);
    if (points.empty()) return;
    std::set<std::int32_t> touched;
    for (BallParts& parts : all) {
        std::vector<Arc> arcs;
        std::vector<Corner> corners;
        auto corner = parts.corners.begin();
        for (const Arc& arc : parts.arcs) {
            const bool gone = isPoint(arc, balls) && points.count(cornerAt(arc, 0)) > 0;
            Counts& own = counts[std::size_t(arc.balls[0])];
            own.arcs -= gone;
            if (gone) touched.insert(arc.balls, arc.balls + 2);
            if (!gone) arcs.push_back(arc);
            for (const std::int32_t end : arc.ends) {
                if (end <= arc.balls[1]) continue; // another arc keeps the corner
                own.corners -= gone;
                if (!gone) corners.push_back(*corner);
                ++corner;
            }
        }
        parts.arcs = std::move(arcs);
        parts.corners = std::move(corners);
    }
    for (const std::int32_t n : touched)
        exposed[std::size_t(n)] = isBare(balls, std::size_t(n), all, counts);
}

/// Numbers the parts of the union that hang together, each of which has a patch.
/// @return how many there are
std::size_t numberComponents(std::size_t balls, std::vector<Patch>& patches, DisjointSets& joined)
{
    std::vector<std::int32_t> numbers(balls, -1); // of the roots
    std::int32_t count = 0;
    for (Patch& patch : patches) {
        std::int32_t& number = numbers[joined.find(std::uint32_t(patch.ball))];
        if (number < 0) number = count++;
        patch.component = number;
    }
    return std::size_t(count);
}

/// The patches of exposed balls, for which there is the room for caps, arcs and corners.
void arrange(const std::vector<std::uint8_t>& exposed, const std::vector<Counts>& counts,
             BallBoundary& boundary)
{
    Counts sum;
    for (std::size_t n = 0; n < boundary.balls.size(); ++n) {
        if (!exposed[n]) continue;
        const PlacedBall& ball = boundary.balls[n];
        Patch patch{ball.centre(), ball.radius, std::int32_t(n), -1, sum.caps, 0,
                    sum.arcs,      0,           sum.corners,     0};
        patch.capsEnd = sum.caps += counts[n].caps;
        patch.arcsEnd = sum.arcs += counts[n].arcs;
        patch.cornersEnd = sum.corners += counts[n].corners;
        boundary.patches.push_back(patch);
    }
    boundary.caps.resize(sum.caps);
    boundary.capOthers.resize(sum.caps);
    boundary.arcs.resize(sum.arcs);
    boundary.corners.resize(sum.corners);
}

/// Copies what exposed balls have to its place in the boundary.
/// @param[in] ball   the first of those that have the parts
/// @param[in] patch  the first of theirs, or a later one
void place(const BallParts& parts, std::size_t ball, const std::vector<Counts>& counts,
           std::size_t patch, BallBoundary& boundary)
{
    Counts at;
    const std::size_t end = std::min(ball + BallParts::balls, boundary.balls.size());
    for (std::size_t n = ball; n < end; ++n) {
        if (patch < boundary.patches.size() && boundary.patches[patch].ball == std::int32_t(n)) {
            const Patch& p = boundary.patches[patch++];
            for (std::size_t k = 0; k < counts[n].caps; ++k) {
                const std::int32_t other = parts.capOthers[at.caps + k];
                const Cap cap =
                    meetingCap(boundary.balls[n], boundary.balls[std::size_t(other)], other);
                boundary.capOthers[p.capsBegin + k] = other;
                boundary.caps.set(p.capsBegin + k, cap);
            }
            std::copy_n(parts.arcs.begin() + at.arcs, counts[n].arcs,
                        boundary.arcs.begin() + p.arcsBegin);
            std::copy_n(parts.corners.begin() + at.corners, counts[n].corners,
                        boundary.corners.begin() + p.cornersBegin);
        }
        at.caps += counts[n].caps;
        at.arcs += counts[n].arcs;
        at.corners += counts[n].corners;
    }
}

/// What balls in general position have, found in two passes over blocks of consecutive balls: which
/// spheres may have a free part, and the arcs between two of these.
class PartsFinder
{
public:
    /// @param[in] balls  kept by reference
    explicit PartsFinder(const std::vector<PlacedBall>& balls)
        : all((balls.size() + BallParts::balls - 1) / BallParts::balls), counts(balls.size()),
          exposed(balls.size()), joined(balls.size()), balls_(balls), finder_(balls),
          hidden_(balls.size())
    {
    }

    /// @throws SpecialPosition if the balls are not in general position
    void find(const Progress& progress)
    {
        parallelFor(all.size(), progress, [&](std::size_t c) { findCaps(c); });
        parallelFor(all.size(), progress, [&](std::size_t c) { findArcs(c); });
    }

    std::vector<BallParts> all; // in blocks
    std::vector<Counts> counts;
    std::vector<std::uint8_t> exposed; // whether a ball has any part in the boundary
    DisjointSets joined;               // balls that overlap

    bool knowsOverlaps() const { return !anyLost_; }

private:
    std::size_t end(std::size_t block) const
    {
        return std::min((block + 1) * BallParts::balls, balls_.size());
    }

    void findCaps(std::size_t block)
    {
        Scratch& s = scratches_.local();
        s.parts.clear();
        for (std::size_t n = block * BallParts::balls; n < end(block); ++n) {
            const auto i = std::int32_t(n);
            const Exposure exposure = finder_.find(i, s.finder, s.caps);
            if (exposure.amongMany) anyLost_ = true;
            hidden_[n] = exposure.hidden || !exposure.possible;
            if (!exposure.possible) continue;
            // With balls that cover what others cover of a sphere, parts hang together as they do:
            // where these had a ball in common with others, one of them would have it, too.
            const auto join = [&](std::int32_t other) {
                joined.join(std::uint32_t(n), std::uint32_t(other));
            };
            if (exposure.hidden) {
                std::for_each(s.finder.near.begin(), s.finder.near.end(), join);
                continue;
            }
            std::for_each(s.caps.other.begin(), s.caps.other.end(), join);
            exposed[n] = s.caps.size() == 0;
            counts[n].caps = std::uint32_t(s.caps.size());
            s.parts.capOthers.insert(s.parts.capOthers.end(), s.caps.other.begin(),
                                     s.caps.other.end());
        }
        all[block] = s.parts; // a copy takes no more memory than it needs
    }

    /// Arcs and corners of the balls of a block. A circle on a hidden sphere has none.
    void findArcs(std::size_t block)
    {
        Scratch& s = scratches_.local();
        s.parts.clear();
        const std::int32_t* others = all[block].capOthers.data();
        for (std::size_t n = block * BallParts::balls; n < end(block); ++n) {
            const std::size_t arcs = s.parts.arcs.size(), corners = s.parts.corners.size();
            const std::size_t caps = counts[n].caps;
            if (!hidden_[n]) findArcsOf(std::int32_t(n), others, caps, s);
            others += caps;
            counts[n].arcs = std::uint32_t(s.parts.arcs.size() - arcs);
            counts[n].corners = std::uint32_t(s.parts.corners.size() - corners);
        }
        all[block].arcs = s.parts.arcs;
        all[block].corners = s.parts.corners;
    }

    void findArcsOf(std::int32_t i, const std::int32_t* others, std::size_t caps, Scratch& s)
    {
        const auto isOwn = [&](std::int32_t other) { // others find it, or it is covered
            return other > i && !hidden_[std::size_t(other)];
        };
        if (std::none_of(others, others + caps, isOwn)) return;
        finder_.findAgain(i, others, caps, s.finder, s.caps);
        for (int k = 0; k < s.caps.size(); ++k) {
            const Cap cap = s.caps[k];
            if (!isOwn(cap.other)) continue;
            Circle circle;
            findGaps(balls_, i, s.caps, k, s.circle, circle, s.gaps);
            for (const Gap& gap : s.gaps)
                addArc(balls_[std::size_t(i)], i, cap, circle, gap, s.caps, s.parts);
        }
    }

    const std::vector<PlacedBall>& balls_;
    CapFinder finder_;
    tbb::enumerable_thread_specific<Scratch> scratches_;
    std::vector<std::uint8_t> hidden_; // whether no part of a sphere is free
    std::atomic<bool> anyLost_{false}; // a ball whose overlaps are not all known
};

/// The boundary of balls in general position.
/// @throws SpecialPosition if they are not
BallBoundary boundaryOf(std::vector<PlacedBall> placed, const Progress& progress)
{
    BallBoundary boundary;
    boundary.balls = std::move(placed);
    const std::vector<PlacedBall>& balls = boundary.balls;
    PartsFinder parts(balls);
    parts.find(progress);
    dropPoints(balls, parts.all, parts.counts, parts.exposed);
    for (const BallParts& block : parts.all) {
        for (const Arc& arc : block.arcs) {
            for (const std::int32_t ball : arc.balls) parts.exposed[std::size_t(ball)] = 1;
        }
    }

    arrange(parts.exposed, parts.counts, boundary);
    parallelFor(parts.all.size(), progress, [&](std::size_t c) {
        const auto first = std::int32_t(c * BallParts::balls);
        const auto patch = std::partition_point(boundary.patches.begin(), boundary.patches.end(),
                                                [&](const Patch& p) { return p.ball < first; });
        place(parts.all[c], std::size_t(first), parts.counts,
              std::size_t(patch - boundary.patches.begin()), boundary);
        parts.all[c] = BallParts();
    });
    if (parts.knowsOverlaps())
        boundary.components = numberComponents(balls.size(), boundary.patches, parts.joined);
    return boundary;
}

} // namespace

void CapLists::resize(std::size_t count)
{
    const std::size_t padded = count + std::size_t(floatLanes);
    for (auto* list : {&x, &y, &z, &cosine, &sine})
        if (list->size() < padded) list->resize(padded);
    std::fill_n(cosine.begin() + std::ptrdiff_t(count), floatLanes, 2.0f);
    count_ = int(count);
}

void CapLists::add(float ax, float ay, float az, float capCosine, float capSine)
{
    const auto i = std::size_t(count_++);
    if (x.size() == i + floatLanes)
        for (auto* list : {&x, &y, &z, &cosine, &sine}) list->push_back(0.0f);
    x[i] = ax;
    y[i] = ay;
    z[i] = az;
    cosine[i] = capCosine;
    sine[i] = capSine;
    cosine[i + floatLanes] = 2.0f;
}

void CapLists::set(std::size_t i, const Cap& cap)
{
    x[i] = float(cap.axis.x());
    y[i] = float(cap.axis.y());
    z[i] = float(cap.axis.z());
    cosine[i] = float(cap.cosine);
    sine[i] = float(std::sqrt((1.0 - cap.cosine) * (1.0 + cap.cosine)));
}

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
    // Of the angle between the axes and of the sum A + B of the half angles: cos - cos(A + B).
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
