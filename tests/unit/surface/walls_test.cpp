// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/walls.h"
#include "support/fields.h"
#include "support/motion.h"
#include "support/rings.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double probe = test::ringProbe, radius = test::ringRadius, R = test::ringRim,
                 C = test::ringRate;

std::vector<Ball> ballsAt(const std::vector<Vec3d>& centres, const test::Motion& move)
{
    std::vector<Ball> out;
    for (const Vec3d& c : centres) out.push_back({move(c), float(radius), 0});
    return out;
}

/// The Euler number of the default surface.
long long eulerNumberOf(const std::vector<Ball>& balls, double voxel)
{
    SurfaceOptions options;
    options.voxel = voxel;
    const Report report = test::runOn(balls, options).report;
    EXPECT_TRUE(report.surface.closed);
    return *report.surface.eulerCharacteristic;
}

// The hole of a ring is open or closed by how thin its wall would be, on all voxels and in all
// poses.
TEST(Walls, OfARingAreOpenOrClosedInAllPoses)
{
    std::mt19937 random(17);
    for (const int atoms : {5, 6}) {
        for (const double voxel : {0.7, 0.5, 0.3}) {
            for (const double beyond : {-0.08, -0.03, -0.01, 0.01, 0.03, 0.1}) {
                const std::vector<Vec3d> centres = test::ring(atoms, probe + thinnestWall + beyond);
                for (int pose = 0; pose < 3; ++pose) {
                    EXPECT_EQ(eulerNumberOf(ballsAt(centres, test::randomMotion(random)), voxel),
                              beyond > 0.0 ? 2 : 0)
                        << atoms << " " << voxel << " " << beyond;
                }
            }
        }
    }
}

// What the report counts, and how far from the decision the nearest wall was.
TEST(Walls, AreCountedInTheReport)
{
    std::mt19937 random(29);
    for (const double beyond : {-0.05, -0.02, 0.02, 0.05}) {
        const std::vector<Vec3d> centres = test::ring(6, probe + thinnestWall + beyond);
        SurfaceOptions options;
        const Report report =
            test::runOn(ballsAt(centres, test::randomMotion(random)), options).report;
        ASSERT_TRUE(report.evolution && report.evolution->walls);
        const EvolutionReport::Gaps& walls = *report.evolution->walls;
        EXPECT_EQ(walls.found, 1u) << beyond;
        EXPECT_EQ(walls.closed, beyond > 0.0 ? 1u : 0u) << beyond;
        EXPECT_NEAR(walls.nearest, std::abs(beyond), 0.01);
    }
}

// The film about the middle of an open wall is opened to a length in Å: four atoms in a square,
// whose hole a film would close that is 0.001 Å thinner than what stays.
TEST(Walls, OpenAsFarOnAllVoxels)
{
    std::mt19937 random(31);
    std::vector<Vec3d> square;
    for (const double x : {0.0, 4.6})
        for (const double y : {0.0, 4.6}) square.emplace_back(x, y, 0.0);
    double least = std::numeric_limits<double>::max(), most = 0.0;
    for (const double voxel : {0.5, 0.25, 0.125}) {
        SurfaceOptions options;
        options.voxel = voxel;
        const Report report =
            test::runOn(ballsAt(square, test::randomMotion(random)), options).report;
        EXPECT_EQ(*report.surface.eulerCharacteristic, 0) << voxel;
        least = std::min(least, report.surface.area);
        most = std::max(most, report.surface.area);
    }
    EXPECT_LT(most, 1.003 * least);
}

// A wall is opened before ridges are rounded; after it, the place of the ridge between the voxels
// would count: then areas differ by 0.03 %.
TEST(Walls, OpenTheSameInAllPosesOnFineVoxels)
{
    constexpr int poses = 4;
    std::mt19937 random(37);
    SurfaceOptions options;
    options.voxel = 0.125;
    double least = std::numeric_limits<double>::max(), most = 0.0;
    for (int pose = 0; pose < poses; ++pose) {
        const std::vector<Ball> balls = ballsAt(test::ring(4, 1.44), test::randomMotion(random));
        const double area = test::runOn(balls, options).report.surface.area;
        least = std::min(least, area);
        most = std::max(most, area);
    }
    EXPECT_LT(most, 1.0001 * least);
}

