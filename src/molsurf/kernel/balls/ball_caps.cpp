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

/// Whether a cap lies within one of some that are no smaller.
/// @param[in] count  of these; what follows in the lists covers nothing
MOLSURF_KERNEL bool isCapCovered(const Vec3f& axis, float cosine, float sine, const CapLists& caps,
                                 int count)
{
    for (int k = 0; k < count; k += floatLanes) {
        const Floats between = axis.x() * load(caps.x.data() + k) +
                               axis.y() * load(caps.y.data() + k) +
                               axis.z() * load(caps.z.data() + k);
        // The cosine of the difference of the half angles; padding has a cosine above all others.
        const Floats difference =
            cosine * load(caps.cosine.data() + k) + sine * load(caps.sine.data() + k);
        if (any((between >= difference + heldMargin) & (load(caps.cosine.data() + k) <= cosine)))
            return true;
    }
    return false;
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

void CapArrays::makeRoom(std::size_t count)
{
    shrink(count);
    rounded.makeRoom(count);
}

void CapArrays::shrink(std::size_t count)
{
    for (auto* v : {&x, &y, &z, &cosine, &sine}) v->resize(count);
    other.resize(count);
    rounded.resize(count);
}

namespace
{

/// Rounding of places and radii to floats [Å].
double roundingAt(const Vec3d& x, double radius)
{
    return 1e-6 * (1.0 + radius + std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()));
}

/// Some of the balls, as floats.
struct RoundedBalls {
    const float *x, *y, *z, *radius;
};

/// Finds the balls of groups of eight that may touch a ball.
/// @param[in]  room  the radius, and more
/// @param[out] near  their numbers; room for all of the groups
MOLSURF_KERNEL int findTouching(const RoundedBalls& balls, const std::vector<std::size_t>& groups,
                                const Vec3f& centre, float room, std::int32_t* near)
{
    int count = 0;
    for (const std::size_t g : groups) {
        const std::size_t first = BoxTree::group * g;
        const Floats x = load(balls.x + first) - centre.x(), y = load(balls.y + first) - centre.y();
        const Floats z = load(balls.z + first) - centre.z();
        const Floats touch = load(balls.radius + first) + room;
        const Ints within = x * x + y * y + z * z <= touch * touch;
        for (std::uint32_t bits = bitsOf(within & (splat(1) << laneNumbers())); bits != 0;
             bits &= bits - 1)
            near[count++] = std::int32_t(first) + __builtin_ctz(bits);
    }
    return count;
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
MOLSURF_KERNEL void relateAll(double r, std::size_t count, const double* __restrict radius,
                              double* __restrict x, double* __restrict y, double* __restrict z,
                              double* __restrict cosine, std::int32_t* __restrict relation)
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

double sineOf(const Cap& cap)
{
    return std::sqrt((1.0 - cap.cosine) * (1.0 + cap.cosine));
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
    const auto isExact = [&](const PlacedBall& ball) {
        const Vec3d way = offset(balls.front(), ball);
        return std::max({std::abs(way.x()), std::abs(way.y()), std::abs(way.z())}) < 2000.0;
    };
    if (std::all_of(balls.begin(), balls.end(), isExact))
        for (const PlacedBall& ball : balls) fromFirst_.push_back(offset(balls.front(), ball));
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3d centre = balls[i].centre();
        x_[i] = float(centre.x());
        y_[i] = float(centre.y());
        z_[i] = float(centre.z());
        radius_[i] = float(balls[i].radius);
    }
}

/// Finds the relations of the balls in scratch.near to a ball.
void CapFinder::relateNear(std::int32_t i, Scratch& s) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const auto grow = [&](auto& list) { list.resize(std::max(list.size(), s.near.size())); };
    for (auto* v : {&s.wayX, &s.wayY, &s.wayZ, &s.radius, &s.cosine, &s.sine}) grow(*v);
    grow(s.relation);
    grow(s.bin);
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        const auto j = std::size_t(s.near[k]);
        const PlacedBall& other = balls_[j];
        const Vec3d way =
            fromFirst_.empty() ? offset(ball, other) : fromFirst_[j] - fromFirst_[std::size_t(i)];
        s.wayX[k] = way.x();
        s.wayY[k] = way.y();
        s.wayZ[k] = way.z();
        s.radius[k] = other.radius;
    }
    relateAll(ball.radius, s.near.size(), s.radius.data(), s.wayX.data(), s.wayY.data(),
              s.wayZ.data(), s.cosine.data(), s.relation.data());
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        if (s.relation[k] != unsure || s.near[k] == i) continue;
        Cap cap;
        const std::int32_t j = s.near[k];
        const Relation relation = relate(ball, balls_[std::size_t(j)], j, cap);
        s.relation[k] = std::int32_t(relation);
        if (relation != Relation::Meeting) continue;
        s.wayX[k] = cap.axis.x();
        s.wayY[k] = cap.axis.y();
        s.wayZ[k] = cap.axis.z();
        s.cosine[k] = cap.cosine;
    }
    findSines(s.near.size(), s.cosine.data(), s.sine.data(), s.bin.data());
}

