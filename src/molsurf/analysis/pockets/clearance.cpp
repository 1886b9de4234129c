// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/clearance.h"

#include "molsurf/kernel/core/orthonormal_basis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// How exact touching is taken [Å]: far above what rounding does to places within 1e6 Å.
constexpr double touching = 1e-8;

/// A ball as a plane sees it: where its centre is over the plane, and how far above.
struct Seen {
    double a, b, height, radius;
};

Seen seenFrom(const Plane& plane, const Ball& ball)
{
    const Vec3d way = ball.center - plane.origin;
    return {way.dot(plane.along[0]), way.dot(plane.along[1]), way.dot(plane.normal), ball.radius};
}

double cross(const std::array<double, 2>& x, const std::array<double, 2>& y)
{
    return x[0] * y[1] - x[1] * y[0];
}

/// Whether a ball that touches three others cannot grow by moving in the plane: the directions to
/// it from their centres, seen in the plane, leave no side free. From each to the next they then
/// turn the same way.
bool isHeld(const std::array<Seen, 3>& seen, double a, double b)
{
    constexpr double flat = 1e-9; // of two directions, for the middle of four balls and the like
    std::array<std::array<double, 2>, 3> way;
    for (std::size_t i = 0; i < 3; ++i) way[i] = {a - seen[i].a, b - seen[i].b};
    double least = 0.0, most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &p = way[i], &q = way[(i + 1) % 3];
        const double turn = cross(p, q) / (std::hypot(p[0], p[1]) * std::hypot(q[0], q[1]) + 1e-30);
        least = std::min(least, turn);
        most = std::max(most, turn);
    }
    return least > -flat || most < flat;
}

/// The roots of p x^2 + 2 q x + s = 0, without loss of digits.
std::array<double, 2> rootsOf(double p, double q, double s)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const double d = q * q - p * s;
    if (!(d >= 0.0)) return {none, none};
    const double t = -(q + std::copysign(std::sqrt(d), q));
    return {p != 0.0 ? t / p : none, t != 0.0 ? s / t : none};
}

/// Calls f(a, b, R) for the balls of radius R with their centres in the plane that touch three
/// others from outside: (a - a_i)^2 + (b - b_i)^2 + h_i^2 = (R + r_i)^2. Their differences are
/// linear in a, b and R, so that (a, b) = p + q R, and what is left is a quadratic in R.
template<typename F>
void forEachTouching(const std::array<Seen, 3>& seen, const F& f)
{
    const Seen& o = seen[0];
    double m[2][2], grow[2], fixed[2];
    for (std::size_t i = 0; i < 2; ++i) {
        const Seen& s = seen[i + 1];
        m[i][0] = s.a - o.a;
        m[i][1] = s.b - o.b;
        grow[i] = o.radius - s.radius;
        fixed[i] = 0.5 * (m[i][0] * m[i][0] + m[i][1] * m[i][1] +
                          (s.height - o.height) * (s.height + o.height) +
                          (o.radius - s.radius) * (o.radius + s.radius));
    }
    const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    const double size = std::hypot(m[0][0], m[0][1]) * std::hypot(m[1][0], m[1][1]);
    if (!(std::abs(det) > 1e-9 * size)) return; // they hold nothing between them
    const auto solve = [&](const double* v, double& x, double& y) {
        x = (v[0] * m[1][1] - v[1] * m[0][1]) / det;
        y = (m[0][0] * v[1] - m[1][0] * v[0]) / det;
    };
    double pa, pb, qa, qb;
    solve(fixed, pa, pb);
    solve(grow, qa, qb);
    for (const double R : rootsOf(qa * qa + qb * qb - 1.0, pa * qa + pb * qb - o.radius,
                                  pa * pa + pb * pb + o.height * o.height - o.radius * o.radius)) {
        const auto isOutside = [&](const Seen& s) { return R + s.radius >= 0.0; };
        if (std::isfinite(R) && std::all_of(seen.begin(), seen.end(), isOutside))
            f(o.a + pa + qa * R, o.b + pb + qb * R, R);
    }
}

