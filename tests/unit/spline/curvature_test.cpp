// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/curvature.h"

#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

/// Largest errors over the points of a shape, on grids of 0.5, 0.25 and 0.125 Å.
struct Errors {
    std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> mean, gauss, k1, k2;
    std::vector<double> angle; ///< of the principal directions, where they are well defined [rad]
    double largest = 0.0;      ///< curvature of the shape [1/Å]
};

double angleBetween(const Vec3d& a, const Vec3d& b)
{
    return std::atan2(a.cross(b).length(), std::abs(a.dot(b))); // of lines
}

Errors errorsOn(const test::Shape& shape, const test::Function& f, double widthVox)
{
    Errors out;
    for (const double voxel : out.h) {
        const Spline spline =
            test::splineOf(f, shape.distance, shape.centre, shape.extent, voxel, widthVox * voxel);
        SplineSampler sampler(spline);
        double m = 0.0, g = 0.0, k1 = 0.0, k2 = 0.0, angle = 0.0;
        for (const test::SurfacePoint& p : shape.points) {
            const Jet jet = sampler.at(p.x);
            const Curvature k = curvature(jet);
            m = std::max(m, std::abs(k.mean() - p.mean));
            g = std::max(g, std::abs(k.gaussian() - p.gauss));
            k1 = std::max(k1, std::abs(k.k1 - p.k1()));
            k2 = std::max(k2, std::abs(k.k2 - p.k2()));
            out.largest = std::max({out.largest, std::abs(p.k1()), std::abs(p.k2())});
            EXPECT_NEAR(meanCurvature(jet), k.mean(), 1e-10);
            EXPECT_NEAR(gaussianCurvature(jet), k.gaussian(), 1e-10);
            if (p.k1() - p.k2() < 0.1) continue; // directions near an umbilic are ill-conditioned
            angle = std::max({angle, angleBetween(k.direction1, p.direction1),
                              angleBetween(k.direction2, p.n.cross(p.direction1))});
        }
        out.mean.push_back(m);
        out.gauss.push_back(g);
        out.k1.push_back(k1);
        out.k2.push_back(k2);
        out.angle.push_back(angle);
    }
    return out;
}

void expectSecondOrder(const Errors& e, const char* name, const std::vector<double>& error,
                       double bound)
{
    EXPECT_GT(test::observedOrder(e.h, error), 1.8) << name << test::table(e.h, error);
    EXPECT_LT(error[1], bound) << name << test::table(e.h, error);
}

/// Second order, and within a percent at 0.25 Å.
void expectAccurate(const Errors& e)
{
    const double k = e.largest;
    expectSecondOrder(e, "mean", e.mean, 0.01 * k);
    expectSecondOrder(e, "gauss", e.gauss, 0.01 * k * k);
    expectSecondOrder(e, "k1", e.k1, 0.01 * k);
    expectSecondOrder(e, "k2", e.k2, 0.01 * k);
}

// The shape's smooth function, times another one without symmetry, is no distance, so every term of
// the formulas counts. The band is wide, since its rim disturbs second derivatives by a factor
// (2 + sqrt 3)^-n at n voxels whatever h: see the test in a narrow band.
Errors errorsOnSmooth(const test::Shape& shape)
{
    const auto f = [&](const Vec3d& x) {
        return shape.smooth(x) * std::exp(0.2 * x.x() - 0.15 * x.y() + 0.1 * x.z());
    };
    return errorsOn(shape, f, 10.0);
}

TEST(SplineCurvature, OfASphere)
{
    expectAccurate(errorsOnSmooth(test::sphere(2.0)));
}

TEST(SplineCurvature, OfATorus)
{
    const Errors e = errorsOnSmooth(test::torus(4.0, 1.6));
    expectAccurate(e);
    expectSecondOrder(e, "angle", e.angle, 0.01);
}

