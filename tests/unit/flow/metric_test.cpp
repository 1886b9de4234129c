// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/metric.h"

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

/// A quadratic psi: the Taylor step to the foot point is exact.
struct Quadratic {
    double c;
    Vec3d b;
    Mat3d A;

    double psi(const Vec3d& x) const { return c + b.dot(x) + 0.5 * x.dot(A * x); }
    Vec3d gradient(const Vec3d& x) const { return b + A * x; }
    double w(const Vec3d& x, const Weights& weights) const
    {
        const double e = std::exp(psi(x)), g = 1.0 - e;
        return g * g + weights.gradient * e * e * gradient(x).lengthSqr() + weights.area;
    }
};

TEST(MetricAtFoot, AgreesWithTheDefinitionAtTheFootPoint)
{
    std::mt19937 random(31);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 400; ++i) {
        const Weights weights = i % 3 == 0   ? Weights{0.1f, 0.0f}
                                : i % 3 == 1 ? Weights{0.0f, 0.3f}
                                             : Weights{0.05f, 0.2f};
        Quadratic q;
        q.c = 0.5 * uniform(random);
        for (int k = 0; k < 3; ++k) {
            q.b[k] = 1.5 * uniform(random);
            for (int l = 0; l <= k; ++l) q.A(k, l) = q.A(l, k) = 0.5 * uniform(random);
        }
        Vec3d n{uniform(random), uniform(random), uniform(random)};
        n.normalize();
        const double phi = 0.7 * uniform(random);
        const Vec3d foot = -phi * n; // of the voxel at 0
        const Derivatives d = {float(q.b[0]),    float(q.b[1]),    float(q.b[2]),
                               float(q.A(0, 0)), float(q.A(1, 1)), float(q.A(2, 2)),
                               float(q.A(0, 1)), float(q.A(1, 2)), float(q.A(0, 2))};
        const Metric m =
            metricAtFoot(float(q.c), d, float(n[0]), float(n[1]), float(n[2]), float(phi), weights);
        const double w = q.w(foot, weights), step = 1e-5;
        const double normal =
            (q.w(foot + step * n, weights) - q.w(foot - step * n, weights)) / (2.0 * step);
        EXPECT_NEAR(m.w, w, 1e-5 * (1.0 + w));
        EXPECT_NEAR(m.normal, normal, 2e-5 * (1.0 + std::abs(normal) + w));
        EXPECT_GE(m.secant, 0.0f);
        EXPECT_GE(m.tangent, 0.0f);
        EXPECT_LE(m.tangent, m.secant * 1.001f);
    }
}

// Across a flat surface, psi = -a s, w has its minimum at e^psi = 1/(1 + q), q = lambda a^2; there
// the stiffness is the true second derivative.
TEST(MetricAtFoot, StiffnessIsTheSecondDerivativeAtTheBottomOfTheValley)
{
    for (const Weights weights :
         {Weights{0.0f, 0.01f}, Weights{0.01f, 0.0f}, Weights{0.1f, 0.0f}}) {
        for (const double a : {1.4, 2.8, 7.0}) {
            const double q = double(weights.gradient) * a * a;
            const double bottom = -std::log1p(q);
            const Quadratic flat{bottom, Vec3d(0.0, 0.0, -a), Mat3d::zero()};
            const Derivatives d = {0.0f, 0.0f, float(-a), 0, 0, 0, 0, 0, 0};
            const Metric m = metricAtFoot(float(bottom), d, 0.0f, 0.0f, 1.0f, 0.0f, weights);
            const double step = 1e-4;
            const Vec3d z(0.0, 0.0, step);
            const double second =
                (flat.w(z, weights) - 2.0 * flat.w(Vec3d(0.0), weights) + flat.w(-z, weights)) /
                (step * step);
            EXPECT_NEAR(m.secant / second, 1.0, 1e-3);
            EXPECT_NEAR(m.tangent / second, 1.0, 1e-3);
            EXPECT_NEAR(m.normal, 0.0, 1e-5 * a);
        }
    }
}

// The slope of the speed over the whole way: one step ends at the bottom, from wherever it starts.
TEST(MetricAtFoot, ANewtonStepBySecantEndsAtTheBottomOfTheValley)
{
    const Weights weights{0.01f, 0.0f};
    const double a = 2.8, bottom = -std::log1p(0.01 * a * a);
    for (const double s : {-0.6, -0.2, -0.01, 0.01, 0.2, 0.6}) { // outward from the bottom [Å]
        const Derivatives d = {0.0f, 0.0f, float(-a), 0, 0, 0, 0, 0, 0};
        const Metric m = metricAtFoot(float(bottom - a * s), d, 0.0f, 0.0f, 1.0f, 0.0f, weights);
        EXPECT_NEAR(m.normal / m.secant, s, 1e-3) << s;
    }
}

} // namespace
} // namespace molsurf
