// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/remesh.h"

#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/mesh_shape.h"
#include "molsurf/kernel/mesh/size_field.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

struct Remeshed {
    Mesh before, mesh;
    MeshShape shape;
    double residual = 0.0;
    std::vector<float> slopes;
};

/// @param[in] keep  tells of a vertex of the old mesh whether its piece stays
Remeshed remeshed(
    const test::Shape& shape, double voxel, const EdgeTarget& target,
    const std::function<bool(const Vec3d&)>& keep = [](const Vec3d&) { return false; })
{
    const auto& f = shape.distance;
    const Spline spline = test::splineOf(f, f, shape.centre, shape.extent, voxel, 6.0 * voxel);
    ExtractStats stats;
    Remeshed out;
    out.before = test::meshOf(f, shape.centre, shape.extent, voxel, stats);
    out.mesh = out.before;
    out.slopes = stats.slopes;
    std::vector<char> kept;
    for (const auto& x : out.mesh.positions) kept.push_back(keep(Vec3d(x)));
    SurfaceVertices vertices{out.mesh, out.slopes};
    out.residual = remesh(spline, voxel, target, kept, vertices, Progress());
    out.shape = shapeOf(out.mesh, Progress());
    return out;
}

// Of a sphere, of a saddle and of cylinders about either side.
TEST(SizeField, ACreviceIsAsBentAsARidge)
{
    for (const float side : {1.0f, -1.0f}) {
        EXPECT_FLOAT_EQ(SizeField::bend(0.5f * side, 0.25f), 0.5f);
        EXPECT_FLOAT_EQ(SizeField::bend(0.5f * side, 0.0f), 1.0f);
        EXPECT_FLOAT_EQ(SizeField::bend(0.25f * side, -0.5f), 1.0f);
    }
}

/// Expects vertices on the surface, with its normals and curvatures, and a closed manifold.
void expectOnSurface(const Remeshed& made, const test::Shape& shape, double voxel)
{
    const SurfaceReport report = measure(made.mesh, Progress());
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(made.mesh.normals.size(), made.mesh.positions.size());
    EXPECT_EQ(made.slopes.size(), made.mesh.positions.size());
    EXPECT_LT(made.residual, 1e-3 * voxel);
    double worst = 0.0;
    for (std::size_t v = 0; v < made.mesh.positions.size(); ++v) {
        const Vec3d x(made.mesh.positions[v]), n(made.mesh.normals[v]);
        worst = std::max(worst, std::abs(shape.distance(x)));
        const double step = 1e-3;
        EXPECT_NEAR(shape.distance(x + step * n) - shape.distance(x - step * n), 2.0 * step,
                    0.04 * step);
    }
    EXPECT_LT(worst, 5e-3 * voxel);
}

TEST(Remesh, OfABallIsEven)
{
    constexpr double radius = 3.0, voxel = 0.5;
    const test::Shape ball = test::sphere(radius);
    for (const double edge : {0.3, 0.5, 1.0}) {
        const Remeshed made = remeshed(ball, voxel, {edge, 0.0});
        expectOnSurface(made, ball, voxel);
        EXPECT_EQ(made.shape.eulerNumbers, std::vector<int>{2});
        EXPECT_GT(made.shape.leastAngle, 35.0) << edge;
        EXPECT_GT(made.shape.shortestEdge, 0.5 * edge);
        EXPECT_LT(made.shape.longestEdge, 1.7 * edge);
        // Equal triangles would be so many.
        const double equal = 16.0 * M_PI * radius * radius / (std::sqrt(3.0) * edge * edge);
        EXPECT_NEAR(double(made.mesh.triangles.size()) / equal, 1.18, 0.1) << edge;
        for (const float H : made.mesh.scalars[0].values) ASSERT_NEAR(H, 1.0 / radius, 0.02);
        for (const float K : made.mesh.scalars[1].values)
            ASSERT_NEAR(K, 1.0 / (radius * radius), 0.02);
    }
}

TEST(Remesh, KeepsARingThatIsThinnerThanSixEdges)
{
    constexpr double voxel = 0.125;
    const test::Shape ring = test::torus(3.0, 0.4); // 2.5 Å about the tube
    const Remeshed made = remeshed(ring, voxel, {0.6, 0.0});
    expectOnSurface(made, ring, voxel);
    EXPECT_EQ(made.shape.eulerNumbers, std::vector<int>{0});
    EXPECT_GT(made.shape.leastAngle, 30.0);
}