TEST(SplineCurvature, OfAnEllipsoid)
{
    const Errors e = errorsOnSmooth(test::ellipsoid(Vec3d(3.1, 2.6, 2.1)));
    expectAccurate(e);
    expectSecondOrder(e, "angle", e.angle, 0.01);
}

// The distance itself, in the pipeline's band. Its second derivatives jump at the borders of the
// patch by 1/1.7 + 1/1.4, which an interpolating spline feels at n voxels by (2 + sqrt 3)^-n, and
// the patch is only 4 voxels of 0.25 Å wide on either side.
TEST(SplineCurvature, OfTheSaddleBetweenTwoAtoms)
{
    const test::Shape saddle = test::saddleOfTwoBalls();
    EXPECT_NEAR(saddle.points[0].k2(), -1.0 / 1.4, 1e-12);
    for (const test::SurfacePoint& p : saddle.points) EXPECT_NEAR(saddle.distance(p.x), 0.0, 1e-12);
    const Errors e = errorsOn(saddle, saddle.distance, 4.0);
    for (const auto* error : {&e.mean, &e.gauss, &e.k1, &e.k2, &e.angle}) {
        EXPECT_GT(test::observedOrder(e.h, *error), 1.8) << test::table(e.h, *error);
        EXPECT_LT((*error)[1], 0.025 / 1.4) << test::table(e.h, *error);
        EXPECT_LT((*error)[2], 0.005 / 1.4) << test::table(e.h, *error);
    }
}

// As in the pipeline: a distance in a band of four voxels.
TEST(SplineCurvature, InANarrowBandIsWithinAPercent)
{
    for (const test::Shape& shape :
         {test::sphere(1.7), test::torus(4.0, 1.7), test::ellipsoid(Vec3d(3.1, 2.4, 1.9))}) {
        const Errors e = errorsOn(shape, shape.distance, 4.0);
        for (const auto* error : {&e.mean, &e.k1, &e.k2}) {
            EXPECT_LT((*error)[0], 0.05 * e.largest);
            EXPECT_LT((*error)[1], 0.01 * e.largest);
            EXPECT_LT((*error)[2], 0.01 * e.largest);
        }
    }
}

Jet jetWith(const Vec3d& gradient, const Mat3d& hessian)
{
    return {0.0, gradient, hessian};
}

TEST(Curvature, ShapeIndexAndCurvednessOfTheStandardShapes)
{
    const auto at = [](double k1, double k2) {
        Curvature k;
        k.k1 = k1;
        k.k2 = k2;
        return k;
    };
    EXPECT_DOUBLE_EQ(at(0.5, 0.5).shapeIndex(), 1.0);    // cap
    EXPECT_DOUBLE_EQ(at(0.5, 0.0).shapeIndex(), 0.5);    // ridge
    EXPECT_DOUBLE_EQ(at(0.5, -0.5).shapeIndex(), 0.0);   // saddle
    EXPECT_DOUBLE_EQ(at(0.0, -0.5).shapeIndex(), -0.5);  // rut
    EXPECT_DOUBLE_EQ(at(-0.5, -0.5).shapeIndex(), -1.0); // cup
    EXPECT_DOUBLE_EQ(at(0.0, 0.0).shapeIndex(), 0.0);    // plane
    EXPECT_NEAR(at(2.0, 1.0).shapeIndex(), 2.0 / M_PI * std::atan(3.0), 1e-12);
    EXPECT_DOUBLE_EQ(at(0.5, 0.5).curvedness(), 0.5);
    EXPECT_DOUBLE_EQ(at(0.0, 0.0).curvedness(), 0.0);
    EXPECT_NEAR(at(3.0, -1.0).curvedness(), std::sqrt(5.0), 1e-12);
}

