// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_caps.h"

#include "molsurf/kernel/balls/covered_sphere.h"
#include "molsurf/kernel/balls/quad.h"
#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// Room by which a cap has to lie within another one to be left out: more than the rounding of
/// floats. Those that may just touch stay.
constexpr float heldMargin = 3e-6f;

/// With more balls that touch it than this, a ball is looked at by its power cell.
constexpr std::size_t dense = 800;

/// Keeps the caps that do not lie within others, in their order.
/// @param[in,out] caps    the large ones first, which are compared with fewer; those with a sine
///                        below 0, which are not known, are kept
/// @param[in]     error   by which a cosine may be too large
/// @param[in]     margin  by which a cap has to lie within another one
/// @param[out]    kept    their places; room for all
/// @return their number
MOLSURF_KERNEL std::size_t keepCaps(CapLists& caps, float error, float margin, std::int32_t* kept)
{
    const auto count = std::size_t(caps.size());
    std::size_t m = 0;
    for (std::size_t k = 0; k < count; k += floatLanes) {
        const Floats x = load(&caps.x[k]), y = load(&caps.y[k]), z = load(&caps.z[k]);
        const Floats cosine =
            load(&caps.sine[k]) < 0.0f ? splat(-3.0f) : load(&caps.cosine[k]) - error;
        const Floats sine = squareRoot(larger((1.0f - cosine) * (1.0f + cosine), splat(0.0f)));
        Ints within = {};
        const auto compareWith = [&](std::size_t l) {
            const float large = caps.cosine[l];
            const Floats between = caps.x[l] * x + caps.y[l] * y + caps.z[l] * z;
            // The cosine of the difference of the half angles.
            const Floats difference = large * cosine + caps.sine[l] * sine;
            within |= (between >= difference + margin) & (large <= cosine);
        };
        const std::size_t before = m;
        for (std::size_t l = 0; l < before; ++l) compareWith(l);
        if (k == 0)
            for (std::size_t l = 0; l < floatLanes; ++l) compareWith(l);
        for (std::uint32_t bits = bitsOf(~within & laneBits()); bits != 0; bits &= bits - 1) {
            const std::size_t at = k + std::size_t(__builtin_ctz(bits));
            if (at >= count) break;
            for (auto* list : {&caps.x, &caps.y, &caps.z, &caps.cosine, &caps.sine})
                (*list)[m] = (*list)[at];
            kept[m++] = std::int32_t(at);
        }
    }
    return m;
}

/// The sign of |offset|^2 - length^2, without error.
int compareLength(const PlacedBall& a, const PlacedBall& b, double distance2, double length)
{
    constexpr double rounding = 1e-14;
    const double difference = distance2 - length * length;
    if (std::abs(difference) > rounding * (distance2 + length * length))
        return difference > 0.0 ? 1 : -1;
    const Quad exact = quadPlane(a, b).way.dot(quadPlane(a, b).way) - Quad(length) * Quad(length);
    return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

} // namespace

Relation relate(const PlacedBall& ball, const PlacedBall& other, std::int32_t j, Cap& cap)
{
    const Vec3d way = offset(ball, other);
    const double r = ball.radius, R = other.radius, distance2 = way.lengthSqr();
    if (compareLength(ball, other, distance2, r + R) >= 0) return Relation::Apart;
    if (compareLength(ball, other, distance2, R - r) <= 0)
        return R > r ? Relation::Around : Relation::Apart;
    cap = meetingCap(ball, other, j);
    return Relation::Meeting;
}

Cap meetingCap(const PlacedBall& ball, const PlacedBall& other, std::int32_t j)
{
    const Vec3d way = offset(ball, other);
    const double r = ball.radius, R = other.radius, distance2 = way.lengthSqr();
    const double distance = std::sqrt(distance2);
    constexpr double most = 1.0 - 0x1p-53; // rounding must not make it 1
    const double cosine = (distance2 + (r - R) * (r + R)) / (2.0 * distance * r);
    return {way / distance, std::clamp(cosine, -most, most), j};
}

void CapArrays::resize(std::size_t count)
{
    for (auto* v : {&x, &y, &z, &cosine, &sine})
        if (v->size() < count) v->resize(count);
    other.resize(count);
    rounded.resize(count);
}

void CapArrays::set(std::size_t i, const Cap& cap)
{
    x[i] = cap.axis.x();
    y[i] = cap.axis.y();
    z[i] = cap.axis.z();
    cosine[i] = cap.cosine;
    sine[i] = std::sqrt((1.0 - cap.cosine) * (1.0 + cap.cosine));
    other[i] = cap.other;
}

