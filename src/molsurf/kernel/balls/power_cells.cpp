// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/power_cells.h"

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/core/orthonormal_basis.h"
#include "molsurf/kernel/core/parallel.h"

#include <openvdb/Types.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec2d;
using openvdb::Vec3d;

namespace
{

/// A ball whose sphere meets that of another one, in coordinates about the centre of that one.
struct Neighbour {
    Vec3d offset;         ///< of its centre
    double distance;      ///< of the centres, > 0
    double height;        ///< x is in the other one's cell if x.offset <= height distance
    std::int32_t i;       ///< its index
    bool repeats = false; ///< it equals a neighbour of lower index
};

/// The neighbours of a ball, those with the nearest planes first.
/// @return false if the ball is within another one, or equals one of lower index
bool findNeighbours(const Ball& ball, std::int32_t i, const BallIndex& index,
                    std::vector<Neighbour>& out)
{
    out.clear();
    bool hidden = false;
    const Vec3d centre(ball.center);
    const double r = double(ball.radius);
    index.forEachNear(centre, centre, r, [&](const Ball& other, std::int32_t j) {
        const Vec3d offset = Vec3d(other.center) - centre;
        const double R = double(other.radius), d2 = offset.lengthSqr();
        if (j == i || d2 >= (r + R) * (r + R)) return;
        if (d2 <= (R - r) * (R - r)) {
            hidden = hidden || R > r || (R == r && j < i);
            return;
        }
        const double distance = std::sqrt(d2);
        out.push_back({offset, distance, 0.5 * (d2 + r * r - R * R) / distance, j});
    });
    std::sort(out.begin(), out.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.height < b.height || (a.height == b.height && a.i < b.i);
    });
    for (std::size_t n = 0; n < out.size(); ++n) {
        for (std::size_t m = n; m-- > 0 && out[m].height == out[n].height;) {
            out[n].repeats = out[n].repeats || out[m].offset == out[n].offset;
        }
    }
    return !hidden;
}

/// Sutherland-Hodgman: cuts off the part of a convex polygon where x.normal > limit.
void clip(std::vector<Vec2d>& polygon, const Vec2d& normal, double limit,
          std::vector<Vec2d>& scratch)
{
    scratch.clear();
    for (std::size_t a = 0; a < polygon.size(); ++a) {
        const Vec2d &p = polygon[a], &q = polygon[(a + 1) % polygon.size()];
        const double atP = p.dot(normal) - limit, atQ = q.dot(normal) - limit;
        if (atP <= 0.0) scratch.push_back(p);
        if ((atP < 0.0 && atQ > 0.0) || (atP > 0.0 && atQ < 0.0)) {
            scratch.push_back(p + (atP / (atP - atQ)) * (q - p));
        }
    }
    polygon.swap(scratch);
}

double angleBetween(const Vec2d& p, const Vec2d& q)
{
    return std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
}

/// The area that a disk about the origin and the triangle (0, p, q) share, positive if p, q turns
/// left.
double sectorArea(const Vec2d& p, const Vec2d& q, double radius)
{
    // The line p + t along meets the circle at t = from and t = to.
    const Vec2d along = q - p;
    const double a = along.lengthSqr(), b = p.dot(along), c = p.lengthSqr() - radius * radius;
    const double root = b * b - a * c, half = 0.5 * radius * radius;
    if (a == 0.0) return 0.0;
    if (root <= 0.0) return half * angleBetween(p, q);
    const double from = (-b - std::sqrt(root)) / a, to = (-b + std::sqrt(root)) / a;
    if (from >= 1.0 || to <= 0.0) return half * angleBetween(p, q);
    const Vec2d s = from > 0.0 ? p + from * along : p, t = to < 1.0 ? p + to * along : q;
    double area = 0.5 * (s.x() * t.y() - s.y() * t.x());
    if (from > 0.0) area += half * angleBetween(p, s);
    if (to < 1.0) area += half * angleBetween(t, q);
    return area;
}

double farthest(const std::vector<Vec2d>& polygon)
{
    double square = 0.0;
    for (const Vec2d& p : polygon) square = std::max(square, p.lengthSqr());
    return std::sqrt(square);
}

