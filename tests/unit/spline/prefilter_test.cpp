// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/spline.h"

#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

double wave(const Vec3d& x)
{
    return std::sin(1.1 * x.x() + 0.3) * std::cos(0.8 * x.y() - 0.5 * x.z()) +
           0.3 * std::sin(1.4 * x.z() + 0.2 * x.x());
}

// Away from the rim of the band by `deep` voxels the influence of the end condition and of the cut
// of the window has decayed by (2 + sqrt 3)^deep.
TEST(Prefilter, InterpolatesAtInnerVoxels)
{
    const test::Shape ring = test::torus(4.0, 1.9);
    const double voxel = 0.3;
    const Spline spline =
        test::splineOf(wave, ring.distance, ring.centre, ring.extent, voxel, 6.0 * voxel);
    SplineSampler sampler(spline);
    double inner = 0.0;
    std::size_t count = 0;
    test::forEachActive(spline.table(), voxel, [&](std::size_t, int, const Vec3d& x) {
        if (std::abs(ring.distance(x)) > 2.0 * voxel) return;
        inner = std::max(inner, std::abs(sampler.at(x).value - wave(x)));
        ++count;
    });
    ASSERT_GT(count, 5000u);
    EXPECT_LT(inner, 1e-5);
}

TEST(Prefilter, OfAConstantIsThatConstant)
{
    const test::Shape ball = test::sphere(2.0);
    const Spline spline = test::splineOf([](const Vec3d&) { return -2.75; }, ball.distance,
                                         ball.centre, ball.extent, 0.4, 1.6);
    // 16 units in the last place: along each axis some ten operations are rounded, one by one where
    // the processor does not fuse them.
    test::forEachActive(spline.table(), 0.4, [&](std::size_t n, int v, const Vec3d&) {
        ASSERT_NEAR(spline.coefficients.leaf(n)[v], -2.75f, 4e-6f);
    });
}

// The whole inside of a ball, so that lines of voxels cross several leaves.
TEST(Prefilter, IsExactForLinearAndQuadraticFunctionsInside)
{
    const test::Shape ball = test::sphere(5.0);
    const auto linear = [](const Vec3d& x) { return 0.7 + x.dot(Vec3d(0.3, -0.8, 0.5)); };
    const auto quadratic = [](const Vec3d& x) {
        return 0.2 + 0.15 * x.x() * x.x() - 0.1 * x.y() * x.y() + 0.07 * x.x() * x.z() -
               0.12 * x.y() * x.z() + 0.05 * x.z() * x.z();
    };
    const double voxel = 0.25;
    const LeafTable table =
        test::bandTable(ball.distance, ball.centre, ball.extent, voxel, -100.0, 0.0);
    for (const bool second : {false, true}) {
        const test::Function f = second ? test::Function(quadratic) : test::Function(linear);
        const Spline spline{prefilter(test::filled(table, voxel, f), Progress())};
        SplineSampler sampler(spline);
        double worst = 0.0, slope = 0.0;
        for (const test::SurfacePoint& p : ball.points) {
            const Vec3d x = ball.centre + 0.5 * (p.x - ball.centre);
            const Jet jet = sampler.at(x);
            worst = std::max(worst, std::abs(jet.value - f(x)));
            for (int i = 0; i < 3; ++i) {
                Vec3d e(0.0);
                e[i] = 0.1; // central differences are exact too
                slope = std::max(slope, std::abs(jet.gradient[i] - (f(x + e) - f(x - e)) / 0.2));
            }
        }
        // The window of 8 voxels on either side cuts 3e-5 of c - s, which is h^2 f''/6.
        EXPECT_LT(worst, 3e-6);
        EXPECT_LT(slope, 1e-5);
    }
}

} // namespace
} // namespace molsurf
