// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_caps.h"

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
MOLSURF_KERNEL bool isCapCovered(const Vec3f& axis, float cosine, float sine, const CapLists& caps)
{
    const int count = caps.size();
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
    const double distance = std::sqrt(distance2);
    constexpr double most = 1.0 - 0x1p-53; // rounding must not make it 1
    const double cosine = (distance2 + (r - R) * (r + R)) / (2.0 * distance * r);
    cap = {way / distance, std::clamp(cosine, -most, most), j};
    return Relation::Meeting;
}

void CapArrays::clear()
{
    for (auto* v : {&x, &y, &z, &cosine, &sine}) v->clear();
    other.clear();
    rounded.clear();
}

void CapArrays::add(const Vec3d& axis, double capCosine, double capSine, std::int32_t ball)
{
    x.push_back(axis.x());
    y.push_back(axis.y());
    z.push_back(axis.z());
    cosine.push_back(capCosine);
    sine.push_back(capSine);
    other.push_back(ball);
    rounded.add(float(axis.x()), float(axis.y()), float(axis.z()), float(capCosine),
                float(capSine));
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
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3d centre = balls[i].centre();
        x_[i] = float(centre.x());
        y_[i] = float(centre.y());
        z_[i] = float(centre.z());
        radius_[i] = float(balls[i].radius);
    }
}

/// Finds the balls that meet a ball, in the order of their caps.
/// @return false if one lies around it
bool CapFinder::gather(std::int32_t i, Scratch& s) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    for (auto* v : {&s.wayX, &s.wayY, &s.wayZ, &s.radius, &s.cosine}) v->resize(s.near.size());
    s.relation.resize(s.near.size());
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        const PlacedBall& other = balls_[std::size_t(s.near[k])];
        const Vec3d way = offset(ball, other);
        s.wayX[k] = way.x();
        s.wayY[k] = way.y();
        s.wayZ[k] = way.z();
        s.radius[k] = other.radius;
    }
    relateAll(ball.radius, s.near.size(), s.radius.data(), s.wayX.data(), s.wayY.data(),
              s.wayZ.data(), s.cosine.data(), s.relation.data());

    // Large caps first, since they hold most of the others: a counting sort by cosines in 64 bins.
    constexpr std::size_t bins = 64;
    const auto binOf = [&](std::size_t k) {
        return std::min(std::size_t((s.cosine[k] + 1.0) * 0.5 * bins), bins - 1);
    };
    std::array<std::int32_t, bins + 1> begins{};
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        if (s.near[k] == i) {
            s.relation[k] = apart;
        } else if (s.relation[k] == unsure) {
            Cap cap;
            const auto j = std::size_t(s.near[k]);
            const Relation relation = relate(ball, balls_[j], std::int32_t(j), cap);
            s.relation[k] = std::int32_t(relation);
            if (relation == Relation::Meeting) {
                s.wayX[k] = cap.axis.x();
                s.wayY[k] = cap.axis.y();
                s.wayZ[k] = cap.axis.z();
                s.cosine[k] = cap.cosine;
            }
        }
        if (s.relation[k] == around) return false;
        if (s.relation[k] == meeting) ++begins[binOf(k) + 1];
    }
    for (std::size_t b = 0; b < bins; ++b) begins[b + 1] += begins[b];
    s.order.resize(std::size_t(begins[bins]));
    for (std::size_t k = 0; k < s.near.size(); ++k) {
        if (s.relation[k] == meeting) s.order[std::size_t(begins[binOf(k)]++)] = std::int32_t(k);
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
        s.near.resize(BoxTree::group * s.groups.size());
        s.near.resize(
            std::size_t(findTouching({x_.data(), y_.data(), z_.data(), radius_.data()}, s.groups,
                                     Vec3f(centre), float(1.000001 * room), s.near.data())));
        amongMany = s.near.size() > dense;
    }
    caps.clear();
    const auto add = [&](const Vec3d& axis, double cosine, std::int32_t other) {
        const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
        if (!isCapCovered(Vec3f(axis), float(cosine), float(sine), caps.rounded))
            caps.add(axis, cosine, sine, other);
    };
    if (amongMany) {
        if (!dense_.find(i, s.found)) return {false, true};
        std::sort(s.found.begin(), s.found.end(), isLarger);
        for (const Cap& cap : s.found) add(cap.axis, cap.cosine, cap.other);
    } else {
        if (!gather(i, s)) return {false, false};
        for (const std::int32_t n : s.order) {
            const auto k = std::size_t(n);
            add({s.wayX[k], s.wayY[k], s.wayZ[k]}, s.cosine[k], s.near[k]);
        }
    }
    return {true, amongMany};
}

} // namespace molsurf