/// Calls f(triple) for all triples of some things.
template<typename F>
void forEachTriple(const std::vector<std::int32_t>& of, const F& f)
{
    for (std::size_t i = 0; i < of.size(); ++i)
        for (std::size_t j = i + 1; j < of.size(); ++j)
            for (std::size_t k = j + 1; k < of.size(); ++k) f({of[i], of[j], of[k]});
}

} // namespace

Plane::Plane(const Vec3d& point, const Vec3d& unitNormal)
    : origin(point), normal(unitNormal), along(perpendicular(unitNormal))
{
}

Clearance::Clearance(const std::vector<Ball>& balls) : balls_(balls), index_(balls, {1.0, 0.0, 3.0})
{
}

double Clearance::at(const Vec3d& x) const
{
    double best = std::numeric_limits<double>::infinity();
    double gap = 1.0;
    do { // until no ball that was not looked at can be nearer
        gap *= 2.0;
        index_.forEachNear(x, x, gap, [&](const Ball& ball, std::int32_t) {
            best = std::min(best, (x - ball.center).length() - ball.radius);
        });
    } while (best > gap);
    return best;
}

std::vector<std::int32_t> Clearance::nearest(const Vec3d& x, double slack) const
{
    std::vector<std::pair<double, std::int32_t>> near;
    const double most = at(x) + slack;
    index_.forEachNear(x, x, std::max(most, 0.0), [&](const Ball& ball, std::int32_t i) {
        const double distance = (x - ball.center).length() - ball.radius;
        if (distance <= most) near.emplace_back(distance, i);
    });
    std::sort(near.begin(), near.end());
    std::vector<std::int32_t> out;
    for (const auto& [distance, i] : near) out.push_back(i);
    return out;
}

double Clearance::leastNear(const Vec3d& x, const std::vector<std::int32_t>& balls) const
{
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : balls) {
        const Ball& ball = balls_[std::size_t(i)];
        least = std::min(least, (x - ball.center).length() - ball.radius);
    }
    return least;
}

std::optional<FittedBall> Clearance::widestIn(const Plane& plane, const Vec3d& x,
                                              double reach) const
{
    // f changes by no more than the way, so a ball within reach touches none that is farther.
    const std::vector<std::int32_t> near = nearest(x, 2.0 * reach + touching);
    std::optional<FittedBall> best;
    forEachTriple(near, [&](const std::array<std::int32_t, 3>& triple) {
        std::array<Seen, 3> seen;
        for (std::size_t i = 0; i < 3; ++i)
            seen[i] = seenFrom(plane, balls_[std::size_t(triple[i])]);
        forEachTouching(seen, [&](double a, double b, double radius) {
            if (best && radius <= best->radius) return;
            const Vec3d place = plane.at(a, b);
            if ((place - x).length() > reach || !isHeld(seen, a, b)) return;
            if (leastNear(place, near) >= radius - touching) best = FittedBall{place, radius};
        });
    });
    return best;
}

std::optional<FittedBall> Clearance::neckNear(const Vec3d& x, double reach, double most) const
{
    const std::vector<std::int32_t> near = nearest(x, 2.0 * reach + touching);
    std::optional<FittedBall> best;
    double nearestWay = reach;
    forEachTriple(near, [&](const std::array<std::int32_t, 3>& triple) {
        const auto centre = [&](std::size_t i) { return balls_[std::size_t(triple[i])].center; };
        Vec3d normal = (centre(1) - centre(0)).cross(centre(2) - centre(0));
        if (!(normal.normalize(1e-6))) return; // on a line
        const Plane plane(centre(0), normal);
        if (std::abs((x - plane.origin).dot(normal)) > nearestWay) return;
        std::array<Seen, 3> seen;
        for (std::size_t i = 0; i < 3; ++i)
            seen[i] = seenFrom(plane, balls_[std::size_t(triple[i])]);
        forEachTouching(seen, [&](double a, double b, double radius) {
            const Vec3d place = plane.at(a, b);
            const double way = (place - x).length();
            if (way > nearestWay || radius > most || !isHeld(seen, a, b)) return;
            if (leastNear(place, near) < radius - touching) return;
            best = FittedBall{place, radius};
            nearestWay = way;
        });
    });
    return best;
}

} // namespace molsurf
