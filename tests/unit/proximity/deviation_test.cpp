// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/deviation.h"

#include "support/solids.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

Surface ballOf(double radius, const Vec3d& centre, double voxel)
{
    test::Pose pose;
    pose.centre = centre;
    const test::Shape shape = test::sphere(radius, pose);
    Surface surface;
    surface.spline = test::splineOf(shape.distance, shape.distance, shape.centre, shape.extent,
                                    voxel, 6.0 * voxel);
    surface.mesh = test::meshOf(shape, voxel);
    surface.closed = true;
    return surface;
}

Surface meshSurface(Mesh mesh)
{
    Surface surface;
    surface.closed = hasInside(mesh, vertexTriangles(mesh), Progress());
    surface.mesh = std::move(mesh);
    return surface;
}

Comparison::OneWay from(const Surface& a, const Surface& b)
{
    const DistanceTo to(b);
    return distancesFrom(a, to, Progress());
}

const Vec3d first(0.13, 0.29, 0.41);

// Over a sphere of radius R the mean distance from a point at e from its centre is R + e^2/(3 R) if
// e < R, and the mean square is R^2 + e^2.
TEST(Compare, ASmallBallInsideALargeOne)
{
    const Vec3d shift(0.4, -0.3, 0.5);
    const double e = shift.length(), R = 4.0, r = 1.5, h = 0.25;
    const Surface large = ballOf(R, first, h), small = ballOf(r, first + shift, h);
    const Comparison::OneWay inward = from(large, small), outward = from(small, large);

    const double meanIn = R + e * e / (3.0 * R) - r, meanOut = R - r - e * e / (3.0 * r);
    EXPECT_NEAR(inward.mean, meanIn, 1e-3);
    EXPECT_NEAR(outward.mean, meanOut, 1e-3);
    EXPECT_NEAR(*inward.meanSigned, meanIn, 1e-3);
    EXPECT_NEAR(*outward.meanSigned, -meanOut, 1e-3);
    EXPECT_EQ(*inward.inside, 0.0);
    EXPECT_NEAR(*outward.inside, 1.0, 1e-12);
    const double about = R + e * e / (3.0 * R);
    EXPECT_NEAR(inward.rms, std::sqrt(R * R + e * e - 2.0 * r * about + r * r), 1e-3);
    // The farthest vertex is at most half an edge from the farthest point.
    EXPECT_LE(inward.max, R + e - r + 1e-4);
    EXPECT_NEAR(inward.max, R + e - r, 2e-3);
    EXPECT_NEAR(outward.max, R - r + e, 5e-3);
    EXPECT_NEAR((inward.maxAt - (first - R * shift.unit())).length(), 0.0, 0.2);
    for (std::size_t v = 0; v < large.mesh.positions.size(); ++v) {
        const double exact = (Vec3d(large.mesh.positions[v]) - first - shift).length() - r;
        ASSERT_NEAR(inward.distance[v], std::abs(exact), 1e-4);
        ASSERT_NEAR(inward.signedDistance[v], exact, 1e-4);
    }
    EXPECT_EQ(inward.samples, large.mesh.positions.size());
}

// They cut each other, so half of the signs differ.
TEST(Compare, AShiftedBall)
{
    const Vec3d shift(0.7, -0.2, 0.3);
    const Surface a = ballOf(4.0, first, 0.25), b = ballOf(4.0, first + shift, 0.25);
    const Comparison::OneWay there = from(a, b), back = from(b, a);
    const double e = shift.length();
    EXPECT_NEAR(there.max, e, 2e-3);
    EXPECT_NEAR(there.mean, back.mean, 1e-3);
    EXPECT_NEAR(*there.meanSigned, e * e / 12.0, 1e-3);
    // | |x - c| - R | vanishes where cos = e/(2 R) and grows linearly there.
    EXPECT_NEAR(*there.inside, 0.5 - e / 16.0, 5e-3);
    EXPECT_NEAR(there.mean, e / 2.0, 5e-3);
    for (std::size_t v = 0; v < a.mesh.positions.size(); ++v)
        ASSERT_NEAR(there.signedDistance[v],
                    (Vec3d(a.mesh.positions[v]) - first - shift).length() - 4.0, 1e-4);
}

TEST(Compare, ASurfaceWithItself)
{
    const Surface a = ballOf(2.3, first, 0.25);
    EXPECT_LT(from(a, a).max, 1e-5);
    const Surface b = meshSurface(test::box({0, 0, 0}, {3, 1, 2}));
    EXPECT_LT(from(b, b).max, 1e-12);
    // Triangles of a spline are not sampled inside, however large: they are not the surface.
    const Surface coarse = ballOf(8.0, first, 1.5);
    EXPECT_LT(from(coarse, coarse).max, 5e-5);
}

/// A square of two triangles at height z + slope x.
Mesh plate(float size, float z, float slope)
{
    Mesh mesh;
    for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {size, 0.0f}, {size, size}, {0.0f, size}})
        mesh.positions.emplace_back(x, y, z + slope * x);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

