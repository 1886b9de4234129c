// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/circle_cover.h"

#include "molsurf/kernel/balls/quad.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

void CircleCovers::resize(std::size_t count)
{
    for (auto* v : {&x, &y, &cosine, &error})
        if (v->size() < count) v->resize(count);
}

namespace
{

/// Places on a circle are taken from doubles if their error is below this.
constexpr double largestError = 1e-10;

using Bits __attribute__((aligned(4))) = std::uint32_t __attribute__((vector_size(32)));

struct CapPointers {
    const double *x, *y, *z, *cosine;
};

/// Finds the parts of a circle that caps cover, as in CircleCovers. A cap of cosine c meets the
/// circle where u cos a + v sin a = (c - height along)/radius; (x, y) is (u, v)/|(u, v)|.
/// @return whether one surely covers all of it
MOLSURF_KERNEL bool intersectCircle(const Circle& circle, const CapPointers& caps, int count,
                                    double* __restrict x, double* __restrict y,
                                    double* __restrict cosine, double* __restrict error)
{
    const Vec3d axis = circle.axis, e1 = circle.e1, e2 = circle.e2;
    const double height = circle.cosine, radius = circle.sine;
    // 16 roundings of numbers up to 1, divided by the circle's radius and by the distance of the
    // cap's axis from that of the circle. The radius itself has an error of 1/radius roundings.
    const double rounding = 16.0 * 0x1p-52 / (radius * radius);
    std::int64_t whole = 0; // as wide as what is compared
    for (int k = 0; k < count; ++k) {
        const double along = axis.x() * caps.x[k] + axis.y() * caps.y[k] + axis.z() * caps.z[k];
        const double u = e1.x() * caps.x[k] + e1.y() * caps.y[k] + e1.z() * caps.z[k];
        const double v = e2.x() * caps.x[k] + e2.y() * caps.y[k] + e2.z() * caps.z[k];
        const double inverse = 1.0 / std::sqrt(u * u + v * v);
        x[k] = u * inverse;
        y[k] = v * inverse;
        const double c = (caps.cosine[k] - height * along) * inverse / radius;
        const double e = rounding * inverse;
        cosine[k] = c;
        error[k] = e;
        whole |= c < -1.0 - e ? 1 : 0;
    }
    return whole != 0;
}

} // namespace

void CapColumns::take(const CapArrays& caps, const std::vector<std::int32_t>& places)
{
    for (auto* list : {&x, &y, &z, &cosine}) list->resize(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto i = std::size_t(places[k]);
        x[k] = caps.x[i];
        y[k] = caps.y[i];
        z[k] = caps.z[i];
        cosine[k] = caps.cosine[i];
    }
}

void RoundedCovers::resize(std::size_t count)
{
    for (auto* list : {&base, &u, &v, &sine, &holds, &held})
        list->resize(std::max(list->size(), count + std::size_t(floatLanes)));
}

