// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/spline.h"

#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;

/// exp(u) with its first and second derivatives; u quadratic with all mixed terms.
struct Smooth {
    Mat3d A{-0.11, 0.04, -0.03, 0.04, -0.08, 0.05, -0.03, 0.05, -0.09};
    Vec3d b{0.21, -0.13, 0.17};

    double value(const Vec3d& x) const { return std::exp(b.dot(x) + 0.5 * x.dot(A * x)); }
    Vec3d gradient(const Vec3d& x) const { return value(x) * (b + A * x); }
    Mat3d hessian(const Vec3d& x) const
    {
        const Vec3d u = b + A * x;
        Mat3d out;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) out(i, j) = value(x) * (u[i] * u[j] + A(i, j));
        }
        return out;
    }
};

double largest(const Mat3d& m)
{
    double out = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) out = std::max(out, std::abs(m(i, j)));
    }
    return out;
}

TEST(SplineSampler, ConvergesAtTheOrdersOfCubicSplines)
{
    const Smooth f;
    const test::Shape ball = test::sphere(3.0);
    const std::vector<double> h = {0.8, 0.4, 0.2};
    std::vector<double> value, gradient, hessian;
    for (const double voxel : h) {
        const Spline spline =
            test::splineOf([&](const Vec3d& x) { return f.value(x); }, ball.distance, ball.centre,
                           ball.extent, voxel, 8.0 * voxel);
        SplineSampler sampler(spline);
        double v = 0.0, g = 0.0, H = 0.0;
        for (const test::SurfacePoint& p : ball.points) {
            const Jet jet = sampler.at(p.x);
            v = std::max(v, std::abs(jet.value - f.value(p.x)));
            g = std::max(g, (jet.gradient - f.gradient(p.x)).length());
            H = std::max(H, largest(jet.hessian - f.hessian(p.x)));
        }
        value.push_back(v);
        gradient.push_back(g);
        hessian.push_back(H);
    }
    EXPECT_GT(test::observedOrder(h, value), 3.6) << test::table(h, value);
    EXPECT_LT(value.back(), 5e-6) << test::table(h, value);
    EXPECT_GT(test::observedOrder(h, gradient), 2.7) << test::table(h, gradient);
    EXPECT_LT(gradient.back(), 1e-4) << test::table(h, gradient);
    EXPECT_GT(test::observedOrder(h, hessian), 1.8) << test::table(h, hessian);
    EXPECT_LT(hessian.back(), 2e-3) << test::table(h, hessian);
}

Spline randomSpline()
{
    std::vector<Coord> origins;
    for (int k = 0; k < 27; ++k)
        origins.emplace_back(8 * (k / 9) - 16, 8 * (k / 3 % 3) - 8, 8 * (k % 3));
    Spline spline;
    SparseField& c = spline.coefficients;
    c = {LeafTable(origins), LeafField(origins.size()), 0.4};
    std::mt19937 random(17);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (std::size_t n = 0; n < c.table.size(); ++n) {
        c.table.active(n) = ~LeafMask();
        for (int v = 0; v < leafSize; ++v) c.leaf(n)[v] = uniform(random);
    }
    return spline;
}

// C2 for any coefficients: the jet from both sides of the faces between cells, among them those
// between leaves. Scaled to units of voxels.
TEST(SplineSampler, IsTwiceContinuouslyDifferentiableAcrossCellsAndLeaves)
{
    const Spline spline = randomSpline();
    const double h = spline.voxelSize(), nudge = 1e-10;
    SplineSampler sampler(spline);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(2.1, 21.9);
    double value = 0.0, gradient = 0.0, hessian = 0.0;
    int leafFaces = 0;
    for (int i = 0; i < 3000; ++i) {
        Vec3d x(place(random) - 16.0, place(random) - 8.0, place(random));
        const int axis = i % 3;
        x[axis] = std::floor(x[axis]);
        leafFaces += (int(x[axis]) & 7) == 0;
        Vec3d below = x, above = x;
        below[axis] -= nudge;
        above[axis] += nudge;
        const Jet a = sampler.at(below * h), b = sampler.at(above * h);
        value = std::max(value, std::abs(a.value - b.value));
        gradient = std::max(gradient, h * (a.gradient - b.gradient).length());
        hessian = std::max(hessian, h * h * largest(a.hessian - b.hessian));
    }
    EXPECT_GT(leafFaces, 200);
    EXPECT_LT(value, 1e-6);
    EXPECT_LT(gradient, 1e-6);
    EXPECT_LT(hessian, 3e-6);
}

TEST(SplineSampler, DerivativesAgreeWithFiniteDifferences)
{
    const Spline spline = randomSpline();
    const double h = spline.voxelSize(), step = 0.01 * h;
    SplineSampler sampler(spline);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(2.1, 21.9);
    for (int i = 0; i < 300; ++i) {
        // In the middle half of a cell, so that differences do not cross a face.
        Vec3d x(place(random) - 16.0, place(random) - 8.0, place(random));
        for (int k = 0; k < 3; ++k) {
            const double cell = std::floor(x[k]);
            x[k] = h * (cell + 0.25 + 0.5 * (x[k] - cell));
        }
        const Jet jet = sampler.at(x);
        for (int k = 0; k < 3; ++k) {
            Vec3d e(0.0);
            e[k] = step;
            const Jet after = sampler.at(x + e), before = sampler.at(x - e);
            EXPECT_NEAR(jet.gradient[k] * h, h * (after.value - before.value) / (2.0 * step), 3e-4);
            for (int l = 0; l < 3; ++l) {
                EXPECT_NEAR(jet.hessian(l, k) * h * h,
                            h * h * (after.gradient[l] - before.gradient[l]) / (2.0 * step), 3e-4);
                EXPECT_EQ(jet.hessian(l, k), jet.hessian(k, l));
            }
        }
    }
}

TEST(SplineSampler, IsFiniteOutsideTheTable)
{
    const Spline spline = randomSpline();
    SplineSampler sampler(spline);
    for (const Vec3d& x : {Vec3d(100.0), Vec3d(-6.399, 0.1, 0.1), Vec3d(3.199, 6.3, 9.59)}) {
        const Jet jet = sampler.at(x);
        EXPECT_TRUE(std::isfinite(jet.value));
        EXPECT_TRUE(std::isfinite(largest(jet.hessian)));
    }
}

} // namespace
} // namespace molsurf