/// The area of the facet between a ball and a neighbour: the disk in which their spheres meet,
/// where neither of them is behind a third ball.
/// @param[in] others  all neighbours, in their order
double facetArea(double radius, const Neighbour& neighbour, const std::vector<Neighbour>& others,
                 std::vector<Vec2d>& polygon, std::vector<Vec2d>& scratch)
{
    const double height = neighbour.height, square = radius * radius - height * height;
    if (square <= 0.0) return 0.0;
    const double rim = std::sqrt(square);
    const Vec3d axis = neighbour.offset / neighbour.distance;
    const auto [e1, e2] = perpendicular(axis);
    polygon = {{-rim, -rim}, {rim, -rim}, {rim, rim}, {-rim, rim}};
    double reach = radius; // of the facet from the ball's centre: planes beyond it cut nothing off
    for (const Neighbour& other : others) {
        if (other.height >= reach) break;
        if (&other == &neighbour) continue;
        clip(polygon, {e1.dot(other.offset), e2.dot(other.offset)},
             other.height * other.distance - height * axis.dot(other.offset), scratch);
        if (polygon.empty()) return 0.0;
        const double wide = std::min(farthest(polygon), rim);
        reach = std::sqrt(height * height + wide * wide);
    }
    double area = 0.0;
    for (std::size_t a = 0; a < polygon.size(); ++a) {
        area += sectorArea(polygon[a], polygon[(a + 1) % polygon.size()], rim);
    }
    return std::max(area, 0.0);
}

/// Calls a function with each neighbour that a ball shares a facet with, and the facet's area.
/// @param[in] first  index from which on neighbours count
template<typename Visit>
void forEachFacet(const std::vector<Ball>& balls, const BallIndex& index, std::int32_t i,
                  std::int32_t first, const Visit& visit)
{
    const Ball& ball = balls[std::size_t(i)];
    std::vector<Neighbour> neighbours;
    if (!findNeighbours(ball, i, index, neighbours)) return;
    std::vector<Vec2d> polygon, scratch;
    for (const Neighbour& other : neighbours) {
        if (other.repeats || other.i < first) continue;
        const double area = facetArea(double(ball.radius), other, neighbours, polygon, scratch);
        if (area > 0.0) visit(other, area);
    }
}

} // namespace

PowerCells powerCells(const std::vector<Ball>& balls, const Progress& progress)
{
    PowerCells out;
    out.volumes.resize(balls.size());
    if (balls.empty()) return out;
    const BallBoundary boundary = ballBoundary(balls, 0.0, progress);
    const BoundaryMeasure measure = measureBoundary(boundary, progress);
    out.areas = areasOfBalls(boundary, measure, balls.size());
    const BallIndex index(balls, {1.0, 0.0, 1.0});

    struct Part {
        double flux = 0.0;
        std::vector<PowerFacet> facets;
    };
    std::vector<Part> parts(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t n) {
        const auto i = std::int32_t(n);
        Part& part = parts[n];
        part.flux = double(balls[n].radius) * out.areas[n];
        forEachFacet(balls, index, i, 0, [&](const Neighbour& other, double area) {
            part.flux += other.height * area;
            if (other.i > i) part.facets.push_back({{i, other.i}, area, other.distance});
        });
    });
    for (std::size_t n = 0; n < balls.size(); ++n) {
        out.volumes[n] = std::max(parts[n].flux / 3.0, 0.0);
        out.facets.insert(out.facets.end(), parts[n].facets.begin(), parts[n].facets.end());
    }
    return out;
}

std::vector<PowerFacet> powerFacets(const std::vector<Ball>& balls, const Progress& progress)
{
    const BallIndex index(balls, {1.0, 0.0, 1.0});
    std::vector<std::vector<PowerFacet>> parts(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t n) {
        const auto i = std::int32_t(n);
        forEachFacet(balls, index, i, i + 1, [&](const Neighbour& other, double area) {
            parts[n].push_back({{i, other.i}, area, other.distance});
        });
        std::sort(parts[n].begin(), parts[n].end(),
                  [](const PowerFacet& a, const PowerFacet& b) { return a.balls[1] < b.balls[1]; });
    });
    std::vector<PowerFacet> out;
    for (const std::vector<PowerFacet>& part : parts)
        out.insert(out.end(), part.begin(), part.end());
    return out;
}

} // namespace molsurf