namespace
{

/// Finds parts of a circle, of 32, that surely lie in a cover, in floats. Most circles are covered
/// well enough for that. A direction (x, y) lies at 8 (1 - t) or, where y < 0, at 8 (3 + t) with t
/// = x/(|x| + |y|), which grows from 0 to 32 as its angle does.
/// @param[out] f  of the caps looked at, as keepCovers() takes it; all of them if a part is open
/// @return a bit for each part
MOLSURF_KERNEL std::uint32_t coveredParts(const Circle& circle, const CapLists& caps,
                                          RoundedCovers& f)
{
    // With (u, v) of a length above 1/20, cosines have an error below 2e-5, and sines, of cosines
    // that are cut off so that a cover becomes larger or one about it smaller, below 2e-4. A part
    // is at least 1/8 wide, so that ends are known to 0.01 of it.
    constexpr float margin = 1e-3f, most = 0.99f, room = 0.02f;
    const float ax = float(circle.axis.x()), ay = float(circle.axis.y());
    const float az = float(circle.axis.z()), height = float(circle.cosine);
    const float r = float(circle.sine);
    const float ux = r * float(circle.e1.x()), uy = r * float(circle.e1.y());
    const float uz = r * float(circle.e1.z()), vx = r * float(circle.e2.x());
    const float vy = r * float(circle.e2.y()), vz = r * float(circle.e2.z());
    const auto placeOf = [](Floats x, Floats y) {
        const Floats t = x / (size(x) + size(y));
        return 8.0f * (y >= 0.0f ? 1.0f - t : 3.0f + t);
    };
    std::uint32_t covered = 0;
    for (int k = 0; k < caps.size() && ~covered != 0; k += floatLanes) {
        const Floats x = load(caps.x.data() + k), y = load(caps.y.data() + k);
        const Floats z = load(caps.z.data() + k);
        const Floats base = height * (ax * x + ay * y + az * z) - load(caps.cosine.data() + k);
        const Floats u = ux * x + uy * y + uz * z, v = vx * x + vy * y + vz * z;
        const Floats inverse = 1.0f / squareRoot(u * u + v * v), cosine = -base * inverse;
        const Ints known = inverse < 20.0f;
        const Ints none = known & (cosine > 1.0f + margin), holding = known & (cosine < most);
        const Floats cut = clamped(cosine, splat(-most), splat(most));
        const Floats along = u * inverse, across = v * inverse, sine = squareRoot(1.0f - cut * cut);
        store(f.u.data() + k, along);
        store(f.v.data() + k, across);
        store(f.base.data() + k, cut);
        store(f.sine.data() + k, sine);
        // Bounds of the cosines. holds: 2 if it may hold no other; held: 3 if it covers nothing and
        // so is dropped, -3 if it is not known and so kept.
        store(f.holds.data() + k, holding ? cut : splat(2.0f));
        store(f.held.data() + k, none ? splat(3.0f) : known ? cut : splat(-3.0f));
        const Floats begin = placeOf(along * cut + across * sine, across * cut - along * sine);
        const Floats end = placeOf(along * cut - across * sine, across * cut + along * sine);
        const Ints first = truncated(begin + room) + 1;
        const Ints last = truncated((end < begin ? end + 32.0f : end) - room);
        const Ints count = holding & (last > first) & (last - first);
        const Bits parts = ((Bits{} + 1) << Bits(count & 31)) - 1;
        const Bits turned = (parts << Bits(first & 31)) | (parts >> Bits((32 - first) & 31));
        Ints bits;
        std::memcpy(&bits, &turned, sizeof bits);
        covered |= bitsOf(bits);
    }
    return covered;
}

/// Finds the covers of a circle that do not surely lie within another one, in floats: only these
/// can be beside a gap.
/// @param[in]  f     from coveredParts()
/// @param[out] kept  the places of their caps; room for all
/// @return their number
MOLSURF_KERNEL int keepCovers(RoundedCovers& f, int count, std::int32_t* kept)
{
    constexpr float margin = 1e-3f;
    // Most caps cover nothing of a circle: only the others are compared.
    int some = 0;
    for (int k = 0; k < count; k += floatLanes) {
        const Ints covers = load(f.held.data() + k) < 2.5f;
        for (std::uint32_t bits = bitsOf(covers & laneBits()); bits != 0; bits &= bits - 1) {
            const int from = k + __builtin_ctz(bits);
            if (from >= count) break;
            for (auto* list : {&f.u, &f.v, &f.base, &f.sine, &f.holds, &f.held})
                (*list)[std::size_t(some)] = (*list)[std::size_t(from)];
            kept[some++] = from;
        }
    }
    int m = 0;
    for (int k = 0; k < some; k += floatLanes) {
        const Floats x = load(f.u.data() + k), y = load(f.v.data() + k);
        const Floats cosine = load(f.base.data() + k), sine = load(f.sine.data() + k);
        const Floats held = load(f.held.data() + k);
        Ints within = {};
        for (int l = 0; l < some; ++l) {
            const auto i = std::size_t(l);
            const Floats between = f.u[i] * x + f.v[i] * y;
            const Floats difference = f.holds[i] * cosine + f.sine[i] * sine;
            within |= (between >= difference + margin) & (f.holds[i] <= held);
        }
        for (std::uint32_t bits = bitsOf(~within & laneBits()); bits != 0; bits &= bits - 1) {
            const int at = k + __builtin_ctz(bits);
            if (at < some) kept[m++] = kept[at];
        }
    }
    return m;
}

enum class Answer { Yes, No, Unknown };

/// The ends of covers. No: one of them covers all of the circle.
/// @param[in]  caps   the place of the cap of each
/// @param[out] doubt  the largest error of an end
Answer findCovers(const CircleCovers& m, const std::vector<std::int32_t>& caps, int own,
                  std::vector<Cover<double>>& covers, double& doubt)
{
    covers.clear();
    doubt = 0.0;
    for (std::size_t i = 0; i < caps.size(); ++i) {
        const std::int32_t k = caps[i];
        const double c = m.cosine[i], beyond = std::abs(c) - 1.0;
        if (k == own || (beyond > m.error[i] && c > 0.0)) continue;
        // Not a number counts as unknown.
        if (!(beyond < -m.error[i])) return Answer::Unknown;
        const double sine = std::sqrt((1.0 - c) * (1.0 + c)), x = m.x[i], y = m.y[i];
        doubt = std::max(doubt, m.error[i] / sine);
        covers.push_back(
            {x * c + y * sine, y * c - x * sine, x * c - y * sine, y * c + x * sine, k});
    }
    return doubt < largestError ? Answer::Yes : Answer::Unknown;
}

/// The same in quadruple precision, from the balls themselves.
Answer findCovers(const std::vector<PlacedBall>& balls, std::int32_t i, const CapArrays& caps,
                  int own, const Circle& circle, std::vector<Cover<Quad>>& covers, Quad& doubt)
{
    const PlacedBall& ball = balls[std::size_t(i)];
    const auto planeOf = [&](int k) {
        return quadPlane(ball, balls[std::size_t(caps.other[std::size_t(k)])]);
    };
    const QuadPlane plane = planeOf(own);
    const Quad way2 = plane.way.dot(plane.way);
    const QuadVector axis = plane.way * (1 / sqrt(way2)),
                     middle = plane.way * (plane.height / way2);
    const Quad r(ball.radius), radius = sqrt(r * r - plane.height * plane.height / way2);
    // The frame of the doubles, without their errors.
    QuadVector e1{circle.e1.x(), circle.e1.y(), circle.e1.z()};
    e1 = e1 - axis * e1.dot(axis);
    e1 = e1 * (1 / sqrt(e1.dot(e1)));
    const QuadVector e2 = axis.cross(e1);

    const Quad tie(1e-20);
    covers.clear();
    doubt = tie;
    for (int k = 0; k < caps.size(); ++k) {
        if (k == own) continue;
        const QuadPlane other = planeOf(k);
        const Quad u = other.way.dot(e1), v = other.way.dot(e2), length = sqrt(u * u + v * v);
        const Quad rest = other.height - other.way.dot(middle), most = radius * length;
        if (abs(abs(rest) - most) <= tie * most) return Answer::Unknown;
        if (rest > most) continue;
        if (rest < -most) return Answer::No;
        const Quad x = u / length, y = v / length, c = rest / most, sine = sqrt((1 - c) * (1 + c));
        covers.push_back(
            {x * c + y * sine, y * c - x * sine, x * c - y * sine, y * c + x * sine, k});
    }
    return Answer::Yes;
}

/// A number from 0 to 4 that grows as the angle of a direction does, at half to the whole of its
/// rate.
template<typename Real>
Real pseudoAngle(const Real& x, const Real& y)
{
    using std::abs;
    const Real part = x / (abs(x) + abs(y));
    return y >= 0 ? Real(1 - part) : Real(3 + part);
}

/// The gaps between covers, by a sweep over these in the order of their begins. `last` is the one
/// with the farthest end so far; a gap opens where the next begins beyond that.
/// @param[in] doubt  the error of their ends, at most
/// @return false if ends lie too near each other to tell which comes first
template<typename Real>
bool findGaps(const std::vector<Cover<Real>>& covers, const Real& doubt, std::vector<Gap>& gaps)
{
    struct Interval {
        Real begin, end; // end > begin; what runs over the full turn comes twice
        int cover;
    };
    thread_local std::vector<Interval> intervals;
    gaps.clear();
    if (covers.empty()) {
        gaps.push_back({1.0, 0.0, 1.0, 0.0, -1, -1});
        return true;
    }
    intervals.clear();
    for (std::size_t k = 0; k < covers.size(); ++k) {
        const Cover<Real>& c = covers[k];
        const Real begin = pseudoAngle(c.beginX, c.beginY), end = pseudoAngle(c.endX, c.endY);
        if (begin < end) {
            intervals.push_back({begin, end, int(k)});
        } else {
            intervals.push_back({begin, end + 4, int(k)});
            intervals.push_back({begin - 4, end, int(k)});
        }
    }
    std::sort(intervals.begin(), intervals.end(),
              [](const Interval& a, const Interval& b) { return a.begin < b.begin; });

    const Real margin = 4 * doubt;
    const auto tooNear = [&](const Real& a, const Real& b) {
        return a - b < margin && b - a < margin;
    };
    const auto add = [&](int before, int after) {
        const Cover<Real>&b = covers[std::size_t(before)], &a = covers[std::size_t(after)];
        gaps.push_back(
            {double(b.endX), double(b.endY), double(a.beginX), double(a.beginY), b.cap, a.cap});
    };
    Interval last = intervals.front();
    bool sure = true, opened = false; // whether the last one came behind a gap
    for (std::size_t i = 1; i < intervals.size() && sure; ++i) {
        const Interval& next = intervals[i];
        sure = !tooNear(next.begin, last.end) && !tooNear(next.end, last.end) &&
               !(opened && tooNear(next.begin, intervals[i - 1].begin));
        opened = next.begin > last.end;
        if (opened) add(last.cover, next.cover);
        if (opened || next.end > last.end) last = next;
    }
    const Real again = intervals.front().begin + 4;
    sure = sure && !tooNear(again, last.end);
    if (again > last.end) {
        sure = sure && (intervals.size() < 2 || !tooNear(intervals[1].begin, intervals[0].begin));
        add(last.cover, intervals.front().cover);
    }
    return sure;
}

} // namespace

