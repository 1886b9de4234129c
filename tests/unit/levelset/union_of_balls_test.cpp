// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/levelset/union_distance.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

Ball ball(double x, double y, double z, double r)
{
    return {Vec3f(float(x), float(y), float(z)), float(r), 0};
}

/// The boundary points that can be nearest to x, by trying all balls, pairs and triples.
double exactDistance(const std::vector<Ball>& balls, double probe, const Vec3d& x)
{
    const std::size_t n = balls.size();
    const auto centre = [&](std::size_t i) { return Vec3d(balls[i].center); };
    const auto radius = [&](std::size_t i) { return balls[i].radius + probe; };
    double best = 1e30, outside = 1e30;
    const auto offer = [&](const Vec3d& y) {
        for (std::size_t i = 0; i < n; ++i) {
            if ((y - centre(i)).length() < radius(i) - 1e-7) return;
        }
        best = std::min(best, (y - x).length());
    };
    for (std::size_t i = 0; i < n; ++i) {
        outside = std::min(outside, (x - centre(i)).length() - radius(i));
        Vec3d u = x - centre(i);
        u.normalize();
        offer(centre(i) + radius(i) * u);
        for (std::size_t j = 0; j < i; ++j) {
            Vec3d e = centre(j) - centre(i);
            const double d = e.length();
            if (d >= radius(i) + radius(j) || d <= std::abs(radius(i) - radius(j))) continue;
            e /= d;
            const double t = (d * d + radius(i) * radius(i) - radius(j) * radius(j)) / (2.0 * d);
            const double rho = std::sqrt(radius(i) * radius(i) - t * t);
            const Vec3d m = centre(i) + t * e;
            Vec3d v = x - m;
            v -= v.dot(e) * e;
            v.normalize();
            offer(m + rho * v);
            for (std::size_t k = 0; k < j; ++k) { // points of the circle on sphere k
                const Vec3d w = centre(k) - m, side = w - w.dot(e) * e;
                const double a = side.length();
                if (a == 0.0) continue;
                const Vec3d e1 = side / a, e2 = e.cross(e1);
                const double cosine =
                    (w.lengthSqr() + rho * rho - radius(k) * radius(k)) / (2.0 * rho * a);
                if (std::abs(cosine) > 1.0) continue;
                const double sine = std::sqrt(1.0 - cosine * cosine);
                offer(m + rho * (cosine * e1 + sine * e2));
                offer(m + rho * (cosine * e1 - sine * e2));
            }
        }
    }
    return outside >= 0.0 ? outside : -best;
}

void expectExact(const std::vector<Ball>& balls, double probe, double voxel, double inside,
                 double outside, const char* what)
{
    const DistanceBand band =
        distanceToUnion(unionOf(balls, probe, Progress()), voxel, {inside, outside}, Progress());
    std::size_t active = 0, wanted = 0;
    double worst = 0.0;
    Vec3d low(1e9), high(-1e9);
    for (const Ball& b : balls) {
        low = openvdb::math::minComponent(low, Vec3d(b.center) - Vec3d(b.radius + probe + outside));
        high =
            openvdb::math::maxComponent(high, Vec3d(b.center) + Vec3d(b.radius + probe + outside));
    }
    const Coord from = Coord::floor(low / voxel), to = Coord::ceil(high / voxel);
    for (int i = from.x(); i <= to.x(); ++i) {
        for (int j = from.y(); j <= to.y(); ++j) {
            for (int k = from.z(); k <= to.z(); ++k) {
                const Coord c(i, j, k);
                const double d = exactDistance(balls, probe, c.asVec3d() * voxel);
                const std::int32_t n = band.phi.table.find(c);
                const int v = int(openvdb::FloatTree::LeafNodeType::coordToOffset(c));
                const bool on = n != noLeaf && band.phi.table.active(n).on(v);
                active += on;
                if (d > -inside + 1e-4 && d < outside - 1e-4) {
                    ++wanted;
                    ASSERT_TRUE(on) << what << " " << c << " " << d;
                }
                if (on) worst = std::max(worst, std::abs(band.phi.leaf(n)[v] - d));
            }
        }
    }
    EXPECT_GT(wanted, 100u) << what;
    EXPECT_LT(active, wanted + 50) << what;
    EXPECT_LT(worst, 2e-5) << what;
}

