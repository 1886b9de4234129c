// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/excluded_measure.h"

#include "molsurf/error.h"
#include "support/molecules.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr double excludedProbe = 1.4;

struct SurfaceTotals {
    double area = 0.0, volume = 0.0;
    int outer = 0, cavities = 0, euler = 0;
};

SurfaceTotals totalsOf(const std::vector<BoundaryPiece>& pieces)
{
    SurfaceTotals t;
    for (const BoundaryPiece& piece : pieces) {
        t.area += piece.area;
        t.volume += piece.volume;
        t.euler += piece.eulerCharacteristic;
        ++(piece.outer ? t.outer : t.cavities);
    }
    return t;
}

struct Excluded {
    BallBoundary boundary;
    BoundaryMeasure grown;
    ExcludedMeasure measure;
    SurfaceTotals all;

    explicit Excluded(const std::vector<Ball>& balls, double probe = excludedProbe)
        : boundary(ballBoundary(balls, probe, Progress())),
          grown(measureBoundary(boundary, Progress())),
          measure(measureExcluded(boundary, grown, probe, true, Progress())),
          all(totalsOf(measure.pieces))
    {
    }
    std::vector<double> areas(std::size_t count) const
    {
        return areasOfBalls(boundary, measure, count);
    }
};

Ball ballAt(double x, double y, double z, double r)
{
    return {Vec3f(float(x), float(y), float(z)), float(r), 0};
}

std::vector<Ball> ringOf(int count, double radius, double r, double z = 0.0)
{
    std::vector<Ball> out;
    for (int k = 0; k < count; ++k) {
        const double a = 2.0 * M_PI * k / count;
        out.push_back(ballAt(radius * std::cos(a), radius * std::sin(a), z, r));
    }
    return out;
}

std::vector<Ball> latticeOf(int n, double edge, double r)
{
    std::vector<Ball> out;
    for (int k = 0; k < n * n * n; ++k)
        out.push_back(ballAt(edge * (k % n), edge * (k / n % n), edge * (k / n / n), r));
    return out;
}

std::vector<Ball> icosahedron(double scale, double r)
{
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<Ball> out;
    for (int k = 0; k < 12; ++k) {
        const double a = scale * (k & 1 ? 1 : -1), b = scale * golden * (k & 2 ? 1 : -1);
        const int turn = k / 4;
        out.push_back(turn == 0   ? ballAt(0, a, b, r)
                      : turn == 1 ? ballAt(a, b, 0, r)
                                  : ballAt(b, 0, a, r));
    }
    return out;
}

/// An independent quadrature: circles, corners and covers are tried out one by one, and the free
/// part of a sphere is cut into slices.
class Sliced
{
public:
    Sliced(const std::vector<Ball>& balls, double probe) : probe_(probe)
    {
        for (const Ball& b : balls) {
            centres_.emplace_back(b.center);
            radii_.push_back(b.radius + probe);
        }
        origin_ = centres_[0];
        areas.assign(balls.size(), 0.0);
        for (std::size_t i = 0; i < centres_.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) addCircle(i, j);
        }
        for (std::size_t i = 0; i < centres_.size(); ++i) addContact(i);
        for (const FoundCorner& corner : corners_) addConcave(corner);
    }
    double area = 0.0, volume = 0.0;
    std::vector<double> areas; // of balls

