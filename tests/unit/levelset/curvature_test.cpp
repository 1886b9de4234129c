// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/curvature.h"

#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

struct Exact {
    Vec3d normal;
    double slope, mean, gauss;
};

struct Errors {
    double normal = 0.0, slope = 0.0, mean = 0.0, gauss = 0.0;
};

/// Largest errors at the voxels within 1.5 h of the zero set.
template<typename F>
Errors errorsOf(const test::Function& f, const test::Shape& shape, double h, const F& exact)
{
    const LeafTable table = test::bandTable(shape.distance, shape.centre, shape.extent, h, 1.5 * h);
    LeafTable wide = dilated(table, 1, Spread::Cube, Progress());
    const SparseField field = test::filled(wide, h, f);
    Errors worst;
    LeafBlock<float, 1> block;
    LeafCurvature out;
    std::int32_t last = noLeaf;
    test::forEachActive(table, h, [&](std::size_t n, int v, const Vec3d& x) {
        const std::int32_t m = wide.find(table.origin(n));
        if (m != last) {
            block.gather(field, m);
            curvature(block, table.active(n), float(h), out);
            last = m;
        }
        const Exact e = exact(x);
        for (int i = 0; i < 3; ++i)
            worst.normal = std::max(worst.normal, std::abs(out.normal[i][v] - e.normal[i]));
        worst.slope = std::max(worst.slope, std::abs(out.slope[v] - e.slope));
        worst.mean = std::max(worst.mean, std::abs(out.mean[v] - e.mean));
        worst.gauss = std::max(worst.gauss, std::abs(out.gauss[v] - e.gauss));
    });
    return worst;
}

template<typename F>
void expectSecondOrder(const test::Function& f, const test::Shape& shape, const F& exact,
                       const Errors& bound)
{
    const std::vector<double> h = {0.4, 0.2, 0.1};
    std::vector<double> normal, slope, mean, gauss;
    for (const double voxel : h) {
        const Errors e = errorsOf(f, shape, voxel, exact);
        normal.push_back(e.normal);
        slope.push_back(e.slope);
        mean.push_back(e.mean);
        gauss.push_back(e.gauss);
    }
    EXPECT_GT(test::observedOrder(h, normal), 1.8) << test::table(h, normal);
    EXPECT_GT(test::observedOrder(h, slope), 1.8) << test::table(h, slope);
    EXPECT_GT(test::observedOrder(h, mean), 1.8) << test::table(h, mean);
    EXPECT_GT(test::observedOrder(h, gauss), 1.8) << test::table(h, gauss);
    EXPECT_LT(normal.back(), bound.normal) << test::table(h, normal);
    EXPECT_LT(slope.back(), bound.slope) << test::table(h, slope);
    EXPECT_LT(mean.back(), bound.mean) << test::table(h, mean);
    EXPECT_LT(gauss.back(), bound.gauss) << test::table(h, gauss);
}

// (r^3 - R^3)/(3 R^2) is no distance: its Hessian has a part along the gradient.
TEST(Curvature, OfASphereIsOfSecondOrder)
{
    const test::Shape ball = test::sphere(3.0);
    const double R = ball.extent;
    expectSecondOrder(ball.smooth, ball,
                      [&](const Vec3d& x) {
                          const Vec3d d = x - ball.centre;
                          const double r = d.length();
                          return Exact{d / r, r * r / (R * R), 2.0 / r, 1.0 / (r * r)};
                      },
                      {1e-3, 1e-3, 1.5e-3, 1e-3});
}

// (s^2 - a^2)/(2 a), s the distance to the ring: a field of tori with curvature of both signs.
TEST(Curvature, OfATorusIsOfSecondOrder)
{
    const double A = 4.0, a = 1.6;
    const test::Pose pose;
    const test::Shape ring = test::torus(A, a, pose);
    const auto f = [=](const Vec3d& world) {
        const Vec3d x = pose.toLocal(world);
        const double u = std::hypot(x.x(), x.y()) - A;
        return (u * u + x.z() * x.z() - a * a) / (2.0 * a);
    };
    const auto exact = [=](const Vec3d& world) {
        const Vec3d x = pose.toLocal(world);
        const double rho = std::hypot(x.x(), x.y()), u = rho - A, s = std::hypot(u, x.z());
        const double across = (u / s) / rho; // curvature along the ring
        const Vec3d n(x.x() / rho * u / s, x.y() / rho * u / s, x.z() / s);
        return Exact{pose.turn * n, s / a, 1.0 / s + across, across / s};
    };
    expectSecondOrder(f, ring, exact, {2e-3, 2e-3, 3e-3, 3e-3});
}

TEST(Curvature, IsFiniteWhereTheGradientVanishes)
{
    LeafBlock<float, 1> block;
    std::fill_n(block.values, block.dim * block.dim * block.dim, 1.0f);
    LeafCurvature out;
    curvature(block, ~LeafMask(), 0.5f, out);
    for (int v = 0; v < leafSize; ++v) {
        ASSERT_TRUE(std::isfinite(out.mean[v]));
        ASSERT_TRUE(std::isfinite(out.gauss[v]));
        ASSERT_TRUE(std::isfinite(out.normal[0][v]));
    }
}

} // namespace
} // namespace molsurf
