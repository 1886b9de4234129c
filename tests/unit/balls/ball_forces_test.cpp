// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/ball_forces.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

struct AreaAndVolume {
    double area = 0.0, volume = 0.0;
};

AreaAndVolume sumOf(const std::vector<BoundaryPiece>& pieces)
{
    AreaAndVolume sum;
    for (const BoundaryPiece& piece : pieces) {
        sum.area += piece.area;
        sum.volume += piece.volume;
    }
    return sum;
}

/// A surface of balls, in closed form.
struct Kind {
    const char* name;
    double probe;
    bool excluded;

    AreaAndVolume measure(const std::vector<Ball>& balls) const
    {
        const BallBoundary boundary = ballBoundary(balls, probe, Progress());
        const BoundaryMeasure grown = measureBoundary(boundary, Progress());
        if (!excluded) return sumOf(grown.pieces);
        return sumOf(measureExcluded(boundary, grown, probe, false, Progress()).pieces);
    }
    BallGradients gradients(const std::vector<Ball>& balls) const
    {
        const BallBoundary boundary = ballBoundary(balls, probe, Progress());
        const BoundaryMeasure grown = measureBoundary(boundary, Progress());
        if (!excluded) return unionGradients(boundary, grown, balls.size());
        return excludedGradients(boundary, grown,
                                 measureExcluded(boundary, grown, probe, false, Progress()).pulls,
                                 probe, balls.size());
    }
};

const Kind kinds[] = {{"vdw", 0.0, false}, {"sas", 1.4, false}, {"ses", 1.4, true}};

/// The derivatives by a coordinate, from differences of second order, whose error is that of
/// coordinates in float.
AreaAndVolume differencesOf(const Kind& kind, std::vector<Ball> balls, std::size_t i, int axis)
{
    constexpr float step = 0.0009765625f; // [Å], exact in float
    const float x = balls[i].center[axis];
    balls[i].center[axis] = x + step;
    const AreaAndVolume more = kind.measure(balls);
    balls[i].center[axis] = x - step;
    const AreaAndVolume less = kind.measure(balls);
    const double width = double(x + step) - double(x - step);
    return {(more.area - less.area) / width, (more.volume - less.volume) / width};
}

double rmsOf(const std::vector<Vec3d>& gradients)
{
    double squares = 0.0;
    for (const Vec3d& g : gradients) squares += g.lengthSqr();
    return std::sqrt(squares / double(gradients.size()));
}

void expectDerivatives(const Kind& kind, const std::vector<Ball>& balls, double tolerance)
{
    const BallGradients found = kind.gradients(balls);
    ASSERT_EQ(found.area.size(), balls.size());
    const double ofArea = tolerance * rmsOf(found.area) + 1e-9,
                 ofVolume = tolerance * rmsOf(found.volume) + 1e-9;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const AreaAndVolume d = differencesOf(kind, balls, i, axis);
            EXPECT_NEAR(found.volume[i][axis], d.volume, ofVolume) << kind.name << " " << i;
            EXPECT_NEAR(found.area[i][axis], d.area, ofArea) << kind.name << " " << i;
        }
    }
}

void expectNoNetForce(const Kind& kind, const std::vector<Ball>& balls)
{
    const BallGradients found = kind.gradients(balls);
    for (const auto* gradients : {&found.area, &found.volume}) {
        Vec3d sum(0.0);
        double lengths = 0.0;
        for (const Vec3d& g : *gradients) {
            sum += g;
            lengths += g.length();
        }
        EXPECT_LT(sum.length(), 1e-7 * lengths + 1e-9) << kind.name;
    }
}

// Two balls alone: the neck of the solvent-excluded surface is whole, or it ends in cusps.
TEST(BallForces, OfTwoBallsAreDerivatives)
{
    for (const Kind& kind : kinds) {
        for (const float apart : {2.5f, 3.9f, 5.6f}) {
            const std::vector<Ball> balls = {{Vec3f(0.125f, 0.25f, -0.5f), 1.75f, 0},
                                             {Vec3f(0.5f + apart, 0.75f, 0.25f), 1.5f, 1}};
            expectDerivatives(kind, balls, 1e-4);
            expectNoNetForce(kind, balls);
        }
    }
}

// A probe rests on three balls, on either side; the two probes overlap or not.
TEST(BallForces, OfThreeBallsAreDerivatives)
{
    for (const Kind& kind : kinds) {
        for (const float apart : {2.0f, 3.5f, 4.25f}) {
            const std::vector<Ball> balls = {{Vec3f(0.125f, 0.25f, -0.5f), 1.75f, 0},
                                             {Vec3f(0.5f + apart, 0.75f, 0.25f), 1.5f, 1},
                                             {Vec3f(0.75f + 0.5f * apart, apart, 0.0f), 1.25f, 2}};
            expectDerivatives(kind, balls, 1e-4);
            expectNoNetForce(kind, balls);
        }
    }
}

TEST(BallForces, OfABallAloneAreNone)
{
    for (const Kind& kind : kinds) {
        const BallGradients found = kind.gradients({{Vec3f(0.125f, 0.25f, -0.5f), 1.75f, 0}});
        EXPECT_LT(found.area[0].length() + found.volume[0].length(), 1e-12) << kind.name;
    }
}

TEST(BallForces, OfManyBallsAreDerivatives)
{
    const std::vector<Ball> balls = test::randomBalls(25, 9.0, Vec3d(0.3, -0.2, 0.1), 3);
    for (const Kind& kind : kinds) {
        expectDerivatives(kind, balls, 4e-4); // where an arc is about to vanish
        expectNoNetForce(kind, balls);
    }
}

TEST(BallForces, OfAProteinAddUpToNothing)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    for (const Kind& kind : kinds) expectNoNetForce(kind, balls);
}

} // namespace
} // namespace molsurf
