// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/measure.h"

#include "support/convergence.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

void expectHighOrder(const test::Shape& shape, int euler, double areaBound, double volumeBound)
{
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> area, volume;
    for (const double voxel : h) {
        const SurfaceReport report = measure(test::meshOf(shape, voxel), Progress());
        EXPECT_TRUE(report.closed && report.manifold);
        EXPECT_EQ(report.eulerCharacteristic, euler);
        EXPECT_EQ(report.components, 1);
        EXPECT_TRUE(report.cavities.empty());
        EXPECT_EQ(report.degenerateTriangles, 0u);
        EXPECT_EQ(report.area, report.outerArea);
        EXPECT_EQ(report.volume, report.outerVolume);
        area.push_back(std::abs(report.area / shape.area - 1.0));
        volume.push_back(std::abs(report.volume / shape.volume - 1.0));
    }
    EXPECT_GT(test::observedOrder(h, area), 3.0) << test::table(h, area);
    EXPECT_LT(area.back(), areaBound) << test::table(h, area);
    EXPECT_GT(test::observedOrder(h, volume), 3.0) << test::table(h, volume);
    EXPECT_LT(volume.back(), volumeBound) << test::table(h, volume);
}

TEST(Measure, OfASphere)
{
    expectHighOrder(test::sphere(2.3), 2, 1e-5, 1e-5);
}

TEST(Measure, OfATorus)
{
    expectHighOrder(test::torus(3.4, 1.5), 0, 3e-5, 3e-5);
}

TEST(Measure, OfAnEllipsoid)
{
    expectHighOrder(test::ellipsoid(Vec3d(3.1, 2.4, 1.9)), 2, 3e-5, 3e-5);
}

// The volume is taken about a vertex, so it does not cancel far away; positions are floats there.
TEST(Measure, FarFromTheOrigin)
{
    test::Pose pose;
    pose.centre += Vec3d(4000.0, -3000.0, 5000.0);
    const test::Shape ball = test::sphere(2.3, pose);
    const SurfaceReport report = measure(test::meshOf(ball, 0.25), Progress());
    EXPECT_NEAR(report.area / ball.area, 1.0, 5e-4);
    EXPECT_NEAR(report.volume / ball.volume, 1.0, 5e-4);
}

TEST(Measure, ABallWithAHole)
{
    const test::Shape outer = test::sphere(4.1), inner = test::sphere(2.2);
    const auto shell = [&](const Vec3d& x) {
        return std::max(outer.distance(x), -inner.distance(x - Vec3d(0.4, 0.1, -0.2)));
    };
    ExtractStats stats;
    const Mesh mesh = test::meshOf(shell, outer.centre, outer.extent, 0.25, stats);
    const SurfaceReport report = measure(mesh, Progress());
    EXPECT_EQ(report.eulerCharacteristic, 4);
    EXPECT_EQ(report.components, 1);
    ASSERT_EQ(report.cavities.size(), 1u);
    EXPECT_NEAR(report.cavities[0].area / inner.area, 1.0, 1e-3);
    EXPECT_NEAR(report.cavities[0].volume / inner.volume, 1.0, 1e-3);
    EXPECT_NEAR(report.area / (outer.area + inner.area), 1.0, 1e-3);
    EXPECT_NEAR(report.volume / (outer.volume - inner.volume), 1.0, 1e-3);
    EXPECT_NEAR(report.outerArea / outer.area, 1.0, 1e-3);
    EXPECT_NEAR(report.outerVolume / outer.volume, 1.0, 1e-3);
}

TEST(Measure, TwoBalls)
{
    const test::Shape a = test::sphere(2.1);
    test::Pose pose;
    pose.centre += Vec3d(4.0, 3.0, 2.0);
    const test::Shape b = test::sphere(1.6, pose);
    const auto both = [&](const Vec3d& x) { return std::min(a.distance(x), b.distance(x)); };
    ExtractStats stats;
    const Mesh mesh = test::meshOf(both, 0.5 * (a.centre + b.centre), 2.7 + 2.1, 0.25, stats);
    const SurfaceReport report = measure(mesh, Progress());
    EXPECT_EQ(report.eulerCharacteristic, 4);
    EXPECT_EQ(report.components, 2);
    EXPECT_TRUE(report.cavities.empty());
    EXPECT_NEAR(report.area / (a.area + b.area), 1.0, 1e-3);
    EXPECT_NEAR(report.volume / (a.volume + b.volume), 1.0, 1e-3);
}

// Patches are measured in float, but what neighbours have in common cancels.
TEST(Measure, VolumesOfClosedPiecesHaveNoOrigin)
{
    const Mesh mesh = test::meshOf(test::torus(3.4, 1.5), 0.25);
    const std::vector<std::uint32_t> pieces(mesh.positions.size(), 0);
    TriangleSums sums;
    const auto volumeAbout = [&](const Vec3d& origin) {
        return measurePieces(mesh, pieces, 1, origin, sums, Progress())[0].volume;
    };
    const double here = volumeAbout(Vec3d(mesh.positions[0]));
    EXPECT_NEAR(volumeAbout(Vec3d(300.0, -200.0, 500.0)), here, 1e-6);
    EXPECT_EQ(sums.flat, 0u);
}

TEST(Measure, OfNothingIsZero)
{
    const SurfaceReport report = measure(Mesh(), Progress());
    EXPECT_EQ(report.area, 0.0);
    EXPECT_EQ(report.components, 0);
}

// A flat-sided body, with the normals of its faces at vertices of its own: exact.
TEST(Measure, OfACubeIsExact)
{
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = std::uint32_t(mesh.positions.size());
            for (int k = 0; k < 4; ++k) {
                openvdb::Vec3f p, n(0.0f);
                p[axis] = side;
                p[(axis + 1) % 3] = k == 1 || k == 2 ? 1.0f : -1.0f;
                p[(axis + 2) % 3] = k >= 2 ? 1.0f : -1.0f;
                n[axis] = side;
                mesh.positions.push_back(p);
                mesh.normals.push_back(n);
            }
            if (side > 0.0f) {
                mesh.triangles.push_back({first, first + 1, first + 2});
                mesh.triangles.push_back({first, first + 2, first + 3});
            } else {
                mesh.triangles.push_back({first, first + 2, first + 1});
                mesh.triangles.push_back({first, first + 3, first + 2});
            }
        }
    }
    const SurfaceReport report = measure(mesh, Progress());
    EXPECT_NEAR(report.area, 24.0, 1e-6);
    EXPECT_FALSE(report.closed); // the faces share no vertices
}

} // namespace
} // namespace molsurf
