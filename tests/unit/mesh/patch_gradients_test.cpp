// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/patch_gradients.h"

#include "molsurf/error.h"
#include "molsurf/kernel/mesh/measure.h"

#include "support/surfaces.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

TEST(PatchNodes, MidpointsLieOnTheSphere)
{
    const test::Shape sphere = test::sphere(2.3);
    const Mesh mesh = test::meshOf(sphere, 0.5);
    const PatchNodes nodes = patchNodes(mesh);
    ASSERT_GT(nodes.points.size(), mesh.positions.size());
    for (std::size_t n = mesh.positions.size(); n < nodes.points.size(); ++n)
        EXPECT_NEAR(sphere.distance(nodes.points[n]), 0.0, 1e-3);
}

// By the scale an area grows twice as fast as it is large, a volume three times.
TEST(PatchNodes, DerivativesAreThoseOfWhatTheMeshMeasures)
{
    const test::Shape torus = test::torus(3.4, 1.5);
    const Mesh mesh = test::meshOf(torus, 0.5);
    const PatchNodes nodes = patchNodes(mesh);
    double area = 0.0, volume = 0.0;
    for (std::size_t n = 0; n < nodes.points.size(); ++n) {
        area += nodes.area[n].dot(nodes.points[n] - torus.centre);
        volume += nodes.volume[n].dot(nodes.points[n] - torus.centre);
    }
    const SurfaceReport report = measure(mesh, Progress());
    EXPECT_NEAR(area, 2.0 * report.area, 1e-4 * report.area);
    EXPECT_NEAR(volume, 3.0 * report.volume, 1e-4 * report.volume);
}

// An edge that no triangle runs through upward is none of the nodes.
TEST(PatchNodes, MeshesThatAreNoManifoldAreRefused)
{
    const Mesh whole = test::meshOf(test::sphere(2.3), 1.0);
    Mesh flat = whole, mixed = whole, open = whole;
    for (auto& t : flat.triangles) t = {0, 0, 0};
    for (auto& t : mixed.triangles) t[1] = t[0] + 1 < whole.positions.size() ? t[0] + 1 : 0;
    open.triangles.pop_back();
    for (const Mesh& mesh : {flat, mixed, open}) EXPECT_THROW(patchNodes(mesh), Error);
}

} // namespace
} // namespace molsurf