// Where there is no wall the report has the depth up to which one would have been seen, 1.2 voxels.
TEST(Walls, OfOneAtomAreNone)
{
    for (const double voxel : {0.5, 0.25}) {
        SurfaceOptions options;
        options.voxel = voxel;
        const Report report =
            test::runOn({{Vec3d(0.1, 0.2, 0.3), float(radius), 0}}, options).report;
        ASSERT_TRUE(report.evolution && report.evolution->walls);
        EXPECT_EQ(report.evolution->walls->found, 0u);
        EXPECT_NEAR(report.evolution->walls->nearest, 1.2 * voxel, 1e-12);
    }
}

// Of molecules of 130 atoms in random places, which have a few walls each.
TEST(Walls, OfRandomMoleculesAreTheSameInAllPoses)
{
    constexpr int molecules = 20, poses = 3;
    std::mt19937 random(23);
    int same = 0;
    for (int i = 0; i < molecules; ++i) {
        const std::vector<Ball> balls = test::randomBalls(130, 17.0, Vec3d(0.0), unsigned(i));
        std::set<long long> numbers;
        for (int pose = 0; pose < poses; ++pose) {
            const test::Motion move = test::randomMotion(random);
            std::vector<Ball> moved = balls;
            for (Ball& ball : moved) ball.center = move(Vec3d(ball.center));
            numbers.insert(eulerNumberOf(moved, 0.5));
        }
        same += numbers.size() == 1;
    }
    EXPECT_GE(same, molecules - 2);
}

// Six atoms about a cavity whose curvature m is the same all round, with psi in its middle a fifth
// less deep than where tension closes it: 2 lambda 7.46 m of the gradient, 2 sqrt(3 lambda) of the
// area. The report has how near that is.
TEST(Gaps, AreDecidedByTheRegulariserOfTheSurface)
{
    constexpr double lambda = 0.01;
    for (const Regularizer regularizer : {Regularizer::Gradient, Regularizer::Area}) {
        double psi = -0.3, around = 0.0, edge = 0.0;
        for (int i = 0; i < 20; ++i) { // m depends on psi by a little
            around = std::sqrt(R * R + (std::log(6.0) - psi) / C);
            const double m = 4.0 * C * C * around * around / 3.0 - 2.0 * C;
            edge = regularizer == Regularizer::Gradient ? 2.0 * lambda * 7.46 * m
                                                        : 2.0 * std::sqrt(3.0 * lambda);
            psi = -0.8 * edge;
        }
        std::vector<Vec3d> centres;
        for (int i = 0; i < 6; ++i) {
            centres.emplace_back(0.0);
            centres.back()[i % 3] = i < 3 ? around : -around;
        }
        std::mt19937 random(41);
        SurfaceOptions options;
        options.evolution.regularizer = regularizer;
        options.evolution.lambda = lambda;
        const Report report =
            test::runOn(ballsAt(centres, test::randomMotion(random)), options).report;
        ASSERT_TRUE(report.evolution && report.evolution->gaps);
        EXPECT_EQ(report.evolution->gaps->closed, 1u) << int(regularizer);
        EXPECT_NEAR(report.evolution->gaps->nearest, 0.2 * edge, 1e-3) << int(regularizer);
    }
}

/// The field closes the hole of a ring at psi = 0, and the surface a probe radius inside of that
/// is open if its wall there would be thin.
TEST(Gaps, OpenInTheSurfaceAreNotSaidToBeClosed)
{
    std::mt19937 random(5);
    for (const int atoms : {5, 6}) {
        for (const double beyond : {-0.3, -0.05, 0.05, 0.3}) {
            const std::vector<Vec3d> centres = test::ring(atoms, probe + thinnestWall + beyond);
            const Report report =
                test::runOn(ballsAt(centres, test::randomMotion(random)), SurfaceOptions()).report;
            SCOPED_TRACE(std::to_string(atoms) + " " + std::to_string(beyond));
            EXPECT_EQ(report.surface.eulerCharacteristic, beyond > 0.0 ? 2 : 0);
            EXPECT_EQ(report.evolution->gaps->closedByField, beyond > 0.0 ? 1u : 0u);
            EXPECT_EQ(report.evolution->gaps->widestClosed > 0.0, beyond > 0.0);
        }
    }
}

} // namespace
} // namespace molsurf