TEST(UnionOfBalls, DistanceIsExactOnBothSides)
{
    expectExact({ball(0.1, 0.2, 0.3, 1.7)}, 1.4, 0.5, 3.4, 0.6, "one");
    expectExact({ball(0, 0, 0, 1.7), ball(4, 0.3, 0.1, 1.5)}, 1.4, 0.5, 3.0, 2.0, "two");
    expectExact({ball(0, 0, 0, 1.7), ball(1.4, 0.3, 0.1, 1.5)}, 0.0, 0.25, 1.0, 1.0, "two, vdw");
    expectExact({ball(0, 0, 0, 1.7), ball(4, 0, 0, 1.7), ball(2, 3.4641016, 0, 1.7)}, 1.4, 0.4, 3.0,
                2.0, "three");
    expectExact(test::randomBalls(12, 7.0, Vec3d(3.0, -2.0, 1.0), 4), 1.4, 0.5, 3.4, 1.0, "twelve");
    expectExact(test::randomBalls(9, 5.0, Vec3d(3.0, -2.0, 1.0), 5), 0.0, 0.25, 1.5, 1.0, "nine");
    expectExact(test::randomBalls(12, 2.0, Vec3d(3.0, -2.0, 1.0), 6), 1.4, 1.0, 4.0, 2.0,
                "twelve close together, by large voxels");
}

// Equal, contained, touching and collinear balls, and four spheres through one point.
TEST(UnionOfBalls, DistanceOfSpecialPositions)
{
    expectExact({ball(0, 0, 0, 1.7), ball(0, 0, 0, 1.7), ball(0, 0, 0, 1.0)}, 1.4, 0.5, 2.0, 1.0,
                "equal and contained");
    expectExact({ball(0, 0, 0, 1.5), ball(3, 0, 0, 1.5)}, 0.0, 0.25, 1.0, 1.0, "touching");
    expectExact({ball(0, 0, 0, 1.5), ball(1.5, 0, 0, 1.5), ball(3, 0, 0, 1.5)}, 1.4, 0.5, 2.0, 1.0,
                "collinear");
    expectExact({ball(-0.06f, 0.75f, 0.75f, 2.0), ball(0.75f, 0.75f, 0.75f, 1.2f)}, 1.4, 0.5, 2.0,
                1.0, "a cap of nearly the whole sphere");
    expectExact({ball(0, 0, 0, 1.5), ball(2, 0, 0, 1.5), ball(0, 2, 0, 1.5), ball(2, 2, 0, 1.5)},
                1.0, 0.5, 3.0, 1.0, "a square");
    std::vector<Ball> cube;
    for (int k = 0; k < 8; ++k)
        cube.push_back(ball(2 * (k & 1), 2 * (k >> 1 & 1), k >> 1 & 2, 1.5));
    expectExact(cube, 0.5, 0.5, 2.0, 1.0, "a cube");
    std::vector<Ball> hexagon, far;
    for (int k = 0; k < 6; ++k) {
        hexagon.push_back(ball(2 * std::cos(k * M_PI / 3), 2 * std::sin(k * M_PI / 3), 0, 1.2));
        far.push_back(hexagon.back());
        far.back().center += Vec3f(65536, -65536, 32768);
    }
    expectExact(hexagon, 1.4, 0.5, 3.4, 0.6, "a hexagon");
    expectExact(hexagon, 1.4, 1.0, 5.4, 2.6, "a hexagon, by large voxels");
    expectExact(far, 1.4, 0.5, 3.4, 0.6, "a hexagon far from the origin");
    // Of the small ball's circle on the large one, the third ball covers less than half.
    expectExact({ball(0, 0, 0, 3), ball(3, 0, 0, 1.2), ball(3, 1.5, 0, 0.8)}, 0.0, 0.25, 1.5, 1.0,
                "an arc of more than half a circle");
}

TEST(UnionOfBalls, OneBallHasNoKink)
{
    for (const double voxel : {1.0, 0.5, 0.25}) {
        const std::vector<Ball> balls = {ball(0.1, 0.2, 0.3, 1.7)};
        const DistanceBand band =
            distanceToUnion(unionOf(balls, 1.4, Progress()), voxel, {3.5, 2.0}, Progress());
        for (std::size_t n = 0; n < band.kinks.size(); ++n)
            EXPECT_FALSE(band.kinks.active(n).any()) << voxel;
    }
}

