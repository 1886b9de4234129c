// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/power_cells.h"

#include "molsurf/kernel/balls/boundary_measure.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

const Progress silent;

Ball ball(double x, double y, double z, double r)
{
    return {Vec3f(float(x), float(y), float(z)), float(r), 0};
}

double unionVolume(const std::vector<Ball>& balls)
{
    double sum = 0.0;
    for (const auto& piece : measureBoundary(ballBoundary(balls, 0.0, silent), silent).pieces)
        sum += piece.volume;
    return sum;
}

double sum(const std::vector<double>& v)
{
    return std::accumulate(v.begin(), v.end(), 0.0);
}

TEST(PowerCells, TwoBallsMeetInADisk)
{
    const double r = 2.0, R = 1.5, d = 2.5;
    const PowerCells cells =
        powerCells({ball(0.3, 0.1, 0.2, r), ball(0.3, 0.1, 0.2 + d, R)}, silent);
    const double height = (d * d + r * r - R * R) / (2 * d), cap = r - height;
    const double rim = r * r - height * height;
    ASSERT_EQ(cells.facets.size(), 1u);
    EXPECT_NEAR(cells.facets[0].area, M_PI * rim, 1e-5);
    EXPECT_NEAR(cells.facets[0].distance, d, 1e-6);
    EXPECT_NEAR(cells.volumes[0], 4 * M_PI / 3 * r * r * r - M_PI / 3 * cap * cap * (3 * r - cap),
                1e-5);
    EXPECT_NEAR(cells.areas[0], 4 * M_PI * r * r - 2 * M_PI * r * cap, 1e-5);
}

// The centre of the small ball lies behind the plane of the facet.
TEST(PowerCells, AnAlmostBuriedBall)
{
    const std::vector<Ball> balls = {ball(0, 0, 0, 2.0), ball(0.11, 0.23, 1.9, 0.5)};
    const PowerCells cells = powerCells(balls, silent);
    EXPECT_GT(cells.volumes[1], 0.0);
    EXPECT_NEAR(sum(cells.volumes), unionVolume(balls), 1e-5);
}

TEST(PowerCells, AddUpToTheUnion)
{
    for (unsigned seed = 1; seed < 6; ++seed) {
        const std::vector<Ball> balls = test::randomBalls(200, 11.0, Vec3d(3, -2, 5), seed);
        const PowerCells cells = powerCells(balls, silent);
        const double whole = unionVolume(balls);
        EXPECT_NEAR(sum(cells.volumes), whole, 1e-7 * whole) << seed;
    }
    const std::vector<Ball> protein = test::balls("1crn.pdb");
    EXPECT_NEAR(sum(powerCells(protein, silent).volumes), unionVolume(protein), 1e-3);
}

// d V_i / d(r_j^2) = -facet / (2 distance), d V_i / d(r_i^2) = area / (2 r_i) + the facets'.
TEST(PowerCells, FacetsAndAreasAreTheDerivatives)
{
    std::vector<Ball> balls = test::randomBalls(40, 6.0, Vec3d(0.0), 7);
    const PowerCells cells = powerCells(balls, silent);
    for (const std::size_t j : {3u, 17u, 28u}) {
        std::vector<double> expected(balls.size(), 0.0);
        const double r = double(balls[j].radius);
        expected[j] = 0.5 * cells.areas[j] / r;
        for (const PowerFacet& f : cells.facets) {
            for (int side = 0; side < 2; ++side) {
                if (std::size_t(f.balls[side]) != j) continue;
                expected[std::size_t(f.balls[1 - side])] -= 0.5 * f.area / f.distance;
                expected[j] += 0.5 * f.area / f.distance;
            }
        }
        const double step = 1e-3; // [Å]
        std::vector<Ball> more = balls, less = balls;
        more[j].radius += float(step);
        less[j].radius -= float(step);
        const PowerCells up = powerCells(more, silent), down = powerCells(less, silent);
        const double squares = double(more[j].radius) * double(more[j].radius) -
                               double(less[j].radius) * double(less[j].radius);
        for (std::size_t i = 0; i < balls.size(); ++i)
            EXPECT_NEAR((up.volumes[i] - down.volumes[i]) / squares, expected[i], 1e-3) << i << j;
    }
}

TEST(PowerCells, BuriedAndEqualBallsHaveNone)
{
    const Ball a = ball(0, 0, 0, 2), b = ball(2.2, 0.3, 0, 1.8);
    const PowerCells two = powerCells({a, b}, silent);
    const PowerCells four = powerCells({a, b, ball(0.1, 0, 0, 1), b}, silent);
    EXPECT_NEAR(four.volumes[0], two.volumes[0], 1e-12);
    EXPECT_NEAR(four.volumes[1], two.volumes[1], 1e-12);
    EXPECT_EQ(four.volumes[2], 0.0);
    EXPECT_EQ(four.volumes[3], 0.0);
    EXPECT_EQ(four.facets.size(), 1u);
    EXPECT_TRUE(powerCells({}, silent).volumes.empty());
}

} // namespace
} // namespace molsurf