/// Two balls and a neck between them, a smooth union.
test::Shape dumbbell(double neck)
{
    test::Shape shape = test::sphere(1.0); // for its centre
    const Vec3d c = shape.centre;
    shape.distance = [=](const Vec3d& x) {
        const Vec3d p = x - c;
        const double axis = std::clamp(p[0], -3.0, 3.0);
        const double a = (p - Vec3d(3.0, 0.1, 0.0)).length() - 2.0,
                     b = (p - Vec3d(-3.0, 0.0, 0.1)).length() - 1.7,
                     n = (p - Vec3d(axis, 0.0, 0.0)).length() - neck;
        constexpr double k = 3.0;
        return -std::log(std::exp(-k * a) + std::exp(-k * b) + std::exp(-k * n)) / k;
    };
    shape.extent = 6.0;
    return shape;
}

TEST(Remesh, KeepsANeckThatIsThinnerThanAnEdge)
{
    const Remeshed made = remeshed(dumbbell(0.25), 0.25, {1.0, 0.0});
    const SurfaceReport report = measure(made.mesh, Progress());
    EXPECT_TRUE(report.closed && report.manifold);
    EXPECT_EQ(made.shape.eulerNumbers, std::vector<int>{2});
    EXPECT_GT(made.shape.leastAngle, 25.0);
    // The neck is there: an Å about the middle, vertices lie about the axis.
    const Vec3d c = test::sphere(1.0).centre;
    int near = 0;
    for (const auto& x : made.mesh.positions) near += std::abs(x[0] - float(c[0])) < 0.5f;
    EXPECT_GE(near, 4);
}

TEST(Remesh, KeepsTrianglesNearTheSurfaceIfAsked)
{
    const test::Shape egg = test::ellipsoid({3.0, 1.6, 1.1});
    constexpr double voxel = 0.25;
    std::size_t before = 0;
    for (const double error : {0.04, 0.02, 0.01}) {
        const Remeshed made = remeshed(egg, voxel, {1.5, error});
        double worst = 0.0;
        for (const auto& t : made.mesh.triangles) {
            Vec3d middle(0.0);
            for (const std::uint32_t v : t) middle += Vec3d(made.mesh.positions[v]) / 3.0;
            worst = std::max(worst, std::abs(egg.distance(middle)));
        }
        EXPECT_LT(worst, 1.3 * error) << made.mesh.triangles.size();
        EXPECT_GT(worst, 0.2 * error);
        EXPECT_GT(made.shape.leastAngle, 28.0);
        EXPECT_GT(made.mesh.triangles.size(), before);
        before = made.mesh.triangles.size();
    }
}

TEST(Remesh, LeavesPiecesThatAreKept)
{
    test::Shape two = test::sphere(1.5);
    const Vec3d c = two.centre;
    two.distance = [=](const Vec3d& x) {
        return std::min((x - c).length() - 1.5, (x - c - Vec3d(0.0, 4.0, 0.3)).length() - 1.0);
    };
    two.extent = 6.0;
    const auto isSecond = [&](const Vec3d& x) { return x[1] > c[1] + 2.0; };
    const Remeshed made = remeshed(two, 0.25, {0.5, 0.0}, isSecond);
    EXPECT_EQ(made.shape.eulerNumbers, (std::vector<int>{2, 2}));
    const auto of = [&](const Mesh& mesh) {
        std::vector<std::array<float, 3>> points;
        for (const auto& x : mesh.positions)
            if (isSecond(Vec3d(x))) points.push_back({x[0], x[1], x[2]});
        std::sort(points.begin(), points.end());
        return points;
    };
    EXPECT_EQ(of(made.mesh), of(made.before));
    EXPECT_LT(made.mesh.positions.size() - of(made.mesh).size(),
              0.6 * double(made.before.positions.size() - of(made.before).size()));
}

TEST(Remesh, HasTheSameBitsForAnyNumberOfThreads)
{
    const test::Shape ring = test::torus(3.4, 1.5);
    std::vector<Remeshed> made;
    for (const std::size_t threads : {1, 2, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        made.push_back(remeshed(ring, 0.4, {0.5, 0.03}));
        EXPECT_EQ(made[0].mesh.triangles, made.back().mesh.triangles);
        EXPECT_EQ(made[0].mesh.positions, made.back().mesh.positions);
        EXPECT_EQ(made[0].mesh.scalars[1].values, made.back().mesh.scalars[1].values);
    }
}

} // namespace
} // namespace molsurf