// Eigenvectors of the shape operator P H P/|g|, P the projector on the tangent plane.
TEST(Curvature, DirectionsAreAnOrthonormalFrameOfEigenvectors)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vec3d{number(random), number(random), number(random)}; };
    for (int i = 0; i < 1000; ++i) {
        const double scale = std::pow(10.0, 3.0 * number(random));
        const Vec3d a = scale * vector(), b = vector(), c = vector();
        const Jet jet = jetWith(c, Mat3d(a[0], b[0], b[1], b[0], a[1], b[2], b[1], b[2], a[2]));
        const Curvature k = curvature(jet);
        const Vec3d n = c.unit();
        const double size = 1e-12 * (1.0 + std::abs(k.k1) + std::abs(k.k2));
        EXPECT_GE(k.k1, k.k2);
        EXPECT_NEAR(k.direction1.length(), 1.0, 1e-12);
        EXPECT_NEAR((k.direction1.cross(k.direction2) - n).length(), 0.0, 1e-12);
        for (const auto& [value, d] : {std::pair(k.k1, k.direction1), {k.k2, k.direction2}}) {
            Vec3d Ad = jet.hessian * d / c.length();
            Ad -= Ad.dot(n) * n;
            EXPECT_NEAR((Ad - value * d).length(), 0.0, 100.0 * size);
        }
    }
}

TEST(Curvature, IsFiniteAtUmbilicsAndCriticalPoints)
{
    const Mat3d zero = Mat3d::zero(), one = Mat3d::identity();
    for (const Vec3d& g : {Vec3d(0.0), Vec3d(1e-300), Vec3d(0.0, 0.0, 1e-5), Vec3d(0.0, 0.0, 1.0),
                           Vec3d(1.0, 1.0, 1.0), Vec3d(-1.0, 0.0, 0.0)}) {
        for (const Mat3d& H : {zero, one, -one, 1e6 * one}) {
            const Curvature k = curvature(jetWith(g, H));
            const bool critical = g.length() < leastSlope;
            const double expected = critical ? 0.0 : H(0, 0) / g.length();
            EXPECT_NEAR(k.k1, expected, 1e-9 * std::abs(expected));
            EXPECT_NEAR(k.k2, expected, 1e-9 * std::abs(expected));
            EXPECT_NEAR(k.direction1.length(), 1.0, 1e-12);
            EXPECT_NEAR(k.direction2.length(), 1.0, 1e-12);
            EXPECT_NEAR(k.direction1.dot(k.direction2), 0.0, 1e-12);
            for (const CurvatureField& field : curvatureFields()) {
                float out[3] = {0.0f, 0.0f, 0.0f};
                field.value(k, out);
                for (const float x : out) EXPECT_TRUE(std::isfinite(x)) << field.name;
            }
        }
    }
    EXPECT_EQ(curvature(jetWith(Vec3d(std::nan("")), one)).k1, 0.0);
}

TEST(Curvature, FieldsGiveWhatTheirNamesSay)
{
    Curvature k;
    k.k1 = 3.0;
    k.k2 = -1.0;
    k.direction1 = Vec3d(0.0, 0.0, 1.0);
    k.direction2 = Vec3d(1.0, 0.0, 0.0);
    const auto value = [&](const char* name, int i = 0) {
        float out[3] = {};
        const CurvatureField* field = findCurvatureField(name);
        if (field) field->value(k, out);
        return out[i];
    };
    EXPECT_EQ(value("mean_curvature"), 1.0f);
    EXPECT_EQ(value("gaussian_curvature"), -3.0f);
    EXPECT_EQ(value("principal_curvature_1"), 3.0f);
    EXPECT_EQ(value("principal_curvature_2"), -1.0f);
    EXPECT_FLOAT_EQ(value("shape_index"), float(2.0 / M_PI * std::atan(0.5)));
    EXPECT_FLOAT_EQ(value("curvedness"), float(std::sqrt(5.0)));
    EXPECT_EQ(value("principal_direction_1", 2), 1.0f);
    EXPECT_EQ(value("principal_direction_2", 0), 1.0f);
    EXPECT_EQ(findCurvatureField("curvature"), nullptr);
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
