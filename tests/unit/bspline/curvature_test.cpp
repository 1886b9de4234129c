// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bspline/spline.h"

#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

// The shape's smooth function, times another one without symmetry, is no distance, so every term of
// the formulas counts. The band is wide, since its rim disturbs second derivatives by a factor
// (2 + sqrt 3)^-n at n voxels whatever h: see the last test.
void expectSecondOrder(const test::Shape& shape, double meanBound, double gaussBound)
{
    const std::vector<double> h = {0.6, 0.3, 0.15};
    std::vector<double> mean, gauss;
    for (const double voxel : h) {
        const auto f = [&](const Vec3d& x) {
            return shape.smooth(x) * std::exp(0.2 * x.x() - 0.15 * x.y() + 0.1 * x.z());
        };
        const Spline spline =
            test::splineOf(f, shape.distance, shape.centre, shape.extent, voxel, 10.0 * voxel);
        SplineSampler sampler(spline);
        double m = 0.0, g = 0.0;
        for (const test::SurfacePoint& p : shape.points) {
            const Jet jet = sampler.at(p.x);
            m = std::max(m, std::abs(meanCurvature(jet) - p.mean));
            g = std::max(g, std::abs(gaussianCurvature(jet) - p.gauss));
        }
        mean.push_back(m);
        gauss.push_back(g);
    }
    EXPECT_GT(test::observedOrder(h, mean), 1.8) << test::table(h, mean);
    EXPECT_LT(mean.back(), meanBound) << test::table(h, mean);
    EXPECT_GT(test::observedOrder(h, gauss), 1.8) << test::table(h, gauss);
    EXPECT_LT(gauss.back(), gaussBound) << test::table(h, gauss);
}

TEST(SplineCurvature, OfASphere)
{
    expectSecondOrder(test::sphere(2.0), 1e-3, 1e-3);
}

TEST(SplineCurvature, OfATorus)
{
    expectSecondOrder(test::torus(4.0, 1.6), 3e-3, 3e-3);
}

TEST(SplineCurvature, OfAnEllipsoid)
{
    expectSecondOrder(test::ellipsoid(Vec3d(3.1, 2.4, 1.9)), 3e-3, 3e-3);
}

// As in the pipeline: a distance in a band of four voxels.
TEST(SplineCurvature, InANarrowBandIsWithinAPercent)
{
    for (const double voxel : {0.5, 0.25, 0.125}) {
        const test::Shape ball = test::sphere(1.7), ring = test::torus(4.0, 1.7);
        for (const test::Shape* shape : {&ball, &ring}) {
            const Spline spline = test::splineOf(shape->distance, shape->distance, shape->centre,
                                                 shape->extent, voxel, 4.0 * voxel);
            SplineSampler sampler(spline);
            double worst = 0.0;
            for (const test::SurfacePoint& p : shape->points)
                worst = std::max(worst, std::abs(meanCurvature(sampler.at(p.x)) - p.mean));
            EXPECT_LT(worst, voxel == 0.5 ? 0.03 / 1.7 : 0.01 / 1.7) << "h " << voxel;
        }
    }
}

// On a saddle z = x^2/2 - 2 y^2/2, turned: k = -1 and 2 with the outside above.
TEST(SplineCurvature, SignsAtASaddleOnABallAndInACavity)
{
    Jet saddle;
    saddle.value = 0.0;
    const test::Pose pose;
    const Mat3d H(-1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0);
    for (const double slope : {1.0, 3.0}) {
        saddle.gradient = pose.turn * Vec3d(0.0, 0.0, slope);
        saddle.hessian = slope * (pose.turn * H * pose.turn.transpose());
        EXPECT_NEAR(meanCurvature(saddle), 0.5, 1e-12);
        EXPECT_NEAR(gaussianCurvature(saddle), -2.0, 1e-12);
    }
    Jet ball;
    ball.gradient = Vec3d(0.0, 0.0, 1.0);
    ball.hessian = Mat3d(0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0);
    EXPECT_DOUBLE_EQ(meanCurvature(ball), 0.5);
    EXPECT_DOUBLE_EQ(gaussianCurvature(ball), 0.25);
    ball.gradient = -ball.gradient;
    ball.hessian *= -1.0;
    EXPECT_DOUBLE_EQ(meanCurvature(ball), -0.5); // the wall of a cavity
    EXPECT_DOUBLE_EQ(gaussianCurvature(ball), 0.25);
}

} // namespace
} // namespace molsurf