// Two balls: inside, all points of their circle are equally near on the axis between the centres;
// outside, the balls are equally near on the plane of the circle. There the distance has its kinks
// and nowhere else, not below the edge, which is concave.
TEST(UnionOfBalls, KinksOfTwoBallsAreOnTheirAxisAndBetweenThem)
{
    constexpr double voxel = 0.25, apart = 6.0, R = 3.1;
    const Vec3d a(0.13, 0.37, -0.21), axis = Vec3d(0.8, 0.45, 0.4).unit(), b = a + apart * axis;
    const std::vector<Ball> balls = {ball(a.x(), a.y(), a.z(), 1.7),
                                     ball(b.x(), b.y(), b.z(), 1.7)};
    const DistanceBand band =
        distanceToUnion(unionOf(balls, R - 1.7, Progress()), voxel, {2.4, 2.0}, Progress());
    std::size_t inner = 0, outer = 0, beside = 0, marked = 0;
    for (std::size_t n = 0; n < band.phi.table.size(); ++n) {
        band.phi.table.active(n).forEach([&](int v) {
            const Coord c = band.phi.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            const Vec3d x = c.asVec3d() * voxel - a;
            const double along = x.dot(axis), aside = (x - along * axis).length();
            const bool inside = band.phi.leaf(n)[v] < 0.0f, kink = band.kinks.active(n).on(v);
            // The plane crosses the edge to the next voxel along x, well outside.
            if (!inside && along < 0.5 * apart && along + voxel * axis.x() > 0.5 * apart &&
                band.phi.leaf(n)[v] > 0.5f && band.phi.leaf(n)[v] < 1.5f) {
                ++beside;
                marked += kink;
            }
            if (!kink) return;
            ++(inside ? inner : outer);
            if (inside) {
                EXPECT_LT(aside, 1.5 * voxel);
                EXPECT_GT(along, -voxel);
                EXPECT_LT(along, apart + voxel);
            } else {
                EXPECT_LT(std::abs(along - 0.5 * apart), voxel);
            }
        });
    }
    EXPECT_GT(inner, std::size_t(3.0 / voxel)); // the depth of the band holds 2 x 2.2 Å of the axis
    EXPECT_GT(outer, 100u);
    EXPECT_EQ(marked, beside);
    EXPECT_GT(beside, 50u);
}

// Voxels on the axis of a circle itself, where every direction from it is as good.
TEST(UnionOfBalls, KinksOnVoxelsOfTheAxis)
{
    constexpr double voxel = 0.25;
    const std::vector<Ball> balls = {ball(-3, 0, 0, 1.7), ball(3, 0, 0, 1.7)};
    const DistanceBand band =
        distanceToUnion(unionOf(balls, 1.4, Progress()), voxel, {2.4, 1.0}, Progress());
    std::size_t inner = 0, onAxis = 0, marked = 0;
    for (std::size_t n = 0; n < band.phi.table.size(); ++n) {
        band.phi.table.active(n).forEach([&](int v) {
            const Coord c = band.phi.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            const bool kink = band.kinks.active(n).on(v);
            if (band.phi.leaf(n)[v] > 0.0f) return;
            inner += kink;
            // The arc is the nearest to what lies between the planes through it and the centres.
            if (c.y() != 0 || c.z() != 0 || std::abs(c.x()) * voxel > 1.0) return;
            ++onAxis;
            bool beside = false; // with the voxel before it or after it
            for (const Coord& d : {Coord(0, 0, 0), Coord(0, -1, 0), Coord(0, 0, -1)}) {
                const std::int32_t m = band.kinks.find(c + d);
                beside |= m != noLeaf &&
                          band.kinks.active(std::size_t(m))
                              .on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(c + d)));
            }
            marked += beside;
        });
    }
    EXPECT_GT(onAxis, 6u);
    EXPECT_EQ(marked, onAxis);
    EXPECT_LT(inner, 5 * std::size_t(6.0 / voxel)); // about the axis alone
}

