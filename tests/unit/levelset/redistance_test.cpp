// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/redistance.h"

#include "support/convergence.h"
#include "support/fields.h"
#include "support/molecules.h"

#include <gtest/gtest.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

/// Vertices of OpenVDB's mesh of a level set.
std::vector<openvdb::Vec3f> verticesOf(const openvdb::FloatGrid& grid)
{
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(grid, points, quads);
    return points;
}

/// The distance of a shape in a band of four voxels, redistanced.
DistanceBand redistanced(const test::Function& distance, const Vec3d& centre, double extent,
                         double voxel, double inside, double outside)
{
    const LeafTable table = test::bandTable(distance, centre, extent, voxel, 4.0 * voxel);
    return redistance(test::filled(table, voxel, distance), {inside, outside}, -0.5 * inside,
                      Progress());
}

/// Largest error at the active voxels for which `counts` holds; checks that the active voxels are
/// those within the band, and that signs are right.
template<typename F>
double errorOf(const DistanceBand& band, const test::Function& distance, double voxel,
               double inside, double outside, const F& counts)
{
    double worst = 0.0;
    std::size_t wrong = 0;
    test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const double d = distance(x), value = band.phi.leaf(n)[v];
        wrong += (value < 0.0) != (d < 0.0) && std::abs(d) > 1e-5;
        EXPECT_GT(value, -inside);
        EXPECT_LT(value, outside);
        if (counts(x)) worst = std::max(worst, std::abs(value - d));
    });
    EXPECT_EQ(wrong, 0u) << "voxels changed sides";
    return worst;
}

/// The active voxels are those with -inside < d < outside, up to the error.
void expectComplete(const DistanceBand& band, const test::Function& distance, const Vec3d& centre,
                    double extent, double voxel, double inside, double outside, double error)
{
    const LeafTable wanted =
        test::bandTable(distance, centre, extent, voxel, -inside + error, outside - error);
    std::size_t missing = 0;
    test::forEachActive(wanted, voxel, [&](std::size_t, int, const Vec3d& x) {
        const Coord c = Coord::round(x / voxel);
        const std::int32_t n = band.phi.table.find(c);
        missing += n == noLeaf || !band.phi.table.active(n).on(
                                      int(openvdb::FloatTree::LeafNodeType::coordToOffset(c)));
    });
    EXPECT_EQ(missing, 0u);
}

const auto everywhere = [](const Vec3d&) { return true; };

void expectOrder(const test::Shape& shape, double inside, double outside, double order,
                 double bound, const std::vector<double>& h = {0.5, 0.25, 0.125})
{
    std::vector<double> error;
    for (const double voxel : h) {
        const DistanceBand band =
            redistanced(shape.distance, shape.centre, shape.extent, voxel, inside, outside);
        error.push_back(errorOf(band, shape.distance, voxel, inside, outside, everywhere));
        expectComplete(band, shape.distance, shape.centre, shape.extent, voxel, inside, outside,
                       error.back());
    }
    EXPECT_GT(test::observedOrder(h, error), order) << test::table(h, error);
    EXPECT_LT(error.back(), bound) << test::table(h, error);
}

TEST(Redistance, OfASphere)
{
    // Floats of some 27 voxels: the order shows less at this size of error.
    expectOrder(test::sphere(7.0), 3.4, 0.5, 1.5, 5e-6);
}

TEST(Redistance, OfATorus)
{
    expectOrder(test::torus(6.0, 3.4), 1.8, 0.6, 1.8, 1e-3);
}

TEST(Redistance, OfAnEllipsoid)
{
    expectOrder(test::ellipsoid(Vec3d(6.0, 5.2, 4.6)), 1.7, 0.6, 1.8, 1e-3, {0.6, 0.4, 0.25});
}

// One atom with its probe: the depth that a run asks for comes near the centre of curvature, where
// the expansion's determinant goes to zero with its numerator.
TEST(Redistance, DeepInASphere)
{
    for (const double voxel : {0.5, 0.25}) {
        const test::Shape ball = test::sphere(5.0);
        const DistanceBand band =
            redistanced(ball.distance, ball.centre, ball.extent, voxel, 3.4, 0.5);
        EXPECT_LT(errorOf(band, ball.distance, voxel, 3.4, 0.5, everywhere), 0.001 * voxel);
    }
}

