// SPDX-License-Identifier: MPL-2.0
#include "molsurf/rasterize/ball_boundary.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/rasterize/ball_index.h"

#include <tbb/enumerable_thread_specific.h>

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

/// Two unit vectors that are orthogonal to a unit vector and to each other.
void frame(const Vec3d& axis, Vec3d& e1, Vec3d& e2)
{
    const Vec3d other = std::abs(axis.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    e1 = axis.cross(other);
    e1.normalize();
    e2 = axis.cross(e1);
}

/// The caps of a sphere, number by number: loops over them vectorise.
struct CapArrays {
    std::vector<double> x, y, z, cosine, sine;
    std::vector<std::int32_t> other;

    int size() const { return int(other.size()); }
    void resize(std::size_t count)
    {
        for (auto* v : {&x, &y, &z, &cosine, &sine}) v->resize(count);
        other.resize(count);
    }
    void set(std::size_t i, const Cap& cap, double capSine)
    {
        x[i] = cap.axis.x();
        y[i] = cap.axis.y();
        z[i] = cap.axis.z();
        cosine[i] = cap.cosine;
        sine[i] = capSine;
        other[i] = cap.other;
    }
    Cap operator[](int k) const
    {
        const auto i = std::size_t(k);
        return {Vec3d(x[i], y[i], z[i]), cosine[i], other[i]};
    }
};

/// Whether a cap lies within one of some that are no smaller.
MOLSURF_KERNEL bool isHeld(const Cap& cap, double sine, const double* x, const double* y,
                           const double* z, const double* cosine, const double* sines, int count)
{
    const double ax = cap.axis.x(), ay = cap.axis.y(), az = cap.axis.z();
    std::int64_t held = 0; // as wide as what is compared
    for (int k = 0; k < count; ++k) {
        const double between = ax * x[k] + ay * y[k] + az * z[k];           // the axes
        const double difference = cap.cosine * cosine[k] + sine * sines[k]; // of the half angles
        held |= between >= difference ? 1 : 0;
    }
    return held != 0;
}

/// The circle at the rim of a cap, of a sphere of radius 1: cosine axis + sine (cos a e1 + sin a
/// e2).
struct Circle {
    Vec3d axis, e1, e2;
    double cosine, sine;
};

/// How caps meet a circle: each covers the directions (cos a, sin a) of its plane with x cos a +
/// y sin a > cosine, (x, y) being a unit vector; nothing for a cosine of 1 and more, all for -1 and
/// less.
MOLSURF_KERNEL void meetCircle(const Circle& circle, const double* ax, const double* ay,
                               const double* az, const double* capCosine, int count,
                               double* __restrict x, double* __restrict y,
                               double* __restrict cosine)
{
    const Vec3d axis = circle.axis, e1 = circle.e1, e2 = circle.e2;
    const double height = circle.cosine, radius = circle.sine;
    for (int k = 0; k < count; ++k) {
        const double along = axis.x() * ax[k] + axis.y() * ay[k] + axis.z() * az[k];
        const double u = e1.x() * ax[k] + e1.y() * ay[k] + e1.z() * az[k];
        const double v = e2.x() * ax[k] + e2.y() * ay[k] + e2.z() * az[k];
        const double inverse = 1.0 / std::sqrt(u * u + v * v);
        x[k] = u * inverse;
        y[k] = v * inverse;
        cosine[k] = (capCosine[k] - height * along) * inverse / radius;
    }
}

/// What the caps of a sphere cover of a circle, number by number; padded to whole vectors.
struct Covers {
    std::vector<double> x, y, cosine; ///< the directions with x cos a + y sin a > cosine
    std::vector<double> endX, endY;   ///< the direction where they end

    int size() const { return int(x.size()); }
    void resize(int count)
    {
        const int padded = (count + doubleLanes - 1) / doubleLanes * doubleLanes;
        for (auto* v : {&x, &y, &cosine, &endX, &endY}) v->resize(std::size_t(padded));
        std::fill(cosine.begin() + count, cosine.end(), 1.0); // nothing
    }
};

/// Where covers end; not a number for those of nothing.
MOLSURF_KERNEL void findEnds(int count, const double* x, const double* y, const double* cosine,
                             double* __restrict endX, double* __restrict endY)
{
    for (int k = 0; k < count; ++k) {
        const double sine = std::sqrt(1.0 - cosine[k] * cosine[k]);
        endX[k] = x[k] * cosine[k] - y[k] * sine;
        endY[k] = y[k] * cosine[k] + x[k] * sine;
    }
}

/// How far a direction lies ahead of another one: from 0 to 4, as the angle.
template<typename T>
inline __attribute__((always_inline)) void quartersAhead(double fromX, double fromY, const T& toX,
                                                         const T& toY, T& quarters)
{
    const T along = toX * fromX + toY * fromY, ahead = fromX * toY - fromY * toX;
    quarters = ahead >= 0.0 ? 1.0 - along : 3.0 + along;
}

/// Room by which covers overlap to count as such.
constexpr double coverMargin = 1e-9;

/// The end that lies farthest ahead of a direction, of the covers that hold it.
/// @param[in]  count    a multiple of doubleLanes
/// @param[out] farthest how far; 0 where none holds it
/// @return the cover
MOLSURF_KERNEL int farthestEnd(double fromX, double fromY, int count, const double* x,
                               const double* y, const double* cosine, const double* endX,
                               const double* endY, double& farthest)
{
    Doubles most = {};
    Longs best = {};
    for (int k = 0; k < count; k += doubleLanes) {
        const auto at = [k](const double* v) { return reinterpret_cast<const Doubles*>(v + k); };
        Doubles ahead;
        quartersAhead(fromX, fromY, *at(endX), *at(endY), ahead);
        const Doubles inside = *at(x) * fromX + *at(y) * fromY - *at(cosine);
        const Doubles held = inside > coverMargin ? ahead : Doubles{};
        best = held > most ? Longs{} + k : best;
        most = held > most ? held : most;
    }
    int lane = 0;
    for (int j = 1; j < doubleLanes; ++j) {
        if (most[j] > most[lane]) lane = j;
    }
    farthest = most[lane];
    return int(best[lane]) + lane;
}

/// Whether covers overlap all around a circle, found by going from the end of one to the farthest
/// end of those that hold it. False where they may do no more than touch: those who need to know
/// have to look closer.
/// @param[in,out] c  its ends are filled in
bool surround(Covers& c)
{
    const int count = c.size();
    int at = 0; // the cover at whose end we are
    while (at < count && !(c.cosine[std::size_t(at)] < 1.0)) ++at;
    if (at == count) return false;
    findEnds(count, c.x.data(), c.y.data(), c.cosine.data(), c.endX.data(), c.endY.data());
    const double startX = c.endX[std::size_t(at)], startY = c.endY[std::size_t(at)];
    double turned = 0.0; // how far from the start, from 0 to 4
    for (int step = 0; step <= count; ++step) {
        double farthest;
        at = farthestEnd(c.endX[std::size_t(at)], c.endY[std::size_t(at)], count, c.x.data(),
                         c.y.data(), c.cosine.data(), c.endX.data(), c.endY.data(), farthest);
        if (farthest <= coverMargin) return false;
        double now;
        quartersAhead(startX, startY, c.endX[std::size_t(at)], c.endY[std::size_t(at)], now);
        if (now < turned) return true; // at the start, which the first step has covered, or past it
        turned = now;
    }
    return false;
}

/// A range of angles of a circle that a cap covers.
struct Interval {
    double begin, end;           // end > begin
    std::int32_t byBegin, byEnd; // the balls that cover up to the ends
};

/// What is found of a ball's circles with balls of higher index.
struct BallParts {
    std::vector<Arc> arcs;
    std::vector<Corner> corners;
};

/// Room for one ball, kept from ball to ball by a thread.
struct Scratch {
    std::vector<Cap> found;
    CapArrays caps;
    Covers covers;
    std::vector<Interval> covered;
};

/// What the caps of a sphere cover of the circle at the rim of one of them.
/// @return whether any of the circle may be uncovered
bool findCovers(const Circle& circle, int own, const CapArrays& caps, Covers& covers)
{
    const int count = caps.size();
    covers.resize(count);
    meetCircle(circle, caps.x.data(), caps.y.data(), caps.z.data(), caps.cosine.data(), count,
               covers.x.data(), covers.y.data(), covers.cosine.data());
    covers.cosine[std::size_t(own)] = 1.0;
    for (const double cosine : covers.cosine) {
        if (cosine <= -1.0) return false;
    }
    return !surround(covers);
}

/// Adds the uncovered arcs of the circle at the rim of a cap, with the corners at their ends.
/// @param[in] own  the cap's place among those of the ball
void addArcs(const Vec3d& centre, double radius, std::int32_t ball, int own, Scratch& s,
             BallParts& parts)
{
    const Cap cap = s.caps[own];
    Circle circle{cap.axis, {}, {}, cap.cosine, s.caps.sine[std::size_t(own)]};
    frame(circle.axis, circle.e1, circle.e2);
    Covers& covers = s.covers;
    if (!findCovers(circle, own, s.caps, covers)) return;
    std::vector<Interval>& covered = s.covered;
    covered.clear();
    for (std::size_t k = 0; k < s.caps.other.size(); ++k) {
        if (!(covers.cosine[k] < 1.0)) continue;
        const double middle = std::atan2(covers.y[k], covers.x[k]);
        const double half = std::acos(covers.cosine[k]);
        const std::int32_t other = s.caps.other[k];
        double begin = middle - half;
        if (begin < -M_PI) begin += 2.0 * M_PI;
        covered.push_back({begin, begin + 2.0 * half, other, other});
        if (begin + 2.0 * half > M_PI) { // the part that runs into the next turn
            covered.push_back({begin - 2.0 * M_PI, begin + 2.0 * (half - M_PI), other, other});
        }
    }
    std::sort(covered.begin(), covered.end(), [](const Interval& a, const Interval& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.byBegin < b.byBegin;
    });

    const Vec3d m = centre + radius * circle.cosine * circle.axis;
    const double rho = radius * circle.sine;
    const auto at = [&](double a) { return std::cos(a) * circle.e1 + std::sin(a) * circle.e2; };
    if (covered.empty()) {
        parts.arcs.push_back({m, rho, circle.axis, circle.e1, M_PI, {ball, cap.other}, {-1, -1}});
        return;
    }
    const auto addCorner = [&](double angle, std::int32_t third) {
        // Each corner is found on three circles: the one of the two lowest balls keeps it.
        if (third > cap.other)
            parts.corners.push_back({m + rho * at(angle), {ball, cap.other, third}});
    };
    const auto addArc = [&](double begin, double end, std::int32_t byBegin, std::int32_t byEnd) {
        parts.arcs.push_back({m,
                              rho,
                              circle.axis,
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
}

/// The balls that are grown by a probe radius, and the caps of each.
class GrownBalls
{
public:
    GrownBalls(const std::vector<Ball>& balls, double probe, const Progress& progress)
        : balls_(balls), probe_(probe), largest_(largestRadius(balls)),
          index_(balls, std::max(2.0, (largest_ + probe) / 1.5)), within_(balls.size())
    {
        parallelFor(balls.size(), progress, [&](std::size_t i) {
            const Vec3d c(balls[i].center);
            index_.forEachNear(c, c, largest_, [&](const Ball& other, std::int32_t j) {
                if (std::size_t(j) != i && isWithin(balls[i], std::int32_t(i), other, j))
                    within_[i] = 1;
            });
        });
    }

    /// Whether a ball lies in another one.
    bool isWithinOther(std::size_t i) const { return within_[i] != 0; }

    double radius(std::size_t i) const { return balls_[i].radius + probe_; }

    /// The caps of a ball, the largest first, without those within another.
    void findCaps(std::size_t i, Scratch& s) const
    {
        const Vec3d centre(balls_[i].center);
        const double R = radius(i);
        s.found.clear();
        index_.forEachNear(
            centre, centre, R + largest_ + probe_, [&](const Ball& ball, std::int32_t j) {
                if (std::size_t(j) == i || within_[std::size_t(j)]) return;
                const Vec3d way = Vec3d(ball.center) - centre;
                const double other = ball.radius + probe_, distance2 = way.lengthSqr();
                if (distance2 >= (R + other) * (R + other) || distance2 == 0.0) return;
                const double distance = std::sqrt(distance2);
                const double cosine =
                    (distance2 + (R - other) * (R + other)) / (2.0 * distance * R);
                if (std::abs(cosine) < 1.0) s.found.push_back({way / distance, cosine, j});
            });
        // They hold most of the others.
        std::sort(s.found.begin(), s.found.end(), [](const Cap& a, const Cap& b) {
            return a.cosine != b.cosine ? a.cosine < b.cosine : a.other < b.other;
        });
        s.caps.resize(s.found.size());
        std::size_t kept = 0;
        for (const Cap& cap : s.found) {
            const double sine = std::sqrt(1.0 - cap.cosine * cap.cosine);
            if (!isHeld(cap, sine, s.caps.x.data(), s.caps.y.data(), s.caps.z.data(),
                        s.caps.cosine.data(), s.caps.sine.data(), int(kept)))
                s.caps.set(kept++, cap, sine);
        }
        s.caps.resize(kept);
    }

private:
    const std::vector<Ball>& balls_;
    const double probe_, largest_;
    const BallIndex index_;
    std::vector<std::uint8_t> within_;
};

} // namespace

Vec3d Arc::end(int which) const
{
    const double sine = std::sin(half) * (which == 0 ? -1.0 : 1.0);
    return std::cos(half) * middle + sine * axis.cross(middle);
}

BallBoundary ballBoundary(const std::vector<Ball>& balls, double probe, const Progress& progress)
{
    const GrownBalls grown(balls, probe, progress);
    tbb::enumerable_thread_specific<Scratch> scratches;
    std::vector<BallParts> all(balls.size());
    std::vector<std::uint32_t> caps(balls.size());
    std::vector<std::uint8_t> exposed(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t n) {
        if (grown.isWithinOther(n)) return;
        Scratch& s = scratches.local();
        grown.findCaps(n, s);
        caps[n] = std::uint32_t(s.caps.size());
        if (s.caps.size() == 0) exposed[n] = 1;
        for (int k = 0; k < s.caps.size(); ++k) {
            if (s.caps.other[std::size_t(k)] < std::int32_t(n)) continue; // found by the other
            addArcs(Vec3d(balls[n].center), grown.radius(n), std::int32_t(n), k, s, all[n]);
        }
    });
    for (const BallParts& parts : all) {
        for (const Arc& arc : parts.arcs) {
            for (const std::int32_t ball : arc.balls) exposed[std::size_t(ball)] = 1;
        }
    }

    BallBoundary boundary;
    std::uint32_t capCount = 0, arcCount = 0, cornerCount = 0;
    for (std::size_t n = 0; n < balls.size(); ++n) {
        if (!exposed[n]) continue;
        Patch patch{Vec3d(balls[n].center),
                    grown.radius(n),
                    std::int32_t(n),
                    capCount,
                    0,
                    arcCount,
                    0,
                    cornerCount,
                    0};
        patch.capsEnd = capCount += caps[n];
        patch.arcsEnd = arcCount += std::uint32_t(all[n].arcs.size());
        patch.cornersEnd = cornerCount += std::uint32_t(all[n].corners.size());
        boundary.patches.push_back(patch);
    }
    boundary.caps.resize(capCount);
    boundary.arcs.resize(arcCount);
    boundary.corners.resize(cornerCount);
    parallelFor(boundary.patches.size(), progress, [&](std::size_t p) {
        const Patch& patch = boundary.patches[p];
        const auto n = std::size_t(patch.ball);
        Scratch& s = scratches.local();
        grown.findCaps(n, s); // once more: those of all balls would take much memory
        for (int k = 0; k < s.caps.size(); ++k)
            boundary.caps[patch.capsBegin + std::size_t(k)] = s.caps[k];
        std::copy(all[n].arcs.begin(), all[n].arcs.end(), boundary.arcs.begin() + patch.arcsBegin);
        std::copy(all[n].corners.begin(), all[n].corners.end(),
                  boundary.corners.begin() + patch.cornersBegin);
        all[n] = BallParts();
    });
    return boundary;
}

} // namespace molsurf
