// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/reinitialize.h"

#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// A smooth factor between 0.8 and 1.25 that has no symmetry.
double wobble(const Vec3d& x)
{
    return 1.02 + 0.2 * std::sin(0.9 * x.x() + 0.4) * std::cos(0.7 * x.y() - 0.3 * x.z());
}

void iterate(SparseField& phi, double width, int iterations)
{
    reinitialize(phi, width, iterations, Progress());
}

/// The distance times wobble, in a band of four voxels.
SparseField perturbed(const test::Shape& shape, double voxel)
{
    const LeafTable table =
        test::bandTable(shape.distance, shape.centre, shape.extent, voxel, 4.0 * voxel);
    return test::filled(table, voxel,
                        [&](const Vec3d& x) { return shape.distance(x) * wobble(x); });
}

/// Largest error of phi at the voxels closer than `reach` voxels to the zero set.
double errorOf(const SparseField& run, const test::Function& distance, double voxel, double reach)
{
    double worst = 0.0;
    test::forEachActive(run.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const double d = distance(x);
        if (std::abs(d) < reach * voxel) worst = std::max(worst, std::abs(run.leaf(n)[v] - d));
    });
    return worst;
}

/// Mean and largest distance of the zero set from the shape's points, along their normals.
std::pair<double, double> offsets(const SparseField& run, const test::Shape& shape, double voxel)
{
    const Spline spline{prefilter(run, Progress())};
    double mean = 0.0, largest = 0.0;
    for (const test::SurfacePoint& p : shape.points) {
        const double t = test::zeroOnRay(spline, p.x, p.n, -voxel, voxel);
        mean += t / double(shape.points.size());
        largest = std::max(largest, std::abs(t));
        if (!(std::abs(t) < voxel)) return {NAN, NAN};
    }
    return {mean, largest};
}

class Reinitialize : public testing::TestWithParam<int>
{
protected:
    test::Shape shape() const
    {
        return GetParam() == 0 ? test::sphere(3.1) : test::torus(4.0, 1.9);
    }
};

TEST_P(Reinitialize, ReachesTheDistanceAtSecondOrder)
{
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> error;
    for (const double voxel : h) {
        SparseField run = perturbed(shape(), voxel);
        iterate(run, 4.0 * voxel, 12);
        error.push_back(errorOf(run, shape().distance, voxel, 3.0));
    }
    // Changes below 0.02 voxel are damped on purpose, which leaves up to that much: the second
    // order shows until then.
    EXPECT_GT(test::observedOrder(h, error), 1.7) << test::table(h, error);
    EXPECT_LT(error.back(), 0.025 * h.back()) << test::table(h, error);
}

// The interface of a field that is no distance moves in the first call, by the error of the Taylor
// polynomial; after that it must stay.
TEST_P(Reinitialize, KeepsTheInterfaceInPlace)
{
    const double voxel = 0.25;
    SparseField run = perturbed(shape(), voxel);
    iterate(run, 4.0 * voxel, 2);
    const auto [mean1, largest1] = offsets(run, shape(), voxel);
    EXPECT_LT(std::abs(mean1), 2e-4);
    EXPECT_LT(largest1, 4e-3);
    for (int i = 1; i < 10; ++i) iterate(run, 4.0 * voxel, 2);
    const auto [mean10, largest10] = offsets(run, shape(), voxel);
    EXPECT_LT(std::abs(mean10 - mean1), 2e-4);
    EXPECT_LT(largest10, 4e-3);
    for (int i = 10; i < 100; ++i) iterate(run, 4.0 * voxel, 2);
    const auto [mean100, largest100] = offsets(run, shape(), voxel);
    EXPECT_LT(std::abs(mean100 - mean1), 2e-4);
    EXPECT_LT(largest100, 4e-3);
}

// The flow calls it at every step on what is already a distance.
TEST_P(Reinitialize, LeavesADistanceAlone)
{
    const double voxel = 0.25;
    SparseField run =
        test::filled(test::bandTable(shape().distance, shape().centre, shape().extent, voxel, 1.0),
                     voxel, shape().distance);
    const auto [mean0, largest0] = offsets(run, shape(), voxel);
    for (int i = 0; i < 100; ++i) iterate(run, 4.0 * voxel, 2);
    const auto [mean, largest] = offsets(run, shape(), voxel);
    EXPECT_LT(std::abs(mean - mean0), 1e-4); // a hundred calls
    EXPECT_LT(largest, largest0 + 5e-4);
    EXPECT_LT(errorOf(run, shape().distance, voxel, 3.0), 0.03 * voxel);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Reinitialize, testing::Values(0, 1),
                         [](const auto& info) { return info.param == 0 ? "Sphere" : "Torus"; });

// Two balls that overlap: the distance has a kink on both sides of the crease. Away from it the
// order is two; at it the error is bounded by the voxel.
TEST(ReinitializeTwoBalls, IsOfSecondOrderAwayFromTheCrease)
{
    const Vec3d a(0.137, -0.291, 0.443), axis = Vec3d(0.6, -0.5, 0.7).unit(), b = a + 3.0 * axis;
    const double R = 2.6;
    const auto distance = [=](const Vec3d& x) { return test::distanceToTwoBalls(x, a, R, b, R); };
    const Vec3d middle = 0.5 * (a + b);
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> error, crease;
    for (const double voxel : h) {
        SparseField run =
            test::filled(test::bandTable(distance, middle, 4.2, voxel, 4.0 * voxel), voxel,
                         [&](const Vec3d& x) { return distance(x) * wobble(x); });
        iterate(run, 4.0 * voxel, 12);
        double worst = 0.0, worstCrease = 0.0;
        test::forEachActive(run.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
            const double d = distance(x);
            if (std::abs(d) > 3.0 * voxel) return;
            const bool near = std::abs((x - middle).dot(axis)) < 1.2;
            double& e = near ? worstCrease : worst;
            e = std::max(e, std::abs(run.leaf(n)[v] - d));
        });
        error.push_back(worst);
        crease.push_back(worstCrease);
    }
    EXPECT_GT(test::observedOrder(h, error), 1.8) << test::table(h, error);
    EXPECT_LT(error.back(), 3e-3) << test::table(h, error);
    for (std::size_t i = 0; i < h.size(); ++i)
        EXPECT_LT(crease[i], 0.4 * h[i]) << test::table(h, crease);
}

TEST(ReinitializeBand, StaysWithinItsWidthAndKeepsSigns)
{
    const test::Shape ball = test::sphere(2.0);
    const double voxel = 0.4, width = 1.2;
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
    const SparseField before = test::filled(table, voxel, ball.smooth);
    SparseField phi = test::filled(table, voxel, ball.smooth);
    iterate(phi, width, 6);
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d&) {
        ASSERT_LE(std::abs(phi.leaf(n)[v]), float(width));
        ASSERT_EQ(phi.leaf(n)[v] < 0.0f, before.leaf(n)[v] < 0.0f);
    });
}

} // namespace
} // namespace molsurf
