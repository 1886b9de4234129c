// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/distance.h"

#include "support/convergence.h"
#include "support/solids.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

Surface splineSurface(const test::Shape& shape, double voxel,
                      const Motion& pose = Motion::identity())
{
    Surface surface;
    surface.spline = test::splineOf(shape.distance, shape.distance, shape.centre, shape.extent,
                                    voxel, 6.0 * voxel);
    surface.mesh = test::meshOf(shape, voxel);
    for (Vec3f& p : surface.mesh.positions) p = Vec3f(pose.placed(Vec3d(p)));
    surface.closed = true;
    surface.pose = pose;
    return surface;
}

std::vector<Vec3d> pointsAbout(const Vec3d& centre, double reach, int count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-reach, reach);
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i)
        points.push_back(centre + Vec3d{place(random), place(random), place(random)});
    return points;
}

/// Whether a point is near the medial axis: there the distance has a kink, and the error of the
/// triangles may choose the other one of two closest points, or the foot may not move along the
/// surface.
bool nearKink(const test::Shape& shape, const Vec3d& x)
{
    constexpr double step = 0.3;
    Vec3d gradient;
    for (int i = 0; i < 3; ++i) {
        Vec3d e(0.0);
        e[i] = step;
        gradient[i] = (shape.distance(x + e) - shape.distance(x - e)) / (2.0 * step);
    }
    return gradient.length() < 0.99;
}

/// Largest error of the signed distance.
double worstError(const Surface& surface, const test::Shape& shape, double reach)
{
    const DistanceTo to(surface);
    DistanceTo::Query query(to);
    double worst = 0.0;
    for (const Vec3d& x : pointsAbout(shape.centre, reach, 1000)) {
        if (nearKink(shape, x)) continue;
        const double exact = shape.distance(x);
        const Distance d = query.at(surface.pose.placed(x));
        worst = std::max(worst, std::abs((d.inside ? -d.value : d.value) - exact));
    }
    return worst;
}

// Near, far and inside, where the band has long ended.
TEST(DistanceToSpline, ConvergesAtFourthOrderAtAnyDistance)
{
    const std::vector<double> h = {0.5, 0.25, 0.125};
    const std::pair<test::Shape, double> cases[] = {
        {test::sphere(2.3), 5.0}, {test::sphere(2.3), 60.0}, {test::torus(3.4, 1.5), 5.0}};
    for (const auto& [shape, reach] : cases) {
        std::vector<double> error;
        for (const double voxel : h)
            error.push_back(worstError(splineSurface(shape, voxel), shape, reach));
        EXPECT_LT(error.back(), 1e-5) << test::table(h, error);
        EXPECT_GT(test::observedOrder(h, error), 3.0) << test::table(h, error);
    }
}

TEST(DistanceToSpline, BeatsItsTriangles)
{
    const test::Shape ball = test::sphere(2.3);
    Surface surface = splineSurface(ball, 0.25);
    const double smooth = worstError(surface, ball, 8.0);
    surface.spline.reset();
    const double flat = worstError(surface, ball, 8.0);
    EXPECT_GT(flat, 1e-3);
    EXPECT_LT(smooth, 0.02 * flat);
}

TEST(DistanceToSpline, InATurnedAndShiftedFrame)
{
    const openvdb::Mat3d turn = test::Pose().turn;
    Motion pose{};
    for (int i = 0; i < 9; ++i)
        pose.rotation[std::size_t(i / 3)][std::size_t(i % 3)] = turn(i / 3, i % 3);
    pose.translation = Vec3d(7.0, -3.0, 11.0);
    const test::Shape ball = test::sphere(2.3);
    EXPECT_LT(worstError(splineSurface(ball, 0.25, pose), ball, 8.0), 1e-4);
}

TEST(DistanceToSpline, OfItsOwnVerticesIsZero)
{
    const Surface surface = splineSurface(test::torus(3.4, 1.5), 0.25);
    const DistanceTo to(surface);
    DistanceTo::Query query(to);
    for (const Vec3f& p : surface.mesh.positions) EXPECT_LT(query.at(Vec3d(p)).value, 1e-5);
}

TEST(DistanceToSpline, OfTheCentreOfABallIsItsRadius)
{
    const test::Shape ball = test::sphere(2.3);
    const Surface surface = splineSurface(ball, 0.25);
    const DistanceTo to(surface);
    const Distance d = DistanceTo::Query(to).at(ball.centre);
    EXPECT_NEAR(d.value, 2.3, 1e-4);
    EXPECT_TRUE(d.inside);
}