namespace
{

/// Finds the balls of groups of eight that may touch a ball, in ascending order.
/// @param[in]  own   the ball itself, which is left out
/// @param[in]  room  the radius, and more
/// @param[out] near  their numbers; room for all of the groups
MOLSURF_KERNEL std::size_t findTouching(const RoundedBalls& balls,
                                        const std::vector<std::size_t>& groups, std::int32_t own,
                                        float room, std::int32_t* near)
{
    constexpr std::size_t atOnce = 32 / floatLanes; // groups whose bits make a word
    const float x0 = balls.x[own], y0 = balls.y[own], z0 = balls.z[own];
    std::size_t count = 0;
    for (std::size_t from = 0; from < groups.size(); from += atOnce) {
        const std::size_t end = from + atOnce < groups.size() ? from + atOnce : groups.size();
        Ints found = {}, bits = laneBits();
        for (std::size_t g = from; g < end; ++g) {
            const std::size_t first = BoxTree::group * groups[g];
            const Floats x = load(balls.x + first) - x0, y = load(balls.y + first) - y0;
            const Floats z = load(balls.z + first) - z0;
            const Floats touch = load(balls.radius + first) + room;
            found |= (x * x + y * y + z * z <= touch * touch) & bits;
            bits <<= floatLanes;
        }
        std::uint32_t left = bitsOf(found);
        for (std::size_t g = from; left != 0; ++g, left >>= floatLanes) {
            const auto first = std::int32_t(BoxTree::group * groups[g]);
            for (std::uint32_t some = left & 255; some != 0; some &= some - 1) {
                const std::int32_t j = first + __builtin_ctz(some);
                near[count] = j;
                count += j != own;
            }
        }
    }
    return count;
}

/// The caps of balls near a ball as floats.
struct RoundedCaps {
    CapLists& all;        ///< room for all of the balls
    CapLists& sorted;     ///< the large ones first; as much room
    std::int32_t* places; ///< of the sorted ones among the balls
    std::int32_t* sizes;  ///< of all balls; room for eight more
};

/// Finds the caps of balls that meet a ball, by a counting sort. They are known well if the centres
/// are not near, the balls not much larger, and the caps not nearly all of the sphere; of others
/// the sine is -1.
/// @param[in] near   the balls; they are not equal to the ball itself
/// @param[in] error  of a cosine; what is sorted is no larger than the cap
/// @return how many of the caps leave out those that are small or not known
MOLSURF_KERNEL std::size_t roundCaps(const RoundedBalls& balls, std::int32_t own,
                                     const std::vector<std::int32_t>& near, float error,
                                     const RoundedCaps& caps)
{
    constexpr float steps = 20.0f; // a cosine
    constexpr std::int32_t small = 39, unknown = 41, apart = 42, ends = 44;
    const float r = balls.radius[own], x0 = balls.x[own], y0 = balls.y[own], z0 = balls.z[own];
    const std::size_t count = near.size();
    const std::int32_t* j = near.data();
    float* __restrict x = caps.all.x.data(), * __restrict y = caps.all.y.data();
    float* __restrict z = caps.all.z.data(), * __restrict cosine = caps.all.cosine.data();
    float* __restrict sine = caps.all.sine.data();
    for (std::size_t k = 0; k < count; ++k) {
        x[k] = balls.x[j[k]] - x0;
        y[k] = balls.y[j[k]] - y0;
        z[k] = balls.z[j[k]] - z0;
        sine[k] = balls.radius[j[k]];
    }
    for (std::size_t k = 0; k < count; k += floatLanes) {
        const Floats dx = load(x + k), dy = load(y + k), dz = load(z + k), R = load(sine + k);
        const Floats distance2 = dx * dx + dy * dy + dz * dz;
        const Floats inverse = 1.0f / squareRoot(distance2);
        const Floats c = (distance2 + (r - R) * (r + R)) * inverse * (0.5f / r) + error;
        const Ints known = (inverse * r < 4.0f) & (R < 8.0f * r) & (c >= -0.99f);
        const Ints meets = c <= 1.0f + 2.0f * error;
        const Floats root = squareRoot(larger((1.0f - c) * (1.0f + c), splat(0.0f)));
        const Ints size = truncated(clamped(steps * (c + 1.0f), splat(0.0f), splat(40.0f)));
        store(x + k, dx * inverse);
        store(y + k, dy * inverse);
        store(z + k, dz * inverse);
        store(cosine + k, known ? c : splat(3.0f));
        store(sine + k, known ? root : splat(-1.0f));
        store(caps.sizes + k, known ? (meets ? size : splat(apart)) : splat(unknown));
    }
    std::int32_t begins[ends] = {};
    const std::int32_t* sizes = caps.sizes;
    std::int32_t* places = caps.places;
    for (std::size_t k = 0; k < count; ++k) ++begins[sizes[k] + 1];
    for (std::int32_t size = 1; size < ends; ++size) begins[size] += begins[size - 1];
    const auto large = std::size_t(begins[small]), met = std::size_t(begins[apart]);
    for (std::size_t k = 0; k < count; ++k) places[begins[sizes[k]]++] = std::int32_t(k);
    caps.sorted.resize(met);
    for (std::size_t n = 0; n < met; ++n) {
        const auto k = std::size_t(places[n]);
        caps.sorted.x[n] = x[k];
        caps.sorted.y[n] = y[k];
        caps.sorted.z[n] = z[k];
        caps.sorted.cosine[n] = cosine[k];
        caps.sorted.sine[n] = sine[k];
    }
    return large;
}

/// Ways to balls; their radii stand in place of the sines.
/// @param[in] from  ways from the first ball
MOLSURF_KERNEL void takeWays(const std::vector<PlacedBall>& balls, std::int32_t own,
                             const std::int32_t* near, std::size_t count, const Ways& from,
                             CapArrays& to)
{
    const double *x = from[0].data(), *y = from[1].data(), *z = from[2].data();
    double* __restrict toX = to.x.data(), * __restrict toY = to.y.data();
    double* __restrict toZ = to.z.data(), * __restrict radius = to.sine.data();
    for (std::size_t k = 0; k < count; ++k) {
        const std::int32_t j = near[k];
        toX[k] = x[j] - x[own];
        toY[k] = y[j] - y[own];
        toZ[k] = z[j] - z[own];
        radius[k] = balls[std::size_t(j)].radius;
    }
}

enum : std::int32_t {
    apart = int(Relation::Apart),
    meeting = int(Relation::Meeting),
    around = int(Relation::Around),
    unsure = around + 1
};

constexpr std::int32_t bins = 64;

/// The place of a cap's cosine among equal parts of [-1, 1).
MOLSURF_INLINE std::int32_t binOf(double cosine)
{
    const double place = (cosine + 1.0) * 0.5 * bins;
    return place < bins ? std::int32_t(place) : bins - 1;
}

/// relate() for many balls in doubles: `unsure` where rounding may decide.
/// @param[in,out] x,y,z  ways to their centres; made unit vectors
/// @return the bits of all relations
MOLSURF_KERNEL std::int32_t relateAll(double r, std::size_t count, const double* __restrict radius,
                                      double* __restrict x, double* __restrict y,
                                      double* __restrict z, double* __restrict cosine,
                                      std::int32_t* __restrict relation)
{
    constexpr double rounding = 1e-14, most = 1.0 - 0x1p-53;
    for (std::size_t k = 0; k < count; ++k) {
        const double R = radius[k], sum = r + R, difference = R - r;
        const double distance2 = x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
        const double outer = distance2 - sum * sum, inner = distance2 - difference * difference;
        const double distance = std::sqrt(distance2);
        const double c = (distance2 - difference * sum) / (2.0 * distance * r);
        cosine[k] = c < -most ? -most : c > most ? most : c;
        x[k] /= distance;
        y[k] /= distance;
        z[k] /= distance;
        const bool known = (std::abs(outer) > rounding * (distance2 + sum * sum)) &
                           (std::abs(inner) > rounding * (distance2 + difference * difference));
        const std::int32_t within = difference > 0.0 ? around : apart;
        const std::int32_t met = inner > 0.0 ? meeting : within;
        relation[k] = known ? (outer < 0.0 ? met : apart) : unsure;
    }
    std::int32_t seen = 0;
    for (std::size_t k = 0; k < count; ++k) seen |= relation[k];
    return seen;
}

/// The sines of caps, and their places in the order of their sizes.
MOLSURF_KERNEL void findSines(std::size_t count, const double* __restrict cosine,
                              double* __restrict sine, std::int32_t* __restrict bin)
{
    for (std::size_t k = 0; k < count; ++k) {
        sine[k] = std::sqrt((1.0 - cosine[k]) * (1.0 + cosine[k]));
        bin[k] = binOf(cosine[k]);
    }
}

/// Fills in CapArrays::rounded.
MOLSURF_KERNEL void roundAll(std::size_t count, CapArrays& caps)
{
    for (std::size_t k = 0; k < count; ++k) {
        caps.rounded.x[k] = float(caps.x[k]);
        caps.rounded.y[k] = float(caps.y[k]);
        caps.rounded.z[k] = float(caps.z[k]);
        caps.rounded.cosine[k] = float(caps.cosine[k]);
        caps.rounded.sine[k] = float(caps.sine[k]);
    }
}

bool isLarger(const Cap& a, const Cap& b)
{
    return a.cosine != b.cosine ? a.cosine < b.cosine : a.other < b.other;
}

std::vector<Box> boxesOf(const std::vector<PlacedBall>& balls)
{
    std::vector<Box> out;
    out.reserve(balls.size());
    for (const PlacedBall& ball : balls) out.push_back(Box::about(ball.centre(), ball.radius));
    return out;
}

} // namespace

