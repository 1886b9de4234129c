// SPDX-License-Identifier: MPL-2.0
#include "molsurf/rasterize/ball_boundary.h"

#include "molsurf/core/parallel.h"
#include "molsurf/rasterize/ball_index.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Whether a ball lies in another one, or equals one of lower index.
bool isWithin(const Ball& a, std::int32_t i, const Ball& b, std::int32_t j)
{
    const double distance = (Vec3d(a.center) - Vec3d(b.center)).length();
    const double room = double(b.radius) - double(a.radius);
    return distance < room || (distance == room && (room > 0.0 || j < i));
}

/// Whether cap a lies within cap b.
bool isWithin(const Cap& a, const Cap& b)
{
    if (a.cosine < b.cosine || (a.cosine == b.cosine && a.other < b.other)) return false;
    const double sines = std::sqrt((1.0 - a.cosine * a.cosine) * (1.0 - b.cosine * b.cosine));
    return a.axis.dot(b.axis) >= a.cosine * b.cosine + sines; // cosine of the angles' difference
}

/// Two unit vectors that are orthogonal to a unit vector and to each other.
void frame(const Vec3d& axis, Vec3d& e1, Vec3d& e2)
{
    const Vec3d other = std::abs(axis.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    e1 = axis.cross(other);
    e1.normalize();
    e2 = axis.cross(e1);
}

/// A cap as a circle meets it: the direction (cos a, sin a) of the circle's plane is covered where
/// x cos a + y sin a > length cosine.
struct Cover {
    double x, y, length; // of (x, y)
    double cosine;       // of half the angle that is covered
    std::int32_t other;
};

/// Whether covers overlap all around a circle, found by going from the end of one to the farthest
/// end of those that hold it. False where they may do no more than touch: those who need to know
/// have to look closer.
bool surround(const std::vector<Cover>& covers)
{
    constexpr double margin = 1e-9;
    if (covers.size() < 2) return false;
    const auto endOf = [](const Cover& c, double& ex, double& ey) {
        const double sine = std::sqrt(1.0 - c.cosine * c.cosine);
        ex = (c.x * c.cosine - c.y * sine) / c.length;
        ey = (c.y * c.cosine + c.x * sine) / c.length;
    };
    double x, y, turned = 0.0; // where we are, and how far from the start
    endOf(covers[0], x, y);
    for (std::size_t step = 0; step <= covers.size(); ++step) {
        double farthest = 0.0, nextX = x, nextY = y; // farthest: between 0 and 4, as the angle
        for (const Cover& c : covers) {
            if (c.x * x + c.y * y <= c.length * (c.cosine + margin)) continue;
            double ex, ey;
            endOf(c, ex, ey);
            const double along = ex * x + ey * y, ahead = x * ey - y * ex;
            const double quarters = ahead >= 0.0 ? 1.0 - along : 3.0 + along;
            if (quarters <= farthest) continue;
            farthest = quarters;
            nextX = ex;
            nextY = ey;
        }
        if (farthest <= margin) return false;
        const double ahead = std::atan2(x * nextY - y * nextX, x * nextX + y * nextY);
        turned += ahead > 0.0 ? ahead : ahead + 2.0 * M_PI;
        if (turned > 2.0 * M_PI + margin) return true;
        x = nextX;
        y = nextY;
    }
    return false;
}

/// A range of angles of a circle that a cap covers.
struct Interval {
    double begin, end;           // end > begin
    std::int32_t byBegin, byEnd; // the balls that cover up to the ends
};

struct BallParts {
    bool exposed = false; // itself, not only its arcs with others
    std::vector<Cap> caps;
    std::vector<Arc> arcs;
    std::vector<Corner> corners;
};

/// The uncovered arcs of the circle at the rim of a cap, with the corners at their ends.
/// @return whether there is any
bool addArcs(const Vec3d& centre, double radius, std::int32_t ball, const Cap& cap,
             const std::vector<Cap>& caps, std::vector<Cover>& covers,
             std::vector<Interval>& covered, BallParts& parts)
{
    const double sine = std::sqrt(1.0 - cap.cosine * cap.cosine);
    Vec3d e1, e2;
    frame(cap.axis, e1, e2);
    covers.clear();
    for (const Cap& other : caps) {
        if (other.other == cap.other) continue;
        // u(a) = cosine axis + sine (cos a e1 + sin a e2) is covered where u.axis' > cosine'.
        const double along = cap.cosine * cap.axis.dot(other.axis);
        const double x = e1.dot(other.axis), y = e2.dot(other.axis);
        const double length = std::sqrt(x * x + y * y);
        const double reach = sine * length, gap = other.cosine - along;
        if (gap >= reach) continue;
        if (gap <= -reach) return false;
        covers.push_back({x, y, length, gap / reach, other.other});
    }
    if (surround(covers)) return false;
    covered.clear();
    for (const Cover& c : covers) {
        const double middle = std::atan2(c.y, c.x), half = std::acos(c.cosine);
        double begin = middle - half;
        if (begin < -M_PI) begin += 2.0 * M_PI;
        covered.push_back({begin, begin + 2.0 * half, c.other, c.other});
        if (begin + 2.0 * half > M_PI) { // the part that runs into the next turn
            covered.push_back({begin - 2.0 * M_PI, begin + 2.0 * (half - M_PI), c.other, c.other});
        }
    }
    std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.byBegin < b.byBegin;
    });

    const Vec3d m = centre + radius * cap.cosine * cap.axis;
    const double rho = radius * sine;
    const bool first = ball < cap.other; // of the two, the one that keeps the arc
    const auto at = [&](double a) { return std::cos(a) * e1 + std::sin(a) * e2; };
    if (covered.empty()) {
        if (first) parts.arcs.push_back({m, rho, cap.axis, e1, M_PI, {ball, cap.other}, {-1, -1}});
        return true;
    }
    bool any = false;
    const auto addCorner = [&](double angle, std::int32_t third) {
        // Each corner is found on three circles: the one of the two lowest balls keeps it.
        if (first && third > cap.other) {
            parts.corners.push_back({m + rho * at(angle), {ball, cap.other, third}});
        }
    };
    const auto addArc = [&](double begin, double end, std::int32_t byBegin, std::int32_t byEnd) {
        any = true;
        if (!first) return;
        parts.arcs.push_back({m,
                              rho,
                              cap.axis,
                              at(0.5 * (begin + end)),
                              0.5 * (end - begin),
                              {ball, cap.other},
                              {byBegin, byEnd}});
        addCorner(begin, byBegin);
        addCorner(end, byEnd);
    };
    Interval last = covered.front();
    for (std::size_t i = 1; i < covered.size(); ++i) {
        if (covered[i].begin > last.end) {
            addArc(last.end, covered[i].begin, last.byEnd, covered[i].byBegin);
            last = covered[i];
        } else if (covered[i].end > last.end) {
            last.end = covered[i].end;
            last.byEnd = covered[i].byEnd;
        }
    }
    const double again = covered.front().begin + 2.0 * M_PI;
    if (again > last.end) addArc(last.end, again, last.byEnd, covered.front().byBegin);
    return any;
}

} // namespace