/// Finds the balls that meet a ball, in the order of their caps.
/// @return false if one lies around it
bool CapFinder::gather(std::int32_t i, Scratch& s) const
{
    relateNear(i, s);
    // Large caps first, since they hold most of the others: a counting sort by cosines in 64 bins.
    std::array<std::int32_t, bins + 1> begins{};
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        if (s.near[k] == i) s.relation[k] = apart;
        if (s.relation[k] == around) return false;
        if (s.relation[k] == meeting) ++begins[std::size_t(s.bin[k]) + 1];
    }
    for (std::size_t b = 0; b < std::size_t(bins); ++b) begins[b + 1] += begins[b];
    s.order.resize(std::size_t(begins[bins]));
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        if (s.relation[k] != meeting) continue;
        std::int32_t& place = begins[std::size_t(s.bin[k])];
        s.order[std::size_t(place++)] = std::int32_t(k);
    }
    return true;
}

Exposure CapFinder::find(std::int32_t i, Scratch& s, CapArrays& caps) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const Vec3d centre = ball.centre();
    const double room = ball.radius + roundingAt(centre, ball.radius);
    s.groups.clear();
    tree_.forEachNear(Box::about(centre, room), [&](std::size_t g) { s.groups.push_back(g); });
    constexpr std::size_t most = 8 * dense; // more candidates are not even looked at one by one
    bool amongMany = BoxTree::group * s.groups.size() > most;
    if (!amongMany) {
        s.touching.resize(std::max(s.touching.size(), BoxTree::group * s.groups.size()));
        const int count = findTouching({x_.data(), y_.data(), z_.data(), radius_.data()}, s.groups,
                                       Vec3f(centre), float(1.000001 * room), s.touching.data());
        s.near.assign(s.touching.begin(), s.touching.begin() + count);
        amongMany = s.near.size() > dense;
    }
    std::size_t kept = 0;
    const auto add = [&](const Cap& cap, double sine) {
        if (!isCapCovered(Vec3f(cap.axis), float(cap.cosine), float(sine), caps.rounded, int(kept)))
            caps.set(kept++, cap, sine);
    };
    if (amongMany) {
        if (!dense_.find(i, s.found)) return {false, true, false};
        std::sort(s.found.begin(), s.found.end(), isLarger);
        caps.makeRoom(s.found.size());
        for (const Cap& cap : s.found) add(cap, sineOf(cap));
    } else {
        if (!gather(i, s)) return {false, false, false};
        s.met.makeRoom(s.order.size());
        for (std::size_t n = 0; n < s.order.size(); ++n) {
            const auto k = std::size_t(s.order[n]);
            s.met.set(n, s.capAt(k), s.sine[k]);
        }
        if (isSphereSurelyCovered(s.met)) return {true, false, true};
        caps.makeRoom(s.order.size());
        for (const std::int32_t k : s.order) add(s.capAt(std::size_t(k)), s.sine[std::size_t(k)]);
    }
    caps.shrink(kept);
    return {true, amongMany, false};
}

void CapFinder::findAgain(std::int32_t i, const std::int32_t* others, std::size_t count, Scratch& s,
                          CapArrays& caps) const
{
    s.near.assign(others, others + count);
    relateNear(i, s);
    caps.makeRoom(count);
    for (std::size_t k = 0; k < count; ++k) caps.set(k, s.capAt(k), s.sine[k]);
}

} // namespace molsurf