CapFinder::CapFinder(const std::vector<PlacedBall>& balls)
    : balls_(balls), tree_(boxesOf(balls)), dense_(balls)
{
    const std::size_t padded =
        (balls.size() + BoxTree::group - 1) / BoxTree::group * BoxTree::group;
    for (auto* v : {&x_, &y_, &z_}) v->resize(padded, 1e15f); // near nothing
    radius_.resize(padded);
    // Ways from one ball to others are those of any two, as long as all lie within 2000 Å.
    bool exact = true;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3d way = offset(balls.front(), balls[i]);
        exact =
            exact && std::max({std::abs(way.x()), std::abs(way.y()), std::abs(way.z())}) < 2000.0;
        x_[i] = float(way.x());
        y_[i] = float(way.y());
        z_[i] = float(way.z());
        radius_[i] = float(balls[i].radius);
    }
    for (std::size_t a = 0; exact && a < 3; ++a) {
        ways_[a].reserve(balls.size());
        for (const PlacedBall& ball : balls)
            ways_[a].push_back(offset(balls.front(), ball)[int(a)]);
    }
}

double CapFinder::roundingOf(std::int32_t i) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const Vec3d way = offset(balls_.front(), ball);
    return 1e-6 * (1.0 + ball.radius + std::abs(way.x()) + std::abs(way.y()) + std::abs(way.z()));
}