// Kinks within a leaf and those between leaves are found in different ways.
TEST(UnionOfBalls, KinksDoNotDependOnTheLeaves)
{
    constexpr double voxel = 0.5;
    const auto kinksOf = [&](const Coord& shift, std::size_t& count) {
        std::vector<Ball> balls = test::randomBalls(30, 8.0, Vec3d(3.0, -2.0, 1.0), 8);
        for (Ball& b : balls) {
            for (int a = 0; a < 3; ++a) // so that nothing is rounded when they are shifted
                b.center[a] = std::round(1024.0f * b.center[a]) / 1024.0f;
            b.center += Vec3f(shift.asVec3s()) * float(voxel);
        }
        DistanceBand band =
            distanceToUnion(unionOf(balls, 1.4, Progress()), voxel, {3.4, 1.0}, Progress());
        count = band.kinks.activeCount();
        return std::move(band.kinks);
    };
    std::size_t count = 0, shifted = 0, missed = 0;
    const LeafTable kinks = kinksOf({0, 0, 0}, count);
    const Coord shift(3, 5, -2);
    const LeafTable other = kinksOf(shift, shifted);
    for (std::size_t n = 0; n < kinks.size(); ++n) {
        kinks.active(n).forEach([&](int v) {
            const Coord c = kinks.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7) + shift;
            const std::int32_t m = other.find(c);
            missed +=
                m == noLeaf || !other.active(std::size_t(m))
                                    .on(int(openvdb::FloatTree::LeafNodeType::coordToOffset(c)));
        });
    }
    EXPECT_GT(count, 1000u);
    // Balls are moved by 1e-9 Å, otherwise in each place, which decides a few.
    EXPECT_NEAR(double(count), double(shifted), 0.003 * double(count));
    EXPECT_LT(missed, std::size_t(0.003 * double(count)));
}