void findGaps(const std::vector<PlacedBall>& balls, std::int32_t i, const CapArrays& caps, int own,
              CircleScratch& scratch, Circle& circle, std::vector<Gap>& gaps)
{
    gaps.clear();
    const auto place = std::size_t(own);
    // Three tries: floats for circles that are covered, doubles with bounds of their errors, and
    // quadruple precision where these leave a doubt.
    const auto [e1, e2] = perpendicular(caps[own].axis);
    circle = {caps[own].axis, e1, e2, caps.cosine[place], caps.sine[place]};
    scratch.rounded.resize(std::size_t(caps.size()));
    if (~coveredParts(circle, caps.rounded, scratch.rounded) == 0) return;
    std::vector<std::int32_t>& kept = scratch.kept;
    kept.resize(std::size_t(caps.size() + floatLanes));
    kept.resize(std::size_t(keepCovers(scratch.rounded, caps.size(), kept.data())));
    CapColumns& near = scratch.caps;
    near.take(caps, kept);
    const int count = int(kept.size());
    CircleCovers& m = scratch.circleCovers;
    m.resize(kept.size());
    const bool whole =
        intersectCircle(circle, {near.x.data(), near.y.data(), near.z.data(), near.cosine.data()},
                        count, m.x.data(), m.y.data(), m.cosine.data(), m.error.data());
    if (whole) return;
    double doubt;
    Answer found = findCovers(m, kept, own, scratch.covers, doubt);
    if (found == Answer::Yes && findGaps(scratch.covers, doubt, gaps)) return;

    thread_local std::vector<Cover<Quad>> covers;
    Quad quadDoubt;
    found = findCovers(balls, i, caps, own, circle, covers, quadDoubt);
    gaps.clear();
    if (found == Answer::No) return;
    if (found == Answer::Unknown || !findGaps(covers, quadDoubt, gaps)) throw SpecialPosition();
}

} // namespace molsurf