private:
    struct Slice {
        Vec3d axis;
        double cosine;
    };
    struct FoundCorner {
        Vec3d position;
        std::array<std::size_t, 3> balls;
    };
    using Interval = std::pair<double, double>;

    /// What intervals leave of [0, 2 pi].
    static std::vector<Interval> rest(const std::vector<Interval>& covers)
    {
        std::vector<Interval> parts, out;
        for (const auto& [from, to] : covers) {
            const double begin = from - 2.0 * M_PI * std::floor(from / (2.0 * M_PI));
            const double end = begin + to - from;
            parts.emplace_back(begin, std::min(end, 2.0 * M_PI));
            if (end > 2.0 * M_PI) parts.emplace_back(0.0, end - 2.0 * M_PI);
        }
        std::sort(parts.begin(), parts.end());
        double at = 0.0;
        for (const auto& [begin, end] : parts) {
            if (begin > at) out.emplace_back(at, begin);
            at = std::max(at, end);
        }
        if (at < 2.0 * M_PI) out.emplace_back(at, 2.0 * M_PI);
        return out;
    }

    /// The area of the unit sphere outside of caps, and the integral of its directions.
    static std::pair<double, Vec3d> free(const std::vector<Slice>& caps)
    {
        constexpr int slices = 4000;
        Vec3d axis(0.36, -0.48, 0.8), e1(0.8, 0.6, 0.0);
        const Vec3d e2 = axis.cross(e1);
        double sum = 0.0;
        Vec3d normal(0.0);
        for (int s = 0; s < slices; ++s) {
            const double z = (2.0 * s + 1.0) / slices - 1.0, r = std::sqrt(1.0 - z * z);
            std::vector<Interval> covers;
            for (const Slice& cap : caps) {
                const double x = cap.axis.dot(e1), y = cap.axis.dot(e2);
                const double cosine =
                    (cap.cosine - z * cap.axis.dot(axis)) / (r * std::hypot(x, y));
                if (cosine >= 1.0) continue;
                const double half = cosine <= -1.0 ? M_PI : std::acos(cosine);
                const double middle = std::atan2(y, x);
                covers.emplace_back(middle - half, middle + half);
            }
            for (const auto& [begin, end] : rest(covers)) {
                sum += 2.0 / slices * (end - begin);
                normal += 2.0 / slices *
                          (z * (end - begin) * axis + r * ((std::sin(end) - std::sin(begin)) * e1 +
                                                           (std::cos(begin) - std::cos(end)) * e2));
            }
        }
        return {sum, normal};
    }

    bool isFree(const Vec3d& x, std::size_t i, std::size_t j, std::size_t k) const
    {
        for (std::size_t o = 0; o < centres_.size(); ++o) {
            if (o != i && o != j && o != k && (x - centres_[o]).length() < radii_[o]) return false;
        }
        return true;
    }

    double power(std::size_t i, const Vec3d& x) const
    {
        return (x - centres_[i]).lengthSqr() - std::pow(radii_[i] - probe_, 2);
    }

    void addContact(std::size_t i)
    {
        std::vector<Slice> caps;
        const double R = radii_[i], r = R - probe_;
        for (std::size_t j = 0; j < centres_.size(); ++j) {
            const Vec3d way = centres_[j] - centres_[i];
            const double d = way.length();
            if (j == i || d >= R + radii_[j] || d + radii_[j] <= R) continue;
            if (d + R <= radii_[j]) return;
            caps.push_back({way / d, (d * d + R * R - radii_[j] * radii_[j]) / (2.0 * d * R)});
        }
        const auto [sum, normal] = free(caps);
        area += r * r * sum;
        areas[i] += r * r * sum;
        volume += r * r * (r * sum + (centres_[i] - origin_).dot(normal)) / 3.0;
    }

    void addCircle(std::size_t i, std::size_t j)
    {
        const Vec3d way = centres_[j] - centres_[i];
        const double d = way.length(), R = radii_[i], S = radii_[j], p = probe_;
        if (d >= R + S || d <= std::abs(R - S)) return;
        const double t = (d * d + R * R - S * S) / (2.0 * d), rho = std::sqrt(R * R - t * t);
        const Vec3d axis = way / d, m = centres_[i] + t * axis;
        Vec3d e1 = axis.cross(std::abs(axis.x()) < 0.8 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0));
        e1.normalize();
        const Vec3d e2 = axis.cross(e1);
        std::vector<Interval> covers;
        for (std::size_t k = 0; k < centres_.size(); ++k) {
            const Vec3d q = centres_[k] - m;
            const double x = q.dot(e1), y = q.dot(e2), z = q.dot(axis), flat = std::hypot(x, y);
            const double cosine =
                (flat * flat + z * z + rho * rho - radii_[k] * radii_[k]) / (2.0 * flat * rho);
            if (k == i || k == j || cosine >= 1.0) continue;
            const double half = cosine <= -1.0 ? M_PI : std::acos(cosine);
            covers.emplace_back(std::atan2(y, x) - half, std::atan2(y, x) + half);
            if (k > i || cosine <= -1.0) continue;
            for (const double a : {covers.back().first, covers.back().second}) {
                const Vec3d c = m + rho * (std::cos(a) * e1 + std::sin(a) * e2);
                if (k < j && isFree(c, i, j, k)) corners_.push_back({c, {i, j, k}});
            }
        }
        constexpr int steps = 4000;
        const double low = std::atan2(-t, rho), high = std::atan2(d - t, rho);
        for (const auto& [begin, end] : rest(covers)) {
            const Vec3d e = (std::sin(end) - std::sin(begin)) * e1 +
                            (std::cos(begin) - std::cos(end)) * e2; // integrated
            for (int s = 0; s < steps; ++s) {
                const double f = low + (s + 0.5) * (high - low) / steps;
                const double wide = rho - p * std::cos(f);
                if (wide <= 0.0) continue; // beyond the axis
                const double w = p * wide * (high - low) / steps;
                area += w * (end - begin);
                areas[power(i, m + wide * e1 + p * std::sin(f) * axis) <
                              power(j, m + wide * e1 + p * std::sin(f) * axis)
                          ? i
                          : j] += w * (end - begin);
                // x.n with x = m + wide e + p sin f axis, n = cos f e - sin f axis
                const double own = wide * std::cos(f) - p * std::sin(f) * std::sin(f);
                volume += w / 3.0 *
                          (own * (end - begin) +
                           (m - origin_).dot(std::cos(f) * e - std::sin(f) * (end - begin) * axis));
            }
        }
    }

    void addConcave(const FoundCorner& corner)
    {
        std::array<Vec3d, 3> way;
        for (std::size_t k = 0; k < 3; ++k) way[k] = centres_[corner.balls[k]] - corner.position;
        const double side = way[0].dot(way[1].cross(way[2])) > 0.0 ? 1.0 : -1.0;
        std::vector<Slice> caps;
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3d outward = -side * way[k].cross(way[(k + 1) % 3]);
            outward.normalize();
            caps.push_back({outward, 0.0});
        }
        for (const FoundCorner& other : corners_) {
            const Vec3d to = other.position - corner.position;
            const double d = to.length();
            if (d > 0.0 && d < 2.0 * probe_) caps.push_back({to / d, d / (2.0 * probe_)});
        }
        const auto [sum, normal] = free(caps);
        area += probe_ * probe_ * sum;
        for (std::size_t k = 0; k < 3; ++k) {
            // The points c + p u that are nearer to ball k, by |x - x_k|^2 - r_k^2.
            std::vector<Slice> own = caps;
            const std::size_t i = corner.balls[k];
            for (const std::size_t j : corner.balls) {
                if (j == i) continue;
                const Vec3d to = centres_[j] - centres_[i];
                const double zero = power(i, corner.position) - power(j, corner.position);
                own.push_back({to / to.length(), -zero / (2.0 * probe_ * to.length())});
            }
            areas[i] += probe_ * probe_ * free(own).first;
        }
        volume -= probe_ * probe_ / 3.0 * (probe_ * sum + (corner.position - origin_).dot(normal));
    }

    double probe_;
    std::vector<Vec3d> centres_;
    std::vector<double> radii_;
    Vec3d origin_;
    std::vector<FoundCorner> corners_;
};

