// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/integrate.h"

#include "molsurf/kernel/mesh/statistics.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

struct Sampled {
    Mesh mesh;
    Spline spline;
};

Sampled sampled(const test::Function& f, const Vec3d& centre, double extent, double voxel)
{
    ExtractStats stats;
    return {test::meshOf(f, centre, extent, voxel, stats),
            test::splineOf(f, f, centre, extent, voxel, 6.0 * voxel)};
}

SurfaceIntegrals integralsOf(const test::Shape& shape, double voxel, double tolerance = 0.05)
{
    const Sampled s = sampled(shape.distance, shape.centre, shape.extent, voxel);
    return integrateSurface(s.mesh, s.spline, tolerance, Progress()).sums;
}

// S is of fourth order; the rest is rounding and tolerances. Curvatures of S have errors of second
// order in h that mostly cancel; Gauss-Bonnet holds of S itself.
void expectIntegrals(const test::Shape& shape, double mean, double gaussian, double willmore)
{
    for (const double voxel : {0.5, 0.25, 0.125}) {
        const SurfaceIntegrals sums = integralsOf(shape, voxel);
        EXPECT_EQ(sums.unresolvedArea, 0.0);
        const double bound = 1e-3 * std::pow(voxel, 4) + 3e-6;
        EXPECT_NEAR(sums.area, shape.area, bound * shape.area) << voxel;
        EXPECT_NEAR(sums.volume, shape.volume, bound * shape.volume) << voxel;
        EXPECT_NEAR(sums.meanCurvature, mean, 2e-4 * mean) << voxel;
        EXPECT_NEAR(sums.gaussianCurvature, gaussian, 0.004) << voxel;
        EXPECT_NEAR(sums.squaredMeanCurvature, willmore, 4e-4 * willmore) << voxel;
    }
}

TEST(IntegrateSurface, OfASphere)
{
    expectIntegrals(test::sphere(2.3), 4.0 * M_PI * 2.3, 4.0 * M_PI, 4.0 * M_PI);
}

// H = (1/a + cos s/(A + a cos s))/2 integrates to 2 pi^2 A, H^2 to pi^2 A^2/(a sqrt(A^2 - a^2)).
TEST(IntegrateSurface, OfATorus)
{
    const double A = 3.4, a = 1.5;
    expectIntegrals(test::torus(A, a), 2.0 * M_PI * M_PI * A, 0.0,
                    M_PI * M_PI * A * A / (a * std::sqrt(A * A - a * a)));
}

// The wall of a cavity: everything that is odd in the normal changes its sign.
TEST(IntegrateSurface, SignsInACavity)
{
    const test::Shape ball = test::sphere(2.3);
    const auto inverse = [&](const Vec3d& x) { return -ball.distance(x); };
    const Sampled s = sampled(inverse, ball.centre, ball.extent, 0.25);
    const SurfaceIntegrals sums = integrateSurface(s.mesh, s.spline, 0.05, Progress()).sums;
    EXPECT_NEAR(sums.volume, -ball.volume, 1e-4 * ball.volume);
    EXPECT_NEAR(sums.meanCurvature, -4.0 * M_PI * 2.3, 0.02);
    EXPECT_NEAR(sums.gaussianCurvature, 4.0 * M_PI, 0.004);
}

// Two overlapping balls: the crease is narrower than a voxel, and K has large values of both signs
// there. At the vertices alone the sum is wrong; the integral is not.
TEST(IntegrateSurface, ResolvesACrease)
{
    const test::Pose pose;
    const Vec3d a = pose.toWorld(Vec3d(0, 0, -1.1)), b = pose.toWorld(Vec3d(0, 0, 1.1));
    const auto f = [&](const Vec3d& x) { return test::distanceToTwoBalls(x, a, 1.7, b, 1.7); };
    double worstAtVertices = 0.0;
    for (const double voxel : {0.5, 0.35, 0.25}) {
        const Sampled s = sampled(f, pose.centre, 2.8, voxel);
        const SurfaceIntegrals sums = integrateSurface(s.mesh, s.spline, 1.0, Progress()).sums;
        EXPECT_EQ(sums.unresolvedArea, 0.0);
        EXPECT_NEAR(sums.gaussianCurvature, 4.0 * M_PI, 0.02) << "h " << voxel;
        double atVertices = 0.0;
        for (const auto& t : s.mesh.triangles) {
            const Vec3d p(s.mesh.positions[t[0]]), q(s.mesh.positions[t[1]]),
                r(s.mesh.positions[t[2]]);
            for (const auto v : t)
                atVertices += s.mesh.scalars[1].values[v] * (q - p).cross(r - p).length() / 6.0;
        }
        worstAtVertices = std::max(worstAtVertices, std::abs(atVertices - 4.0 * M_PI));
    }
    EXPECT_GT(worstAtVertices, 0.2); // else this test shows nothing
}