Vec3d Arc::end(int which) const
{
    const double sine = std::sin(half) * (which == 0 ? -1.0 : 1.0);
    return std::cos(half) * middle + sine * axis.cross(middle);
}

BallBoundary ballBoundary(const std::vector<Ball>& balls, double probe, const Progress& progress)
{
    double largest = 0.0;
    for (const Ball& ball : balls) largest = std::max(largest, double(ball.radius));
    const BallIndex index(balls, std::max(2.0, (largest + probe) / 1.5));

    std::vector<std::uint8_t> within(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t i) {
        const Vec3d c(balls[i].center);
        index.forEachNear(c, c, largest, [&](const Ball& other, std::int32_t j) {
            if (std::size_t(j) != i && isWithin(balls[i], std::int32_t(i), other, j)) within[i] = 1;
        });
    });

    std::vector<BallParts> all(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t n) {
        if (within[n]) return;
        const std::int32_t i = std::int32_t(n);
        const Vec3d centre(balls[n].center);
        const double R = balls[n].radius + probe;
        std::vector<Cap> caps;
        index.forEachNear(centre, centre, R + largest + probe, [&](const Ball& b, std::int32_t j) {
            if (j == i || within[j]) return;
            const Vec3d way = Vec3d(b.center) - centre;
            const double distance = way.length(), other = b.radius + probe;
            if (distance >= R + other || distance == 0.0) return;
            const double cosine =
                (distance * distance + (R - other) * (R + other)) / (2.0 * distance * R);
            if (std::abs(cosine) < 1.0) caps.push_back({way / distance, cosine, j});
        });
        // The largest first: they hold most of the others.
        std::sort(caps.begin(), caps.end(), [](const Cap& a, const Cap& b) {
            return a.cosine != b.cosine ? a.cosine < b.cosine : a.other < b.other;
        });
        BallParts& parts = all[n];
        for (const Cap& cap : caps) {
            const bool inside =
                std::any_of(parts.caps.begin(), parts.caps.end(),
                            [&](const Cap& larger) { return isWithin(cap, larger); });
            if (!inside) parts.caps.push_back(cap);
        }
        parts.exposed = parts.caps.empty();
        std::vector<Cover> covers;
        std::vector<Interval> covered;
        for (const Cap& cap : parts.caps) {
            parts.exposed |= addArcs(centre, R, i, cap, parts.caps, covers, covered, parts);
        }
        if (!parts.exposed) parts = BallParts();
    });

    BallBoundary boundary;
    for (std::size_t n = 0; n < balls.size(); ++n) {
        const BallParts& parts = all[n];
        if (!parts.exposed) continue;
        Patch patch{Vec3d(balls[n].center),
                    balls[n].radius + probe,
                    std::int32_t(n),
                    std::uint32_t(boundary.caps.size()),
                    0,
                    std::uint32_t(boundary.arcs.size()),
                    0,
                    std::uint32_t(boundary.corners.size()),
                    0};
        boundary.caps.insert(boundary.caps.end(), parts.caps.begin(), parts.caps.end());
        boundary.arcs.insert(boundary.arcs.end(), parts.arcs.begin(), parts.arcs.end());
        boundary.corners.insert(boundary.corners.end(), parts.corners.begin(), parts.corners.end());
        patch.capsEnd = std::uint32_t(boundary.caps.size());
        patch.arcsEnd = std::uint32_t(boundary.arcs.size());
        patch.cornersEnd = std::uint32_t(boundary.corners.size());
        boundary.patches.push_back(patch);
    }
    return boundary;
}

} // namespace molsurf
