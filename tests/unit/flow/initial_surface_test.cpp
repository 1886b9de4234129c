// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/initial_surface.h"

#include "support/convergence.h"
#include "support/exact_minimum.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

// One atom: psi = -C (r^2 - R^2), whose zero set is a sphere.
TEST(InitialSurface, OfOneAtomIsTheDistanceToItsSphere)
{
    const test::Shape ball = test::sphere(3.1);
    const double C = M_LN2 / (0.5 * 3.1);
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> everywhere, near;
    for (const double voxel : h) {
        const double width = 4.0 * voxel;
        const LeafTable table =
            test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
        const SparseField psi = test::filled(table, voxel, [&](const Vec3d& x) {
            return -C * ((x - ball.centre).lengthSqr() - 3.1 * 3.1);
        });
        const SparseField phi = initialSurface(psi, width, {}, Progress());
        double worst = 0.0, worstNear = 0.0;
        test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
            const double d = ball.distance(x);
            const double error = std::abs(phi.leaf(n)[v] - d);
            if (std::abs(d) < 3.0 * voxel) worst = std::max(worst, error);
            if (std::abs(d) < voxel) worstNear = std::max(worstNear, error);
        });
        everywhere.push_back(worst);
        near.push_back(worstNear);
    }
    EXPECT_GT(test::observedOrder(h, everywhere), 1.8) << test::table(h, everywhere);
    EXPECT_LT(everywhere.back(), 2e-3) << test::table(h, everywhere);
    EXPECT_GT(test::observedOrder(h, near), 1.8) << test::table(h, near);
    EXPECT_LT(near.back(), 1e-3) << test::table(h, near);
}

// With weights the start is where the flow will rest, to first order: one atom, whose minimum is
// known. The curvature moves it by 0.0065 Å.
TEST(InitialSurface, WithWeightsIsNearTheMinimum)
{
    const double R = 3.1, voxel = 0.25, C = M_LN2 / (0.5 * R), lambda = 0.02;
    const test::Shape ball = test::sphere(R);
    const LeafTable table =
        test::bandTable(ball.distance, ball.centre, ball.extent, voxel, 3.0 * voxel);
    const SparseField psi = test::filled(
        table, voxel, [&](const Vec3d& x) { return -C * ((x - ball.centre).lengthSqr() - R * R); });
    const double rest = test::minimalRadius(R, {0.5, lambda, Regularizer::Gradient});
    EXPECT_GT(rest - R, 0.04);
    const SparseField phi =
        initialSurface(psi, 3.0 * voxel, Weights{float(lambda), 0.0f}, Progress());
    double sum = 0.0, count = 0.0;
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const double d = (x - ball.centre).length() - rest;
        if (std::abs(d) >= 0.5 * voxel) return;
        sum += phi.leaf(n)[v] - d;
        count += 1.0;
    });
    EXPECT_NEAR(sum / count, 0.0, 0.006);
}

// The same for the area regulariser, whose curvature moves it inward by 0.017 Å.
TEST(InitialSurface, WithWeightsOfTheAreaIsNearTheMinimum)
{
    const double R = 3.1, voxel = 0.25, C = M_LN2 / (0.5 * R), lambda = 0.4;
    const test::Shape ball = test::sphere(R);
    const LeafTable table =
        test::bandTable(ball.distance, ball.centre, ball.extent, voxel, 3.0 * voxel);
    const SparseField psi = test::filled(
        table, voxel, [&](const Vec3d& x) { return -C * ((x - ball.centre).lengthSqr() - R * R); });
    const double rest = test::minimalRadius(R, {0.5, lambda, Regularizer::Area});
    EXPECT_LT(rest - R, -0.012);
    const SparseField phi =
        initialSurface(psi, 3.0 * voxel, Weights{0.0f, float(lambda)}, Progress());
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const double d = (x - ball.centre).length() - rest;
        if (std::abs(d) < 0.5 * voxel) {
            ASSERT_NEAR(phi.leaf(n)[v], d, 0.004);
        }
    });
}

// Away from its zero set a field may be anything: the distance is carried outward to the rim.
TEST(InitialSurface, IsTheDistanceWherePsiIsSteeper)
{
    const double R = 3.1, voxel = 0.25, width = 4.0 * voxel;
    const test::Shape ball = test::sphere(R);
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
    const SparseField psi = test::filled(table, voxel, [&](const Vec3d& x) {
        const double d = ball.distance(x);
        return -d * (1.0 + 2.0 * d * d);
    });
    const SparseField phi = initialSurface(psi, width, {}, Progress());
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const double d = ball.distance(x);
        if (std::abs(d) < 3.0 * voxel) {
            ASSERT_NEAR(phi.leaf(n)[v], d, 0.02) << d;
        }
    });
}

// Where psi is flat the first guess means nothing, but the result stays within the band and keeps
// its signs: psi has its maximum and vanishing gradient at the centre.
TEST(InitialSurface, IsFiniteAtTheCentreOfAnAtomAndKeepsSigns)
{
    const double voxel = 1.0, width = 4.0;
    const test::Shape ball = test::sphere(1.7);
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
    const SparseField psi = test::filled(
        table, voxel, [&](const Vec3d& x) { return 1.7 * 1.7 - (x - ball.centre).lengthSqr(); });
    const SparseField phi = initialSurface(psi, width, {}, Progress());
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d&) {
        ASSERT_TRUE(std::isfinite(phi.leaf(n)[v]));
        ASSERT_LE(std::abs(phi.leaf(n)[v]), width);
        ASSERT_EQ(phi.leaf(n)[v]<0.0f, psi.leaf(n)[v]> 0.0f);
    });
}

} // namespace
} // namespace molsurf