/// Finds the relations of balls to a ball, and the caps of those that meet it, but for their
/// floats.
/// @return false if one lies around it
bool CapFinder::relate(std::int32_t i, const std::int32_t* near, std::size_t count, Scratch& s,
                       CapArrays& caps) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const auto grow = [&](auto& list) { list.resize(std::max(list.size(), count)); };
    grow(s.relation);
    grow(s.bin);
    caps.resize(count);
    std::copy_n(near, count, caps.other.begin());
    for (std::size_t k = 0; k < count && ways_[0].empty(); ++k) {
        const Vec3d way = offset(ball, balls_[std::size_t(near[k])]);
        caps.x[k] = way.x();
        caps.y[k] = way.y();
        caps.z[k] = way.z();
        caps.sine[k] = balls_[std::size_t(near[k])].radius;
    }
    if (!ways_[0].empty()) takeWays(balls_, i, near, count, ways_, caps);
    const std::int32_t seen =
        relateAll(ball.radius, count, caps.sine.data(), caps.x.data(), caps.y.data(), caps.z.data(),
                  caps.cosine.data(), s.relation.data());
    for (std::size_t k = 0; k < count && (seen & around) != 0; ++k) {
        if (s.relation[k] == around) return false;
        if (s.relation[k] != unsure) continue;
        Cap cap;
        const Relation relation = molsurf::relate(ball, balls_[std::size_t(near[k])], near[k], cap);
        s.relation[k] = std::int32_t(relation);
        if (relation == Relation::Around) return false;
        if (relation != Relation::Meeting) continue;
        caps.x[k] = cap.axis.x();
        caps.y[k] = cap.axis.y();
        caps.z[k] = cap.axis.z();
        caps.cosine[k] = cap.cosine;
    }
    findSines(count, caps.cosine.data(), caps.sine.data(), s.bin.data());
    return true;
}

/// Finds the caps of the balls that meet a ball.
/// @return false if one lies around it
bool CapFinder::gather(std::int32_t i, Scratch& s, CapArrays& caps) const
{
    const std::size_t count = s.near.size();
    if (!relate(i, s.near.data(), count, s, s.all)) return false;
    // Large caps first, since they cover most: a counting sort by cosines in 64 bins.
    std::array<std::int32_t, bins + 1> begins{};
    for (std::size_t k = 0; k < count; ++k)
        begins[std::size_t(s.bin[k]) + 1] += s.relation[k] == meeting;
    for (std::size_t b = 0; b < std::size_t(bins); ++b) begins[b + 1] += begins[b];
    caps.resize(std::size_t(begins[bins]));
    for (std::size_t k = 0; k < count; ++k)
        if (s.relation[k] == meeting)
            caps.set(std::size_t(begins[std::size_t(s.bin[k])]++), s.all[int(k)]);
    return true;
}