/// Measures of a surface of revolution whose profile y(x) is given, by Simpson's rule.
SurfaceTotals revolved(double from, double to, const std::function<double(double)>& profile)
{
    constexpr int steps = 20000;
    SurfaceTotals t;
    double x = from, y = profile(from);
    for (int k = 1; k <= steps; ++k) {
        const double next = from + (to - from) * k / steps, z = profile(next);
        t.area += M_PI * (y + z) * std::hypot(next - x, z - y);
        t.volume += M_PI * (next - x) * (y * y + y * z + z * z) / 3.0;
        x = next;
        y = z;
    }
    return t;
}

/// Two balls on the x-axis, at 0 and d.
SurfaceTotals revolvedPair(double r, double s, double d, double p)
{
    const double R = r + p, S = s + p, t = (d * d + R * R - S * S) / (2.0 * d);
    const double rho = std::sqrt(R * R - t * t);
    const double left = t * r / R, right = d - (d - t) * s / S; // where contact faces end
    const double cusp = rho < p ? std::sqrt(p * p - rho * rho) : 0.0;
    const auto arc = [&](double x) {
        return std::max(0.0, rho - std::sqrt(std::max(0.0, p * p - (x - t) * (x - t))));
    };
    SurfaceTotals sum;
    const auto add = [&](double from, double to) {
        const SurfaceTotals part = revolved(from, to, arc);
        sum.area += part.area;
        sum.volume += part.volume;
    };
    add(left, t - cusp);
    add(t + cusp, right);
    // Caps of balls.
    const double a = r + left, b = s + (d - right);
    sum.area += 2.0 * M_PI * (r * a + s * b);
    sum.volume += M_PI * (a * a * (3.0 * r - a) + b * b * (3.0 * s - b)) / 3.0;
    return sum;
}