// The nearest closest point must reach voxels however many lie between.
TEST(Redistance, ManyVoxelsDeep)
{
    const test::Shape ball = test::sphere(5.0);
    for (const double voxel : {0.16, 0.125}) {
        const DistanceBand band =
            redistanced(ball.distance, ball.centre, ball.extent, voxel, 2.7, 0.5);
        EXPECT_LT(errorOf(band, ball.distance, voxel, 2.7, 0.5, everywhere), 1e-4) << voxel;
    }
}

// From inside, the nearest surface point of a voxel behind the crease of two balls lies on the
// circle that they share. The spline rounds that crease within a voxel, so there the error is of
// first order; elsewhere of second.
TEST(Redistance, OfTwoBallsBehindTheirCrease)
{
    const Vec3d a(0.137, -0.291, 0.443), axis = Vec3d(0.6, -0.5, 0.7).unit(), b = a + 5.0 * axis;
    const double R = 4.6, S = 4.2, inside = 2.2, outside = 0.5;
    const auto distance = [=](const Vec3d& x) { return test::distanceToTwoBalls(x, a, R, b, S); };
    const Vec3d middle = 0.5 * (a + b);
    const double along = (25.0 + R * R - S * S) / 10.0, rho = std::sqrt(R * R - along * along);
    const auto behind = [=](const Vec3d& x) { // nearest to the circle
        const double s = (x - a).dot(axis), t = (x - a - s * axis).length();
        const double toCircle = std::hypot(s - along, t - rho);
        return std::abs(-distance(x) - toCircle) < 1e-9;
    };
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> smooth, crease;
    for (const double voxel : h) {
        const DistanceBand band = redistanced(distance, middle, 7.2, voxel, inside, outside);
        smooth.push_back(errorOf(band, distance, voxel, inside, outside, [&](const Vec3d& x) {
            // The crease, rounded a little inward, is nearest to some voxels beside it too.
            const bool onA = (x - a).length() - R < (x - b).length() - S;
            const Vec3d y = onA ? a + R * (x - a).unit() : b + S * (x - b).unit();
            const double s = (y - a).dot(axis) - along, t = (y - a).cross(axis).length() - rho;
            return !behind(x) && std::hypot(s, t) > 1.5;
        }));
        crease.push_back(errorOf(band, distance, voxel, inside, outside, behind));
    }
    EXPECT_GT(test::observedOrder(h, crease), 0.8) << test::table(h, crease);
    for (std::size_t i = 0; i < h.size(); ++i)
        EXPECT_LT(crease[i], 0.6 * h[i]) << test::table(h, crease);
    EXPECT_GT(test::observedOrder(h, smooth), 1.5) << test::table(h, smooth);
    EXPECT_LT(smooth.back(), 0.01) << test::table(h, smooth);
}

std::size_t kinksWhere(const DistanceBand& band, double voxel,
                       const std::function<bool(const Vec3d&)>& where, std::size_t& total)
{
    std::size_t count = 0;
    total = 0;
    for (std::size_t n = 0; n < band.phi.table.size(); ++n) {
        band.kinks.active(n).forEach([&](int v) {
            EXPECT_TRUE(band.phi.table.active(n).on(v));
            const Coord c = band.phi.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            count += where(c.asVec3d() * voxel);
            ++total;
        });
    }
    return count;
}

// A flat ellipsoid: in its middle the two sheets are equally far. Kinks are marked there, beside
// the plane of symmetry, and nowhere near the surface.
TEST(Redistance, MarksTheKinkWhereTwoSheetsMeet)
{
    const double voxel = 0.25;
    const test::Pose pose;
    const test::Shape slab = test::ellipsoid(Vec3d(7.0, 7.0, 2.0), pose);
    const DistanceBand band = redistanced(slab.distance, slab.centre, slab.extent, voxel, 3.0, 0.5);
    // Every voxel of the disc whose upper or lower neighbour lies on the other side of the plane.
    std::size_t beside = 0, marked = 0;
    test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& world) {
        const Vec3d x = pose.toLocal(world);
        if (std::hypot(x.x(), x.y()) > 4.0) return;
        bool crosses = false;
        for (int i = 0; i < 3; ++i) {
            Vec3d next = world;
            next[i] += voxel;
            crosses |= (pose.toLocal(next).z() < 0.0) != (x.z() < 0.0);
        }
        beside += crosses;
        marked += crosses && band.kinks.active(n).on(v);
    });
    ASSERT_GT(beside, 500u);
    EXPECT_GT(double(marked), 0.98 * double(beside)) << marked << " of " << beside;
    std::size_t total = 0;
    const std::size_t far = kinksWhere(
        band, voxel,
        [&](const Vec3d& world) { return std::abs(pose.toLocal(world).z()) > 2.0 * voxel; }, total);
    EXPECT_EQ(far, 0u) << "of " << total;
}