/// Exact signed distance to a box.
double boxDistance(const Vec3d& x, const Vec3d& low, const Vec3d& high)
{
    Vec3d out(0.0);
    double in = 1e30;
    for (int i = 0; i < 3; ++i) {
        out[i] = std::max({low[i] - x[i], 0.0, x[i] - high[i]});
        in = std::min({in, x[i] - low[i], high[i] - x[i]});
    }
    return out.lengthSqr() > 0.0 ? out.length() : -in;
}

// Most closest points lie on edges and corners, where the normals of single triangles mislead.
TEST(DistanceToMesh, OfABoxIsExactWithItsSign)
{
    Surface surface;
    surface.mesh = test::box({-1, -2, 0.5}, {3, 1, 4});
    surface.closed = true;
    const DistanceTo to(surface);
    DistanceTo::Query query(to);
    for (const Vec3d& x : pointsAbout(Vec3d(1, -0.5, 2), 6.0, 2000)) {
        const double exact = boxDistance(x, {-1, -2, 0.5}, {3, 1, 4});
        const Distance d = query.at(x);
        EXPECT_NEAR(d.value, std::abs(exact), 1e-12);
        EXPECT_EQ(d.inside, exact < 0.0) << x;
    }
}

// A needle-like pyramid: at its apex a plain mean of the normals points the wrong way for some
// points, the mean weighted by angles never does.
TEST(DistanceToMesh, SignAtASharpCornerWithUnequalTriangles)
{
    Surface surface;
    Mesh& mesh = surface.mesh;
    mesh.positions = {{0, 0, 0}, {1, 3, 0}, {-1, 3, 0}, {0, 3, -8}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    surface.closed = true;
    // The face on top is cut into many narrow ones about the apex.
    mesh.triangles.erase(mesh.triangles.begin());
    mesh.triangles.pop_back();
    std::uint32_t last = 2;
    for (int i = 1; i < 40; ++i) {
        mesh.positions.emplace_back(-1.0f + 2.0f * float(i) / 40.0f, 3.0f, 0.0f);
        const auto next = std::uint32_t(mesh.positions.size() - 1);
        mesh.triangles.push_back({0, last, next});
        mesh.triangles.push_back({3, next, last});
        last = next;
    }
    mesh.triangles.push_back({0, last, 1});
    mesh.triangles.push_back({3, 1, last});
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]); // now outward
    ASSERT_TRUE(hasInside(mesh, vertexTriangles(mesh), Progress()));
    const DistanceTo to(surface);
    DistanceTo::Query query(to);
    // Everything with y < 0 is outside.
    for (const Vec3d& x : pointsAbout(Vec3d(0, -2, 0), 1.9, 2000)) EXPECT_FALSE(query.at(x).inside);
    EXPECT_TRUE(query.at(Vec3d(0.0, 2.0, -0.1)).inside);
}

TEST(DistanceToMesh, AnOpenMeshHasNoInside)
{
    Surface surface;
    surface.mesh = test::box({0, 0, 0}, {1, 1, 1});
    surface.mesh.triangles.pop_back();
    EXPECT_FALSE(hasInside(surface.mesh, vertexTriangles(surface.mesh), Progress()));
    const DistanceTo to(surface);
    const Distance d = DistanceTo::Query(to).at(Vec3d(0.5, 0.5, 0.25));
    EXPECT_DOUBLE_EQ(d.value, 0.25);
    EXPECT_FALSE(d.inside);
}

TEST(HasInside, OfAClosedMesh)
{
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(hasInside(mesh, vertexTriangles(mesh), Progress()));
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    EXPECT_FALSE(hasInside(mesh, vertexTriangles(mesh), Progress()));
}

// Two boxes that share an edge: four triangles there.
TEST(HasInside, OfPiecesThatTouchAlongAnEdge)
{
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    const Mesh other = test::box({1, 1, 0}, {2, 2, 1});
    for (const auto& t : other.triangles) {
        std::array<std::uint32_t, 3> shared;
        for (int k = 0; k < 3; ++k) {
            const Vec3f p = other.positions[t[k]];
            const auto same = std::find(mesh.positions.begin(), mesh.positions.end(), p);
            shared[k] = std::uint32_t(same - mesh.positions.begin());
            if (same == mesh.positions.end()) mesh.positions.push_back(p);
        }
        mesh.triangles.push_back(shared);
    }
    EXPECT_EQ(mesh.positions.size(), 14u);
    EXPECT_TRUE(hasInside(mesh, vertexTriangles(mesh), Progress()));
}

TEST(HasInside, NotOfNothing)
{
    EXPECT_FALSE(hasInside(Mesh(), vertexTriangles(Mesh()), Progress()));
}

} // namespace
} // namespace molsurf