TEST(ExcludedMeasure, OneBallAndNone)
{
    EXPECT_TRUE(Excluded({}).measure.pieces.empty());
    const Excluded one({ballAt(1, 2, 3, 1.75)});
    EXPECT_NEAR(one.all.area, 4.0 * M_PI * 1.75 * 1.75, 1e-6);
    EXPECT_NEAR(one.all.volume, 4.0 / 3.0 * M_PI * std::pow(1.75, 3), 1e-6);
    EXPECT_EQ(one.all.euler, 2);
    EXPECT_EQ(one.measure.totalAreas().toric, 0.0);
}

TEST(ExcludedMeasure, AreasByCentreAreThoseOfEachMoleculeAlone)
{
    std::vector<Ball> first = test::randomBalls(20, 6.0, Vec3d(0.0), 1);
    std::vector<Ball> second = test::randomBalls(30, 6.0, Vec3d(40.0, 0.0, 0.0), 2);
    std::vector<Ball> both = first;
    both.insert(both.end(), second.begin(), second.end());
    const Excluded together(both);
    for (const auto& balls : {first, second}) {
        const ExcludedAreas alone = Excluded(balls).measure.totalAreas();
        // What is left out of the measure of the union is left out.
        BoundaryMeasure part = together.grown;
        const bool isFirst = balls.size() == first.size();
        const auto isOther = [&](std::int32_t ball) {
            return (together.boundary.balls[std::size_t(ball)].centre().x() < 20.0) != isFirst;
        };
        for (BoundaryFace& face : part.faces)
            if (isOther(together.boundary.patches[face.patch].ball)) face.piece = -1;
        for (std::size_t a = 0; a < part.arcPieces.size(); ++a)
            if (isOther(together.boundary.arcs[a].balls[0])) part.arcPieces[a] = -1;
        const ExcludedAreas found =
            measureExcluded(together.boundary, part, excludedProbe, false, Progress()).totalAreas();
        EXPECT_NEAR(found.contact, alone.contact, 1e-5);
        EXPECT_NEAR(found.toric, alone.toric, 1e-5);
        EXPECT_NEAR(found.concave, alone.concave, 1e-5);
    }
    const ExcludedMeasure& m = together.measure;
    ASSERT_EQ(m.areasByCentre.size(), together.grown.pieces.size());
    EXPECT_NEAR(m.totalAreas().sum(), together.all.area, 1e-9 * together.all.area);
}

TEST(ExcludedMeasure, TwoBallsAreARevolvedProfile)
{
    for (const double p : {0.7, 1.4, 3.0}) {
        for (const auto& [r, s] : {std::pair(1.7, 1.7), std::pair(1.2, 2.0), std::pair(0.5, 2.5)}) {
            for (double d = 1.0; d < r + s + 2.0 * p; d += 0.37) {
                if (d <= std::abs(r - s) + 0.01) continue;
                const Excluded two({ballAt(0, 0, 0, r), ballAt(d, 0, 0, s)}, p);
                const double R = r + p, S = s + p, t = (d * d + R * R - S * S) / (2.0 * d);
                if (t <= 0.0 || t >= d) continue; // a part of a torus beyond its equator
                const SurfaceTotals exact = revolvedPair(r, s, d, p);
                EXPECT_NEAR(two.all.area, exact.area, 2e-5 * exact.area) << p << " " << d;
                EXPECT_NEAR(two.all.volume, exact.volume, 2e-5 * exact.volume) << p << " " << d;
                const bool pinched = std::sqrt(R * R - t * t) < p;
                EXPECT_EQ(two.all.outer, pinched ? 2 : 1);
                EXPECT_EQ(two.all.euler, pinched ? 4 : 2);
                EXPECT_TRUE(two.measure.topologyKnown);
            }
        }
    }
}

