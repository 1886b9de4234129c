// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/ball_caps.h"

#include "molsurf/balls/quad.h"
#include "molsurf/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Room by which a cap has to lie within another one to be left out. Those that may just touch
/// stay.
constexpr double heldMargin = 1e-9;

/// With more balls near it than this, a ball is looked at by its power cell.
constexpr std::size_t dense = 800;

/// Whether a cap lies within one of some that are no smaller.
MOLSURF_KERNEL bool isCapCovered(const Cap& cap, double sine, const double* x, const double* y,
                                 const double* z, const double* cosine, const double* sines,
                                 int count)
{
    const double ax = cap.axis.x(), ay = cap.axis.y(), az = cap.axis.z();
    std::int64_t held = 0; // as wide as what is compared
    for (int k = 0; k < count; ++k) {
        const double between = ax * x[k] + ay * y[k] + az * z[k];           // the axes
        const double difference = cap.cosine * cosine[k] + sine * sines[k]; // of the half angles
        held |= between >= difference + heldMargin ? 1 : 0;
    }
    return held != 0;
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

namespace
{

std::vector<Ball> grownBalls(const std::vector<PlacedBall>& balls)
{
    std::vector<Ball> out;
    out.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        out.push_back({openvdb::Vec3f(balls[i].centre()), float(balls[i].radius), std::int32_t(i)});
    return out;
}

/// Rounding of places and radii to floats [Å].
double roundingAt(const Vec3d& x, double radius)
{
    return 1e-6 * (1.0 + radius + std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()));
}

bool isLarger(const Cap& a, const Cap& b)
{
    return a.cosine != b.cosine ? a.cosine < b.cosine : a.other < b.other;
}

} // namespace

CapFinder::CapFinder(const std::vector<PlacedBall>& balls)
    : balls_(balls), grown_(grownBalls(balls)), index_(grown_, {1.5, 0.0, 2.0}), dense_(balls)
{
}

bool CapFinder::gather(std::int32_t i, std::vector<Cap>& found) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const Vec3d centre = ball.centre();
    const double room = ball.radius + roundingAt(centre, ball.radius);
    bool hidden = false;
    found.clear();
    index_.forEachNear(centre, centre, room, [&](const Ball& other, std::int32_t j) {
        const double touch = room + double(other.radius);
        if (hidden || j == i || (Vec3d(other.center) - centre).lengthSqr() > touch * touch) return;
        Cap cap;
        const Relation relation = relate(ball, balls_[std::size_t(j)], j, cap);
        if (relation == Relation::Meeting) found.push_back(cap);
        hidden = relation == Relation::Around;
    });
    return !hidden;
}

Exposure CapFinder::find(std::int32_t i, Scratch& scratch, CapArrays& caps) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    const Vec3d centre = ball.centre();
    std::vector<Cap>& found = scratch.found;
    const std::size_t near = index_.countNear(centre, centre, ball.radius);
    const bool amongMany = near > dense;
    if (!(amongMany ? dense_.find(i, found) : gather(i, found))) return {false, amongMany};
    std::sort(found.begin(), found.end(), isLarger); // large ones hold most of the others
    caps.resize(found.size());
    std::size_t kept = 0;
    for (const Cap& cap : found) {
        const double sine = std::sqrt((1.0 - cap.cosine) * (1.0 + cap.cosine));
        if (!isCapCovered(cap, sine, caps.x.data(), caps.y.data(), caps.z.data(),
                          caps.cosine.data(), caps.sine.data(), int(kept)))
            caps.set(kept++, cap, sine);
    }
    caps.resize(kept);
    return {true, amongMany};
}

} // namespace molsurf
