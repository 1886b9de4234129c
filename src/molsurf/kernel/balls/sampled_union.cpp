// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/sampled_union.h"

#include "molsurf/kernel/balls/ball_index.h"

#include <openvdb/Types.h>

#include <cmath>
#include <unordered_set>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// A point of a ball or of its sphere.
struct Point {
    Vec3d x;
    std::size_t ball;
};

double fraction(double x)
{
    return x - std::floor(x);
}

/// Points spread over the spheres of balls, or within them, each ball by its share of the whole
/// area or volume, so that a large one among small ones is not missed. Directions and depths are
/// terms of additive recurrences, which leave no gaps.
/// @param[in]  power  2: on spheres; 3: within balls
/// @param[out] whole  sum of R^power over the balls
std::vector<Point> spread(const RepeatedBalls& balls, double grown, int power, std::size_t count,
                          double& whole)
{
    const auto weight = [&](const Ball& ball) {
        const double R = ball.radius + grown;
        return power == 2 ? R * R : R * R * R;
    };
    whole = 0.0;
    balls.forEach([&](const Ball& ball, std::size_t) { whole += weight(ball); });
    std::vector<Point> out;
    double below = 0.0;
    balls.forEach([&](const Ball& ball, std::size_t i) {
        below += weight(ball);
        while (out.size() < count && (double(out.size()) + 0.5) / double(count) * whole <= below) {
            const double k = double(out.size()) + 1.0;
            const double z = 1.0 - 2.0 * fraction(k * 0.8191725133961645);
            const double angle = 2.0 * M_PI * fraction(k * 0.6710436067037893);
            const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
            const double depth = power == 2 ? 1.0 : std::cbrt(fraction(k * 0.5497004779019703));
            out.push_back(
                {ball.center + (ball.radius + grown) * depth *
                                   Vec3d(across * std::cos(angle), across * std::sin(angle), z),
                 i});
        }
    });
    return out;
}

/// The balls that may hold one of some points: those of cells near these, and so a small part of
/// many.
struct Nearby {
    std::vector<Ball> balls;
    std::vector<std::size_t> numbers; ///< in the caller's balls
};

/// The balls, grown by so much, that may reach a point.
Nearby ballsNear(const RepeatedBalls& balls, double grown, const std::vector<Point>& points)
{
    const double edge = std::max(largestRadius(balls.distinct()) + grown, 1.0);
    const auto cellOf = [&](const Vec3d& x) { return Coord::floor(x / edge); };
    std::unordered_set<Coord> cells;
    for (const Point& point : points) {
        const Coord own = cellOf(point.x);
        for (int k = 0; k < 27; ++k)
            cells.insert(own.offsetBy(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1));
    }
    Nearby out;
    balls.forEach([&](const Ball& ball, std::size_t i) {
        if (cells.count(cellOf(Vec3d(ball.center))) == 0) return;
        out.balls.push_back(ball);
        out.numbers.push_back(i);
    });
    return out;
}

/// The mean over points of f(how many balls other than its own hold the point).
template<typename F>
double meanOf(const RepeatedBalls& balls, double grown, const std::vector<Point>& points,
              const F& f)
{
    const Nearby near = ballsNear(balls, grown, points);
    const BallIndex index(near.balls, {1.0, grown, 1.0});
    double sum = 0.0;
    for (const Point& point : points) {
        std::size_t others = 0;
        index.forEachNear(point.x, point.x, grown, [&](const Ball& ball, std::int32_t i) {
            const double R = ball.radius + grown;
            others += near.numbers[std::size_t(i)] != point.ball &&
                      (Vec3d(ball.center) - point.x).lengthSqr() < R * R;
        });
        sum += f(others);
    }
    return points.empty() ? 0.0 : sum / double(points.size());
}

} // namespace

double sampledArea(const RepeatedBalls& balls, double grown)
{
    double whole = 0.0;
    const std::vector<Point> points = spread(balls, grown, 2, 8192, whole);
    return 4.0 * M_PI * whole *
           meanOf(balls, grown, points, [](std::size_t n) { return n == 0 ? 1.0 : 0.0; });
}

double sampledVolume(const RepeatedBalls& balls, double grown)
{
    double whole = 0.0;
    const std::vector<Point> points = spread(balls, grown, 3, 2048, whole);
    return 4.0 / 3.0 * M_PI * whole *
           meanOf(balls, grown, points, [](std::size_t n) { return 1.0 / double(n + 1); });
}

} // namespace molsurf