// One atom with its probe, and one on a point of the grid: curvature explains every turn, also at
// the centre, where the closest points of two voxels are opposite to each other.
TEST(Redistance, MarksNoKinkInASphereDownToItsCentre)
{
    for (const double radius : {3.1, 2.6}) {
        for (const Vec3d& centre :
             {Vec3d(0.137, -0.291, 0.443), Vec3d(0.0), Vec3d(0.5, 0.0, 0.0)}) {
            const auto distance = [&](const Vec3d& x) { return (x - centre).length() - radius; };
            for (const double voxel : {1.0, 0.5, 0.25}) {
                const DistanceBand band =
                    redistanced(distance, centre, radius, voxel, radius + voxel, voxel);
                std::size_t total = 0;
                kinksWhere(band, voxel, everywhere, total);
                EXPECT_EQ(total, 0u) << radius << " " << centre << " " << voxel;
            }
        }
    }
}

// Below the concave edge of two balls, rounded as by a sum of Gaussians, the direction to the
// closest point turns as fast, about the edge, and the distance is smooth.
TEST(Redistance, MarksNoKinkBelowAConcaveEdge)
{
    constexpr double R = 6.0, sharpness = 3.0; // [Å], [1/Å]
    const Vec3d a(-4.03, 0.1, -0.2), b(4.01, -0.1, 0.1);
    const auto distance = [&](const Vec3d& x) {
        const double s = (x - a).length() - R, t = (x - b).length() - R;
        return std::min(s, t) - std::log1p(std::exp(-sharpness * std::abs(s - t))) / sharpness;
    };
    const double edge = std::sqrt(R * R - 0.25 * (b - a).lengthSqr());
    for (const double voxel : {0.5, 0.25}) {
        const DistanceBand band = redistanced(distance, Vec3d(0.0), 10.5, voxel, 3.0, 0.5);
        std::size_t total = 0;
        EXPECT_EQ(kinksWhere(
                      band, voxel,
                      [&](const Vec3d& x) {
                          const double r = std::hypot(x.y(), x.z());
                          return distance(x) < 0.0 && std::abs(x.x()) < 1.0 && r > edge - 3.0;
                      },
                      total),
                  0u)
            << "of " << total;
    }
}

// The surface of some Gaussians, which has creases: a voxel has the distance of the closest point
// itself, also where one step from the nearest point known does not lead there.
TEST(Redistance, IsExactBesideCreases)
{
    constexpr double voxel = 0.5, fine = 0.1, R = 3.1, slope = 4.0 * M_LN2;
    const std::vector<Ball> balls = test::randomBalls(14, 9.0, Vec3d(0.1, -0.2, 0.3), 3);
    const auto f = [&](const Vec3d& x) {
        std::vector<double> terms;
        for (const Ball& ball : balls)
            terms.push_back(-slope / (2.0 * R) * ((x - Vec3d(ball.center)).lengthSqr() - R * R));
        const double top = *std::max_element(terms.begin(), terms.end());
        double sum = 0.0;
        for (const double t : terms) sum += std::exp(t - top);
        return -(top + std::log(sum)) / slope;
    };
    const DistanceBand band = redistanced(f, Vec3d(0.0), 9.0, voxel, 2.0, 1.0);
    // The zero set of the spline is the surface.
    const Spline spline = test::splineOf(f, f, Vec3d(0.0), 9.0, voxel, 4.0 * voxel);
    SplineSampler sampler(spline);
    const auto value = [&](const Vec3d& x) { return sampler.at(x).value; };
    const LeafTable table = test::bandTable(f, Vec3d(0.0), 9.0, fine, 5.0 * fine);
    const auto grid = toLevelSet(test::filled(table, fine, value), 2.0 * fine, Progress());
    std::vector<Vec3d> points;
    for (const openvdb::Vec3f& p : verticesOf(*grid)) points.emplace_back(p);
    ASSERT_GT(points.size(), 20000u);

    double worst = 0.0;
    std::size_t count = 0, off = 0;
    test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        // Some of those near the level that is wanted, which get the best distances.
        if (v % 3 != 0 || std::abs(band.phi.leaf(n)[v] + 1.0) > 0.9) return;
        double least2 = 1e9;
        for (const Vec3d& p : points) least2 = std::min(least2, (x - p).lengthSqr());
        const double e = std::abs(std::abs(band.phi.leaf(n)[v]) - std::sqrt(least2));
        ++count;
        worst = std::max(worst, e);
        off += e > 0.05 * voxel;
    });
    EXPECT_GT(count, 500u);
    EXPECT_LT(double(off), 0.004 * double(count)) << off << " of " << count;
    EXPECT_LT(worst, 0.05); // [Å]
}

