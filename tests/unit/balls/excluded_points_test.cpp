// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/excluded_points.h"

#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/kernel/balls/excluded_measure.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

// Every point is a probe radius from the place of its probe, and from no other place nearer.
void expectOnSurface(const std::vector<Ball>& balls, double probe, double share)
{
    const BallBoundary boundary = ballBoundary(balls, probe, Progress());
    const BoundaryPoints places(boundary);
    const double expected =
        measureExcluded(boundary, measureBoundary(boundary, Progress()), probe, false, Progress())
            .totalAreas()
            .sum();
    double area = 0.0;
    for (const ExcludedPoint& point : ExcludedSampler(probe, 30.0).of(boundary, Progress())) {
        EXPECT_NEAR(point.normal.length(), 1.0, 1e-9);
        ASSERT_NEAR(places.nearest(point.position, probe).distance, probe, 1e-4);
        const Vec3d centre = point.position + probe * point.normal;
        ASSERT_LT(places.nearest(centre, 0.1).distance, 1e-4);
        area += point.area;
    }
    EXPECT_NEAR(area, expected, share * expected);
}

TEST(ExcludedPoints, LieOnTheSurfaceAndShareItsArea)
{
    expectOnSurface(test::balls("1crn.pdb"), 1.7, 0.003);
    expectOnSurface(test::randomBalls(60, 12.0, Vec3d(3.0), 5), 1.4, 0.01);
    expectOnSurface({{Vec3d(0.0), 2.0, 0}}, 1.4, 1e-9);
}

// A torus between two balls, and one that meets itself in a cusp.
TEST(ExcludedPoints, OfTwoBalls)
{
    for (const double apart : {3.0, 5.0, 6.0})
        expectOnSurface({{Vec3d(0.0), 1.9, 0}, {Vec3d(0.0, 0.0, apart), 1.7, 1}}, 1.7, 0.01);
}

} // namespace
} // namespace molsurf