// A third ball on the axis of the others' torus covers nothing but one side of it.
TEST(ExcludedMeasure, ATorusBeyondItsEquator)
{
    const std::vector<Ball> balls = {ballAt(0, 0, 0, 2.5), ballAt(2.2, 0, 0, 0.5)}; // t > d
    const Excluded two(balls);
    const Sliced sliced(balls, excludedProbe);
    EXPECT_NEAR(two.all.area, sliced.area, 1e-5 * sliced.area);
    EXPECT_NEAR(two.all.volume, sliced.volume, 1e-5 * sliced.volume);
    EXPECT_EQ(two.all.outer, 1);
}

TEST(ExcludedMeasure, AgreesWithSlices)
{
    std::vector<std::pair<std::vector<Ball>, double>> molecules;
    for (unsigned seed = 0; seed < 24; ++seed) {
        const double probe = std::array{0.8, 1.4, 1.4, 2.5}[seed % 4];
        molecules.emplace_back(
            test::randomBalls(3 + int(seed % 9), 4.0 + 0.2 * seed, Vec3d(20.0, -3.0, 5.0), seed),
            probe);
    }
    for (const double edge : {2.0, 3.0, 3.1, 3.2})
        molecules.emplace_back(ringOf(3, edge, 1.7), 1.4);
    for (const double edge : {2.8, 3.2, 4.0}) molecules.emplace_back(ringOf(6, edge, 1.7), 1.4);
    for (const double edge : {2.5, 3.0, 4.0}) molecules.emplace_back(ringOf(4, edge, 1.6), 1.4);
    for (const double scale : {1.8, 2.5}) molecules.emplace_back(icosahedron(scale, 1.7), 1.4);
    for (const double edge : {2.5, 3.5, 4.0, 4.4})
        molecules.emplace_back(latticeOf(2, edge, 1.5), 1.4);
    double worst = 0.0;
    for (auto& [balls, probe] : molecules) {
        const Excluded exact(balls, probe);
        // Quadrature of special positions needs them a little apart.
        std::mt19937 random(5);
        std::uniform_real_distribution<float> move(-1e-6f, 1e-6f);
        for (Ball& b : balls) b.center += Vec3f{move(random), move(random), move(random)};
        const Sliced sliced(balls, probe);
        const std::size_t n = std::size_t(&balls - &molecules[0].first);
        const double errors[] = {exact.all.area / sliced.area - 1.0,
                                 exact.all.volume / sliced.volume - 1.0};
        for (const double error : errors) {
            EXPECT_LT(std::abs(error), 1e-4) << n << " of " << balls.size();
            worst = std::max(worst, std::abs(error));
        }
    }
    RecordProperty("worst", std::to_string(worst));
}

/// The volume within p of the boundary of a union, by the area of the surfaces at all depths.
double shellByAreas(const Excluded& surface, double probe, int panels)
{
    constexpr double nodes[] = {0.0, 0.5384693101056831, 0.9061798459386640};
    constexpr double weights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    double sum = 0.0;
    for (int k = 0; k < panels; ++k) {
        for (int n = -2; n <= 2; ++n) {
            const double node = (n < 0 ? -1.0 : 1.0) * nodes[std::abs(n)];
            const double depth = probe * (k + 0.5 + 0.5 * node) / panels;
            const ExcludedMeasure at =
                measureExcluded(surface.boundary, surface.grown, depth, false, Progress());
            sum += 0.5 * probe / panels * weights[std::abs(n)] * totalsOf(at.pieces).area;
        }
    }
    return sum;
}

// With the grown balls kept, -area is the derivative of the volume by the probe radius.
TEST(ExcludedMeasure, VolumeIsTheIntegralOfTheArea)
{
    std::vector<std::vector<Ball>> molecules = {ringOf(12, 3.0, 1.7), latticeOf(3, 3.6, 1.5),
                                                icosahedron(2.5, 1.7)};
    for (unsigned seed = 0; seed < 12; ++seed)
        molecules.push_back(test::randomBalls(60, 8.0 + seed, Vec3d(50.0), seed));
    for (const auto& balls : molecules) {
        const Excluded surface(balls);
        const double grown = totalsOf(surface.grown.pieces).volume;
        const double volume = grown - shellByAreas(surface, excludedProbe, 12);
        EXPECT_NEAR(surface.all.volume, volume, 1e-5 * grown) << balls.size();
    }
}