/// Finds the balls that touch a ball.
/// @return false if they are very many
bool CapFinder::findNear(std::int32_t i, Scratch& s) const
{
    const auto boxOf = [&](std::int32_t j) {
        return Box::about(balls_[std::size_t(j)].centre(),
                          balls_[std::size_t(j)].radius + roundingOf(j));
    };
    const auto size = std::int32_t(BoxTree::group);
    if (s.block != i / size) { // consecutive balls are near each other
        s.block = i / size;
        Box all = boxOf(i);
        for (std::int32_t j = s.block * size;
             j < std::min((s.block + 1) * size, int(balls_.size())); ++j) {
            all.low = openvdb::math::minComponent(all.low, boxOf(j).low);
            all.high = openvdb::math::maxComponent(all.high, boxOf(j).high);
        }
        tree_.findOctets(all, s.octets);
    }
    s.groups.clear();
    tree_.forEachNear(boxOf(i), s.octets, [&](std::size_t g) { s.groups.push_back(g); });
    constexpr std::size_t most = 8 * dense; // more candidates are not even looked at one by one
    const std::size_t candidates = BoxTree::group * s.groups.size();
    if (candidates > most) return false;
    s.touching.resize(std::max(s.touching.size(), candidates));
    const double room = balls_[std::size_t(i)].radius + roundingOf(i);
    const std::size_t count =
        findTouching(rounded(), s.groups, i, float(1.000001 * room), s.touching.data());
    s.near.assign(s.touching.begin(), s.touching.begin() + std::ptrdiff_t(count));
    return count < dense; // the ball itself counts, too
}

/// Keeps, by floats, the balls near a ball whose caps do not lie within others.
/// @return whether these surely cover all of its sphere, or some of them, which are kept then
bool CapFinder::keepNear(std::int32_t i, Scratch& s) const
{
    // The way between two places has an error of 2^-22 of these, a quarter of roundingOf(). With
    // centres that are r/4 apart, at least, axes have an error below 8 times that over r, cosines
    // below 5 times; and their own rounding.
    const double relative = 0.25 * roundingOf(i) / balls_[std::size_t(i)].radius;
    const auto ofCosine = float(5.0 * relative + 2e-6), ofAxis = float(8.0 * relative + 3e-6);
    const std::size_t count = s.near.size();
    s.all.rounded.resize(count);
    s.met.resize(count);
    for (auto* list : {&s.places, &s.kept, &s.bin})
        list->resize(std::max(list->size(), count + floatLanes));
    const std::size_t large = roundCaps(rounded(), i, s.near, ofCosine,
                                        {s.all.rounded, s.met, s.places.data(), s.bin.data()});
    const bool isHidden = isSphereSurelyCovered(s.met, large, ofAxis);
    std::size_t kept =
        isHidden ? large : keepCaps(s.met, 2.0f * ofCosine, 2.0f * ofAxis, s.kept.data());
    s.isKept.assign(count, 0);
    for (std::size_t n = 0; n < kept; ++n)
        s.isKept[std::size_t(s.places[isHidden ? n : std::size_t(s.kept[n])])] = 1;
    kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
        s.near[kept] = s.near[k];
        kept += s.isKept[k];
    }
    s.near.resize(kept);
    return isHidden;
}

Exposure CapFinder::find(std::int32_t i, Scratch& s, CapArrays& caps) const
{
    const bool amongMany = !findNear(i, s);
    if (amongMany) {
        if (!dense_.find(i, s.found)) return {false, true, false};
        std::sort(s.found.begin(), s.found.end(), isLarger);
        const std::size_t count = s.found.size();
        s.met.resize(count);
        s.kept.resize(std::max(s.kept.size(), count));
        for (std::size_t n = 0; n < count; ++n) s.met.set(n, s.found[n]);
        caps.resize(keepCaps(s.met, 0.0f, heldMargin, s.kept.data()));
        for (int n = 0; n < caps.size(); ++n)
            caps.set(std::size_t(n), s.found[std::size_t(s.kept[std::size_t(n)])]);
    } else {
        if (keepNear(i, s)) return {true, false, true};
        if (!gather(i, s, caps)) return {false, false, false};
    }
    roundAll(std::size_t(caps.size()), caps);
    return {true, amongMany, false};
}

void CapFinder::findAgain(std::int32_t i, const std::int32_t* others, std::size_t count, Scratch& s,
                          CapArrays& caps) const
{
    relate(i, others, count, s, caps);
    roundAll(count, caps);
}

} // namespace molsurf
