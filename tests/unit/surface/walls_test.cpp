// SPDX-License-Identifier: MPL-2.0
#include "molsurf/topology/walls.h"
#include "support/fields.h"
#include "support/motion.h"
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

constexpr double probe = 1.4, radius = 1.7, R = radius + probe;
constexpr double C = M_LN2 / (0.5 * R); // of the default tolerance

/// Atoms in a ring about the origin, in the middle of which psi = 0 lies `depth` above and below.
std::vector<Vec3d> ring(int atoms, double depth)
{
    const double around = std::sqrt(R * R - depth * depth + std::log(double(atoms)) / C);
    std::vector<Vec3d> out;
    for (int i = 0; i < atoms; ++i) {
        const double angle = 2.0 * M_PI * i / atoms;
        out.emplace_back(around * std::cos(angle), around * std::sin(angle), 0.0);
    }
    return out;
}

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
                const std::vector<Vec3d> centres = ring(atoms, probe + thinnestWall + beyond);
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
        const std::vector<Vec3d> centres = ring(6, probe + thinnestWall + beyond);
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

} // namespace
} // namespace molsurf