// Cells of vertices share the surface out: their integrals add up, and a cell's mean of H and K is
// that of the torus at its vertex to first order, since cells are not symmetric about their
// vertices.
TEST(IntegrateSurface, IsSharedOutAmongTheVertices)
{
    const test::Shape ring = test::torus(3.4, 1.5);
    double previous = 0.0;
    for (const double voxel : {0.5, 0.25}) {
        const Sampled s = sampled(ring.distance, ring.centre, ring.extent, voxel);
        const IntegratedSurface all = integrateSurface(s.mesh, s.spline, 0.05, Progress());
        const std::vector<float> areas = vertexAreas(s.mesh, Progress());
        double mean = 0.0, gaussian = 0.0, largest = 0.0;
        for (std::size_t v = 0; v < areas.size(); ++v) {
            mean += all.meanCurvature[v];
            gaussian += all.gaussianCurvature[v];
            largest = std::max(
                {largest, std::abs(all.meanCurvature[v] / areas[v] - s.mesh.scalars[0].values[v]),
                 std::abs(all.gaussianCurvature[v] / areas[v] - s.mesh.scalars[1].values[v])});
        }
        EXPECT_NEAR(mean, all.sums.meanCurvature, 1e-9 * mean);
        EXPECT_NEAR(gaussian, all.sums.gaussianCurvature, 1e-9);
        if (previous > 0.0) {
            EXPECT_LT(largest, 0.65 * previous);
        }
        previous = largest;
    }
    EXPECT_LT(previous, 0.02);
}

TEST(IntegrateSurface, HasTheSameBitsForAnyNumberOfThreads)
{
    const test::Shape ring = test::torus(3.4, 1.5);
    const SurfaceIntegrals all = integralsOf(ring, 0.4);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const SurfaceIntegrals alone = integralsOf(ring, 0.4);
    EXPECT_EQ(all.area, alone.area);
    EXPECT_EQ(all.volume, alone.volume);
    EXPECT_EQ(all.meanCurvature, alone.meanCurvature);
    EXPECT_EQ(all.gaussianCurvature, alone.gaussianCurvature);
}

TEST(IntegrateSurface, OfNothingIsZero)
{
    EXPECT_EQ(integrateSurface(Mesh(), Spline(), 0.1, Progress()).sums.area, 0.0);
}

// A mesh too coarse for the surface: no triangle is a graph over it. They count as flat then, with
// the spherical images of their normals, which cover the sphere once.
TEST(IntegrateSurface, OfWhatIsNotResolvedIsTheImageOfTheNormals)
{
    const test::Shape shape = test::sphere(5.0);
    Sampled s = sampled(shape.distance, shape.centre, shape.extent, 0.125);
    s.mesh = Mesh();
    for (const auto& corner :
         {Vec3d(1, 1, 1), Vec3d(1, -1, -1), Vec3d(-1, 1, -1), Vec3d(-1, -1, 1)}) {
        s.mesh.positions.emplace_back(shape.centre + 5.0 * corner.unit());
        s.mesh.normals.emplace_back(corner.unit());
    }
    s.mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const SurfaceIntegrals sums = integrateSurface(s.mesh, s.spline, 0.05, Progress()).sums;
    EXPECT_GT(sums.unresolvedArea, 0.2 * sums.area);
    EXPECT_NEAR(sums.gaussianCurvature, 4.0 * M_PI, 1e-3);
}

} // namespace
} // namespace molsurf