TEST(Compare, OpenPlates)
{
    const Surface flat = meshSurface(plate(8.0f, 0.0f, 0.0f));
    const Surface high = meshSurface(plate(8.0f, 1.0f, 0.5f));
    const Comparison::OneWay down = from(high, flat);
    EXPECT_NEAR(down.mean, 3.0, 1e-9); // linear, so exact
    EXPECT_NEAR(down.max, 5.0, 1e-9);
    EXPECT_TRUE(down.signedDistance.empty());
    EXPECT_FALSE(down.meanSigned || down.inside);
    // A mean square of 1 + 8 + 64/12 + ...: the variance of a uniform distribution from 1 to 5.
    EXPECT_NEAR(down.rms, std::sqrt(9.0 + 16.0 / 12.0), 5e-3);
    EXPECT_GT(down.samples, 100u);
}

// The corners of the large triangle touch the other surface, its middle does not.
TEST(Compare, LargeTrianglesAreSampledInside)
{
    Mesh corners = plate(8.0f, 0.0f, 0.0f);
    corners.triangles.clear();
    for (std::uint32_t v = 0; v < 4; ++v) {
        const auto n = std::uint32_t(corners.positions.size());
        const Vec3f p = corners.positions[v];
        corners.positions.push_back(p - Vec3f(0, 0, 1e-3f));
        corners.positions.push_back(p - Vec3f(1e-3f, 0, 1e-3f));
        corners.triangles.push_back({v, n, n + 1});
    }
    const Comparison::OneWay way =
        from(meshSurface(plate(8.0f, 0.0f, 0.0f)), meshSurface(std::move(corners)));
    EXPECT_EQ(way.distance, std::vector<float>(4, 0.0f));
    EXPECT_NEAR(way.max, std::sqrt(32.0), 1e-2); // the middle of the plate
    // Mean distance from a corner of a square of side a: a (sqrt 2 + ln(1 + sqrt 2))/3.
    EXPECT_NEAR(way.mean, 4.0 * (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 3.0, 2e-2);
}

// However large the triangles, the work is bounded.
TEST(Compare, HugeTriangles)
{
    Mesh mesh = test::box({0, 0, 0}, {3e4f, 3e4f, 3e4f});
    for (int i = 0; i < 300; ++i)
        for (int t = 0; t < 12; ++t)
            mesh.triangles.push_back(
                {mesh.triangles[t][0], mesh.triangles[t][1], mesh.triangles[t][2]});
    const Surface one = meshSurface(test::box({0, 0, 0}, {1, 1, 1}));
    const Comparison::OneWay way = from(meshSurface(std::move(mesh)), one);
    EXPECT_LT(way.samples, 4000000u);
    EXPECT_NEAR(way.max, 3e4 * std::sqrt(3.0), 3.0);
}

TEST(Compare, TheSameBitsForAnyNumberOfThreads)
{
    const Surface a = ballOf(2.3, first, 0.25), b = ballOf(2.0, first + Vec3d(0.3), 0.25);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return from(a, b);
    };
    const Comparison::OneWay one = run(1), four = run(4);
    EXPECT_EQ(one.distance, four.distance);
    EXPECT_EQ(one.signedDistance, four.signedDistance);
    EXPECT_EQ(one.mean, four.mean);
    EXPECT_EQ(one.rms, four.rms);
    EXPECT_EQ(one.max, four.max);
}

TEST(Compare, GridsOfDistance)
{
    const Surface ball = ballOf(2.0, first, 0.25);
    const test::Shape other = test::sphere(3.0);
    const LeafTable band = test::bandTable(other.distance, other.centre, other.extent, 0.5, 1.5);
    const auto on = toLevelSet(test::filled(band, 0.5, other.distance), 1.5, Progress());
    const DistanceTo to(ball);
    const auto grids = distanceGrids(*on, to, Progress());
    ASSERT_EQ(grids.size(), 2u);
    EXPECT_EQ(grids[0]->getName(), "distance");
    EXPECT_EQ(grids[1]->getName(), "signed_distance");
    EXPECT_EQ(grids[0]->activeVoxelCount(), on->activeVoxelCount());
    for (auto it = grids[1]->cbeginValueOn(); it; ++it) {
        const double exact = (on->indexToWorld(it.getCoord()) - first).length() - 2.0;
        ASSERT_NEAR(*it, exact, 2e-4);
        ASSERT_NEAR(grids[0]->tree().getValue(it.getCoord()), std::abs(exact), 2e-4);
    }
}

TEST(SizeOfTriangles, OfABox)
{
    const Mesh mesh = test::box({1001, 2002, -3003}, {1003, 2005, -3002});
    const Size closed = sizeOfTriangles(mesh, true, Progress());
    EXPECT_DOUBLE_EQ(closed.area, 2.0 * (6.0 + 3.0 + 2.0));
    EXPECT_DOUBLE_EQ(closed.volume.value(), 6.0);
    EXPECT_FALSE(sizeOfTriangles(mesh, false, Progress()).volume);
}

TEST(VertexNormals, OfABoxPointOutward)
{
    const Mesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
    const auto normals = vertexNormals(mesh);
    ASSERT_EQ(normals.size(), 8u);
    for (std::size_t v = 0; v < 8; ++v) {
        EXPECT_NEAR(normals[v].length(), 1.0f, 1e-6f);
        EXPECT_GT(normals[v].dot(mesh.positions[v]), 0.9f);
    }
}

} // namespace
} // namespace molsurf
