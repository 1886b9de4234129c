// SPDX-License-Identifier: MPL-2.0
#include "support/convergence.h"
#include "support/exact_minimum.h"
#include "support/fields.h"
#include "support/flow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

// The minimiser itself: one atom off the origin of the polar coordinates is a sphere again.
TEST(MinimalCurve, OfOneAtomIsItsSphere)
{
    const double z = 0.7;
    for (const test::Energy& energy : {test::Energy{}, test::Energy{0.5, 0.1, Regularizer::Area}}) {
        const double radius = test::minimalRadius(3.1, energy);
        const test::PolarCurve curve = test::minimalCurve({{z, 3.1}}, energy, 1500);
        EXPECT_TRUE(curve.stationary);
        double worst = 0.0;
        for (double t = 0.05; t < M_PI; t += 0.05) {
            const double rho = curve.at(t);
            worst = std::max(
                worst, std::abs(std::hypot(rho * std::cos(t) - z, rho * std::sin(t)) - radius));
        }
        EXPECT_LT(worst, 2e-5);
    }
}

struct Errors {
    double mean, largest;
};

/// Distances, along rays from the middle, of the evolved surface to the curve, at random azimuths.
Errors errorsOf(const test::PolarCurve& curve, const test::Energy& energy, double voxel, int steps)
{
    const Vec3d middle(0.137, -0.291, 0.443);
    const Vec3d axis = Vec3d(0.48, -0.36, 0.8);
    const Vec3d side = axis.cross(Vec3d(1.0, 0.2, 0.0)).unit(), third = axis.cross(side);
    EvolveOptions options;
    options.lambda = energy.lambda;
    options.regularizer = energy.regularizer;
    options.steps = steps;
    const std::vector<Ball> balls = {{Vec3f(middle + 2.0 * axis), 1.7f, 0},
                                     {Vec3f(middle - 2.0 * axis), 1.7f, 1}};
    const test::Evolved out = test::evolveBalls(balls, energy.epsilon, voxel, options);
    Errors errors{0.0, 0.0};
    const int count = 600;
    for (int i = 0; i < count; ++i) {
        const double theta = M_PI * (i + 0.5) / count, azimuth = 2.399963 * i;
        const Vec3d ray = std::cos(theta) * axis +
                          std::sin(theta) * (std::cos(azimuth) * side + std::sin(azimuth) * third);
        const double rho = curve.at(theta);
        const double t =
            test::zeroOnRay(out.spline, middle, ray, rho - 2.0 * voxel, rho + 2.0 * voxel);
        EXPECT_FALSE(std::isnan(t));
        errors.mean += std::abs(t - rho) / count;
        errors.largest = std::max(errors.largest, std::abs(t - rho));
    }
    return errors;
}

// 4 Å apart: the two spheres of 3.1 Å meet at a crease, where psi is far from quadratic.
TEST(TwoAtoms, SettleAtTheMinimalSurfaceOfRevolution)
{
    for (const test::Energy& energy : {test::Energy{0.5, 0.01, Regularizer::Gradient},
                                       test::Energy{0.5, 0.1, Regularizer::Area}}) {
        const test::PolarCurve curve = test::minimalCurve({{-2.0, 3.1}, {2.0, 3.1}}, energy, 1500);
        ASSERT_TRUE(curve.stationary);
        const std::vector<double> h = {0.5, 0.25, 0.125};
        std::vector<double> mean, largest;
        for (std::size_t i = 0; i < h.size(); ++i) {
            const Errors e = errorsOf(curve, energy, h[i], 10);
            mean.push_back(e.mean);
            largest.push_back(e.largest);
        }
        EXPECT_GT(test::observedOrder(h, mean), 1.8) << test::table(h, mean);
        EXPECT_LT(mean.back(), 1e-3) << test::table(h, mean);
        EXPECT_GT(test::observedOrder(h, largest), 1.5) << test::table(h, largest);
        EXPECT_LT(largest.back(), 0.01) << test::table(h, largest);
        if (getenv("VERBOSE"))
            printf("mean %s largest %s", test::table(h, mean).c_str(),
                   test::table(h, largest).c_str());
    }
}

} // namespace
} // namespace molsurf