// Spheres that nearly meet in a voxel, inside of the union: all around are balls, but each foot
// there lies within rounding of a cap.
TEST(UnionOfBalls, NoBoundaryWhereSpheresMeetInside)
{
    for (const double radius : {5.0000005, 5.000003, 5.00001, 5.0001}) {
        const std::vector<Ball> balls = {ball(4, 3, 0, radius), ball(-4, 3, 0, radius),
                                         ball(0, -5, 0, radius), ball(0, 0, 5, radius),
                                         ball(0, 0, -5, radius)};
        const DistanceBand band =
            distanceToUnion(unionOf(balls, 0.0, Progress()), 0.5, {2.0, 1.0}, Progress());
        for (int k = 0; k < 27; ++k) {
            const Coord c(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
            const std::int32_t n = band.phi.table.find(c);
            if (n == noLeaf) continue;
            const int v = int(openvdb::FloatTree::LeafNodeType::coordToOffset(c));
            EXPECT_FALSE(band.phi.table.active(n).on(v)) << c << " " << radius;
            EXPECT_FLOAT_EQ(band.phi.leaf(n)[v], -2.0f) << c << " " << radius;
        }
    }
}

/// Area and volume by points spread evenly over every sphere.
void expectSampled(const std::vector<Ball>& balls, double probe, const BoundaryMeasure& measure,
                   double tolerance)
{
    constexpr int count = 20000;
    double area = 0.0, volume = 0.0;
    for (const Ball& b : balls) {
        const double R = b.radius + probe;
        for (int k = 0; k < count; ++k) {
            const double z = 1.0 - (2.0 * k + 1.0) / count, a = k * M_PI * (3.0 - std::sqrt(5.0));
            const double s = std::sqrt(1.0 - z * z);
            const Vec3d u(s * std::cos(a), s * std::sin(a), z), x = Vec3d(b.center) + R * u;
            const bool covered = std::any_of(balls.begin(), balls.end(), [&](const Ball& o) {
                return &o != &b && (x - Vec3d(o.center)).length() < o.radius + probe;
            });
            if (covered) continue;
            const double dA = 4.0 * M_PI * R * R / count;
            area += dA;
            volume += dA * x.dot(u) / 3.0;
        }
    }
    double exactArea = 0.0, exactVolume = 0.0, patches = 0.0;
    for (const BoundaryPiece& piece : measure.pieces) {
        exactArea += piece.area;
        exactVolume += piece.volume;
    }
    for (const double a : measure.patchAreas) patches += a;
    EXPECT_NEAR(exactArea, area, tolerance * area);
    EXPECT_NEAR(exactVolume, volume, tolerance * volume);
    EXPECT_NEAR(exactArea, patches, 1e-9 * area);
}

BoundaryMeasure measured(const std::vector<Ball>& balls, double probe = 0.0)
{
    return measureBoundary(ballBoundary(balls, probe, Progress()), Progress());
}

void expectPieces(const BoundaryMeasure& measure, std::vector<std::pair<int, int>> signAndEuler,
                  const char* what)
{
    std::vector<std::pair<int, int>> got;
    for (const BoundaryPiece& piece : measure.pieces) {
        got.emplace_back(piece.volume < 0.0 ? -1 : 1, piece.eulerCharacteristic);
    }
    std::sort(got.begin(), got.end());
    std::sort(signAndEuler.begin(), signAndEuler.end());
    EXPECT_EQ(got, signAndEuler) << what;
}

TEST(UnionOfBalls, AreaAndVolumeInClosedForm)
{
    const BoundaryMeasure one = measured({ball(5, 6, 7, 1.7)}, 1.4);
    ASSERT_EQ(one.pieces.size(), 1u);
    EXPECT_NEAR(one.pieces[0].area, 4.0 * M_PI * 3.1 * 3.1, 1e-5);
    EXPECT_NEAR(one.pieces[0].volume, 4.0 / 3.0 * M_PI * 3.1 * 3.1 * 3.1, 1e-5);

    // Two balls, each without the cap beyond the plane halfway.
    const double R = 3.1, h = R - 2.0;
    const BoundaryMeasure two = measured({ball(1, 2, 3, 1.7), ball(1, 6, 3, 1.7)}, 1.4);
    ASSERT_EQ(two.pieces.size(), 1u);
    EXPECT_NEAR(two.pieces[0].area, 2.0 * (4.0 * M_PI * R * R - 2.0 * M_PI * R * h), 1e-5);
    EXPECT_NEAR(two.pieces[0].volume,
                2.0 * (4.0 / 3.0 * M_PI * R * R * R - M_PI * h * h * (R - h / 3.0)), 1e-4);
}

TEST(UnionOfBalls, AreaAndVolumeOfMany)
{
    for (const unsigned seed : {1u, 2u, 3u}) {
        const std::vector<Ball> balls = test::randomBalls(60, 14.0, Vec3d(30.0, -20.0, 10.0), seed);
        expectSampled(balls, 1.4, measured(balls, 1.4), 0.003);
        expectSampled(balls, 0.0, measured(balls), 0.003);
    }
}

TEST(UnionOfBalls, PiecesAndTheirTopology)
{
    expectPieces(measured({ball(0, 0, 0, 1), ball(0, 0, 0, 1), ball(0.2, 0, 0, 0.5)}), {{1, 2}},
                 "equal and contained");
    expectPieces(measured({ball(0, 0, 0, 1), ball(5, 0, 0, 1)}), {{1, 2}, {1, 2}}, "apart");
    // The middle one keeps a belt between two caps.
    expectPieces(measured({ball(0, 0, 0, 1), ball(1.2, 0, 0, 1), ball(-1.2, 0, 0, 1)}), {{1, 2}},
                 "a belt");

    std::vector<Ball> ring;
    for (int k = 0; k < 12; ++k) {
        const double a = k * M_PI / 6.0;
        ring.push_back(ball(4.0 * std::cos(a), 4.0 * std::sin(a), 0.0, 1.3));
    }
    expectPieces(measured(ring), {{1, 0}}, "a ring");
    expectSampled(ring, 0.0, measured(ring), 0.003);

    // A belt of balls about a large one leaves it two faces; with balls within those, annuli.
    std::vector<Ball> belted = ring;
    belted.push_back(ball(0, 0, 0, 4.05));
    expectPieces(measured(belted), {{1, 2}}, "a belted ball");
    expectSampled(belted, 0.0, measured(belted), 0.003);
    belted.push_back(ball(0.3, 0.2, 4.0, 0.9));
    belted.push_back(ball(-0.3, 2.0, -3.3, 0.7));
    expectPieces(measured(belted), {{1, 2}}, "a belted ball with knobs");
    expectSampled(belted, 0.0, measured(belted), 0.003);

    // A closed shell holds a cavity, and in it a ball of its own.
    std::vector<Ball> shell;
    for (int k = 0; k < 200; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 200, a = k * M_PI * (3.0 - std::sqrt(5.0));
        const double s = std::sqrt(1.0 - z * z);
        shell.push_back(ball(8.0 * s * std::cos(a), 8.0 * s * std::sin(a), 8.0 * z, 1.9));
    }
    expectPieces(measured(shell), {{1, 2}, {-1, 2}}, "a shell");
    shell.push_back(ball(0.5, 0, 0, 2.0));
    expectPieces(measured(shell), {{1, 2}, {-1, 2}, {1, 2}}, "a ball in a shell");
    expectSampled(shell, 0.0, measured(shell), 0.003);
}

TEST(UnionOfBalls, OfNothing)
{
    const BallBoundary boundary = ballBoundary({}, 1.4, Progress());
    EXPECT_TRUE(measureBoundary(boundary, Progress()).pieces.empty());
    const std::vector<Ball> none;
    const BallUnion set = unionOf(none, 1.4, Progress());
    EXPECT_EQ(distanceToUnion(set, 0.5, {2.0, 1.0}, Progress()).phi.table.size(), 0u);
}

} // namespace
} // namespace molsurf
