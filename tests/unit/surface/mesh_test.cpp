// SPDX-License-Identifier: MPL-2.0
#include "support/digital_euler.h"
#include "support/mesh_checks.h"
#include "support/runs.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

// CGAL's verdict, and the Euler number of the level set's signs by the rule of OpenVDB's mesher:
// voxels are connected across faces and edges (18 neighbours), see test::mesherEuler().
void expectGood(const std::string& file, const std::optional<std::string>& assembly, double voxel,
                bool intersections)
{
    SurfaceOptions options;
    options.voxel = voxel;
    const MolecularSurface result = test::runOn(test::balls(file, assembly), options);
    const test::MeshVerdict verdict = test::judge(result.mesh, intersections);
    EXPECT_TRUE(verdict.polygonMesh);
    EXPECT_TRUE(verdict.valid);
    EXPECT_TRUE(verdict.closed);
    EXPECT_TRUE(verdict.outward);
    EXPECT_EQ(verdict.degenerate, 0u);
    EXPECT_EQ(verdict.selfIntersections, 0u);
    const SurfaceReport& surface = result.report.surface;
    EXPECT_TRUE(surface.closed && surface.manifold);
    EXPECT_EQ(surface.degenerateTriangles, 0u);
    EXPECT_LT(surface.maxResidual, 1e-3);
    EXPECT_EQ(surface.eulerCharacteristic, verdict.euler);
    EXPECT_EQ(test::mesherEuler(*result.surface), verdict.euler);
    EXPECT_NEAR(surface.volume / verdict.volume, 1.0, 0.02);
    if (getenv("VERBOSE")) {
        const test::DigitalEuler e = test::digitalEuler(*result.surface);
        std::cout << file << " h " << voxel << ": " << result.mesh.triangles.size()
                  << " triangles, " << verdict << ", rule " << test::mesherEuler(*result.surface)
                  << ", 6/18/26: " << 2 * e.six << ' ' << 2 * e.eighteen << ' ' << 2 * e.twentySix
                  << ", ambiguous " << e.ambiguousCells << ", residual " << surface.maxResidual
                  << '\n';
    }
}

TEST(MeshSlow, OfCrambinPassesCgal)
{
    expectGood("1crn.pdb", {}, 0.5, true);
}

TEST(MeshSlow, OfCrambinAtAQuarterPassesCgal)
{
    expectGood("1crn.pdb", {}, 0.25, true);
}

TEST(MeshSlow, OfTheDimerOf1A8OPassesCgal)
{
    expectGood("1a8o.cif.gz", "1", 0.5, true);
}

TEST(MeshSlow, OfTheDimerOf1A8OAtAQuarterPassesCgal)
{
    expectGood("1a8o.cif.gz", "1", 0.25, true);
}

TEST(MeshSlow, Of4AT1PassesCgal)
{
    expectGood("4at1.ent.gz", {}, 0.5, true);
}

// The checker itself: meshes with one fault each.
TEST(Judge, SeesFaults)
{
    Mesh good;
    good.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    good.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    EXPECT_TRUE(test::judge(good).good()) << test::judge(good);
    EXPECT_EQ(test::judge(good).euler, 2);

    Mesh open = good;
    open.triangles.pop_back();
    EXPECT_FALSE(test::judge(open).closed);

    Mesh inward = good;
    for (auto& t : inward.triangles) std::swap(t[0], t[1]);
    EXPECT_FALSE(test::judge(inward).outward);

    Mesh twisted = good;
    std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
    EXPECT_FALSE(test::judge(twisted).polygonMesh);

    Mesh flat = good;
    flat.positions[3] = {0.5f, 0, 0};
    EXPECT_GT(test::judge(flat).degenerate, 0u);

    Mesh crossing = good;
    for (int k = 0; k < 4; ++k)
        crossing.positions.push_back(good.positions[k] + openvdb::Vec3f(0.1f, 0.15f, 0.05f));
    for (int k = 0; k < 4; ++k) {
        const auto t = good.triangles[k];
        crossing.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    }
    EXPECT_GT(test::judge(crossing).selfIntersections, 0u);
}

} // namespace
} // namespace molsurf