TEST(ExcludedMeasure, SharesAddUp)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        const std::vector<Ball> balls = test::randomBalls(200, 18.0, Vec3d(5.0), seed);
        const Excluded surface(balls);
        double sum = 0.0;
        for (const double area : surface.areas(balls.size())) {
            EXPECT_GE(area, 0.0);
            sum += area;
        }
        EXPECT_NEAR(sum, surface.all.area, 1e-9 * sum);
        const ExcludedMeasure& m = surface.measure;
        EXPECT_NEAR(m.totalAreas().sum(), sum, 1e-9 * sum);
        EXPECT_GT(m.totalAreas().concave, 0.0);
        EXPECT_TRUE(m.topologyKnown);
    }
    const std::vector<Ball> twelve = ringOf(12, 3.0, 1.7);
    const Excluded symmetric(twelve);
    for (const double area : symmetric.areas(12))
        EXPECT_NEAR(area, symmetric.all.area / 12.0, 1e-4);
}

TEST(ExcludedMeasure, SharesAgreeWithSlices)
{
    for (unsigned seed = 0; seed < 5; ++seed) {
        std::vector<Ball> balls = test::randomBalls(7, 5.0, Vec3d(3.0), seed);
        balls[0].radius = 1.0f;
        balls[1].radius = 3.0f;
        const std::vector<double> areas = Excluded(balls).areas(balls.size());
        const Sliced sliced(balls, excludedProbe);
        for (std::size_t i = 0; i < balls.size(); ++i)
            EXPECT_NEAR(areas[i], sliced.areas[i], 2e-5 * sliced.area) << seed << " " << i;
    }
}

/// The share of a ball of two: along the torus to where |x - x_i|^2 - r_i^2 are equal.
TEST(ExcludedMeasure, SharesEndInThePowerPlane)
{
    const double r = 1.2, s = 2.0, d = 3.1, R = r + excludedProbe, S = s + excludedProbe;
    const Excluded two({ballAt(0, 0, 0, r), ballAt(d, 0, 0, s)});
    const double t = (d * d + R * R - S * S) / (2.0 * d), rho = std::sqrt(R * R - t * t);
    const double plane = (d * d + r * r - s * s) / (2.0 * d), left = t * r / R;
    const auto arc = [&](double x) {
        return rho - std::sqrt(excludedProbe * excludedProbe - (x - t) * (x - t));
    };
    const double share = 2.0 * M_PI * r * (r + left) + revolved(left, plane, arc).area;
    EXPECT_NEAR(two.areas(2)[0], share, 1e-5);
}

TEST(ExcludedMeasure, PinchedAndPiercedSurfaces)
{
    // A probe on either side of three balls: where they touch each other there is a hole.
    const Excluded three(ringOf(3, 3.0, 1.7));
    EXPECT_EQ(three.grown.pieces.size(), 1u);
    EXPECT_EQ(three.grown.pieces[0].eulerCharacteristic, 2);
    EXPECT_EQ(three.all.outer, 1);
    EXPECT_EQ(three.all.euler, 0);
    // Apart, each of its own.
    EXPECT_EQ(Excluded(ringOf(3, 3.2, 1.7)).all.outer, 3);
    EXPECT_EQ(Excluded(icosahedron(3.0, 1.7)).all.outer, 12);
    // A cavity of the centres of probes, and one that probes break open.
    const Excluded closed(icosahedron(2.2, 1.7)), open(icosahedron(2.5, 1.7));
    for (const Excluded* shell : {&closed, &open}) EXPECT_EQ(shell->grown.pieces.size(), 2u);
    EXPECT_EQ(closed.all.cavities, 1);
    EXPECT_EQ(closed.all.euler, 4);
    EXPECT_EQ(open.all.cavities, 0);
    EXPECT_EQ(open.all.outer, 1);
    EXPECT_EQ(open.all.euler, 2 - 2 * 19); // 20 windows
}