TEST(Redistance, OfNothingIsNothing)
{
    const DistanceBand band =
        redistance({LeafTable(), LeafField(0), 0.5}, {3.0, 1.0}, 0.0, Progress());
    EXPECT_EQ(band.phi.table.size(), 0u);
}

// Where two balls of radius 10 meet in an edge at which the normal turns by 40 degrees; 51 degrees
// two Å below it.
TEST(Redistance, MarksAKinkOfFortyDegrees)
{
    const double voxel = 0.5, R = 10.0, apart = R * std::sin(20.0 * M_PI / 180.0);
    const Vec3d shift(0.13, -0.21, 0.08);
    const auto lens = [&](const Vec3d& world) {
        const Vec3d x = world - shift;
        return std::max((x - Vec3d(apart, 0, 0)).length(), (x + Vec3d(apart, 0, 0)).length()) - R;
    };
    const DistanceBand band = redistanced(lens, shift, 11.0, voxel, 3.0, 0.5);
    std::size_t beside = 0, marked = 0;
    test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& world) {
        const double depth = -lens(world), x = world.x() - shift.x();
        if (depth < 1.0 || depth > 2.0 || x > 0.0 || x + voxel <= 0.0) return;
        ++beside;
        marked += band.kinks.active(n).on(v);
    });
    ASSERT_GT(beside, 200u);
    EXPECT_GT(double(marked), 0.9 * double(beside)) << marked << " of " << beside;
}

// The middle of a slab across each axis: every voxel below it has a kink to the next one up.
TEST(Redistance, MarksTheKinkOfASlabAcrossEachAxis)
{
    constexpr double voxel = 0.5;
    test::Pose square; // on the voxels
    square.turn = openvdb::Mat3d::identity();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d axes(5.0);
        axes[axis] = 2.0;
        const test::Shape slab = test::ellipsoid(axes, square);
        const DistanceBand band =
            redistanced(slab.distance, slab.centre, slab.extent, voxel, 3.0, 0.5);
        std::size_t beside = 0, marked = 0;
        test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& world) {
            Vec3d x = square.toLocal(world);
            const double height = x[axis];
            x[axis] = 0.0;
            if (x.length() > 2.5 || height > 0.0 || height + voxel <= 0.0) return;
            ++beside;
            marked += band.kinks.active(n).on(v);
        });
        EXPECT_GT(beside, 70u) << axis;
        EXPECT_EQ(marked, beside) << axis;
    }
}

// A wall of less than a voxel: each of its sides has closest points of its own, as those of one
// side are none of the other's.
TEST(Redistance, OfAWallThinnerThanAVoxel)
{
    constexpr double voxel = 0.5, middle = 0.05, half = 0.2; // [Å]
    for (int axis = 0; axis < 3; ++axis) {
        const auto distance = [=](const Vec3d& x) { return std::abs(x[axis] - middle) - half; };
        const auto smooth = [=](const Vec3d& x) { // of slope 1 at both sides
            const double t = x[axis] - middle;
            return (t * t - half * half) / (2.0 * half);
        };
        const LeafTable table = test::bandTable(distance, Vec3d(0.0), 8.0, voxel, 4.0 * voxel);
        const DistanceBand band =
            redistance(test::filled(table, voxel, smooth), {1.0, 1.0}, 0.0, Progress());
        std::size_t count = 0;
        test::forEachActive(band.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
            if (x.length() > 3.0) return; // far from where the wall ends
            ++count;
            EXPECT_NEAR(band.phi.leaf(n)[v], distance(x), 0.004 * voxel) << x;
        });
        EXPECT_GT(count, 500u);
    }
}

} // namespace
} // namespace molsurf