TEST(ExcludedMeasure, OrderPlaceAndScaleDoNotMatter)
{
    const std::vector<Ball> balls = test::randomBalls(80, 11.0, Vec3d(0.0), 9);
    const Excluded here(balls);
    std::vector<Ball> turned, grown;
    for (const Ball& b : balls) {
        const Vec3d x(b.center);
        const Vec3d y(0.36 * x.x() - 0.48 * x.y() + 0.8 * x.z(), 0.8 * x.x() + 0.6 * x.y(),
                      -0.48 * x.x() + 0.64 * x.y() + 0.6 * x.z());
        turned.push_back({Vec3f(y + Vec3d(30.0, -100.0, 7.0)), b.radius, 0});
        grown.push_back({b.center * 2.0f, b.radius * 2.0f, 0});
    }
    std::reverse(turned.begin(), turned.end());
    const Excluded there(turned), twice(grown, 2.0 * excludedProbe);
    EXPECT_NEAR(there.all.area, here.all.area, 1e-5 * here.all.area);
    EXPECT_NEAR(there.all.volume, here.all.volume, 1e-5 * here.all.volume);
    EXPECT_EQ(there.all.euler, here.all.euler);
    EXPECT_NEAR(twice.all.area, 4.0 * here.all.area, 1e-7 * twice.all.area);
    EXPECT_NEAR(twice.all.volume, 8.0 * here.all.volume, 1e-7 * twice.all.volume);
    std::vector<double> back = there.areas(balls.size());
    std::reverse(back.begin(), back.end());
    const std::vector<double> areas = here.areas(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_NEAR(back[i], areas[i], 1e-3);

    std::vector<Ball> other = balls;
    std::rotate(other.begin(), other.begin() + 31, other.end());
    const Excluded rotated(other);
    EXPECT_EQ(rotated.all.area, here.all.area);
    EXPECT_EQ(rotated.all.volume, here.all.volume);
}

// Probes in the cavity touch four balls; two triangles of a probe share a crease 10^-13 Å wide.
TEST(ExcludedMeasure, OfAHollowLatticeIsThatOfAMovedOne)
{
    std::vector<Ball> exact, moved;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> aside(-1e-5, 1e-5);
    const auto isInside = [](int k) { return k == 1 || k == 2; };
    for (int k = 0; k < 64; ++k) {
        const int x = k & 3, y = k >> 2 & 3, z = k >> 4;
        if (isInside(x) && isInside(y) && isInside(z)) continue;
        exact.push_back({3.2 * Vec3d(x, y, z), 1.7, 0});
        moved.push_back(exact.back());
        moved.back().center += Vec3d(aside(random), aside(random), aside(random));
    }
    const Excluded there(exact), near(moved);
    EXPECT_NEAR(there.all.area, near.all.area, 1e-3);
    EXPECT_NEAR(there.all.volume, near.all.volume, 1e-3);
    EXPECT_EQ(there.all.euler, near.all.euler);
    EXPECT_EQ(there.all.cavities, 1);
}

TEST(ExcludedMeasure, ThreadsDoNotMatter)
{
    const std::vector<Ball> balls = test::randomBalls(300, 20.0, Vec3d(0.0), 4);
    const Excluded many(balls);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Excluded single(balls);
    EXPECT_EQ(single.all.area, many.all.area);
    EXPECT_EQ(single.all.volume, many.all.volume);
    EXPECT_EQ(single.measure.areas, many.measure.areas);
}

TEST(ExcludedMeasure, PartsThatDoNotFitAreNotMeasured)
{
    const Excluded right(test::randomBalls(100, 12.0, Vec3d(0.0), 2));
    BallBoundary wrong = right.boundary;
    std::size_t open = 0;
    while (wrong.arcs[open].ends[0] < 0) ++open;
    wrong.arcs[open].half *= 0.9;
    EXPECT_THROW(measureExcluded(wrong, right.grown, excludedProbe, true, Progress()), Error);
    wrong = right.boundary;
    std::swap(wrong.arcs[open].ends[0], wrong.arcs[open].ends[1]); // no such corners
    EXPECT_THROW(measureExcluded(wrong, right.grown, excludedProbe, true, Progress()), Error);
}

} // namespace
} // namespace molsurf
