// SPDX-License-Identifier: MPL-2.0
#include "support/digital_euler.h"
#include "support/exact_minimum.h"
#include "support/mesh_checks.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

const Vec3f corner(0.137f, -0.291f, 0.443f);

void expectGood(const std::vector<Ball>& balls, int components, const char* what)
{
    const MolecularSurface result = test::runOn(balls);
    const SurfaceReport& surface = result.report.surface;
    EXPECT_TRUE(surface.closed && surface.manifold) << what;
    EXPECT_EQ(surface.components, components) << what;
    EXPECT_LT(surface.maxResidual, 1e-3) << what;
    const test::MeshVerdict verdict = test::judge(result.mesh);
    EXPECT_TRUE(verdict.good()) << what << ": " << verdict;
    EXPECT_EQ(verdict.euler, surface.eulerCharacteristic) << what;
    EXPECT_EQ(verdict.euler, test::mesherEuler(*result.surface)) << what;
}

TEST(SmallMolecules, HaveClosedManifoldSurfaces)
{
    const auto at = [](float x, float y, float z, float r = 1.7f) {
        return Ball{corner + Vec3f(x, y, z), r, 0};
    };
    expectGood({at(0, 0, 0)}, 1, "one atom");
    expectGood({at(0, 0, 0, 1.2f)}, 1, "one hydrogen");
    expectGood({at(0, 0, 0), at(1.5f, 0.1f, 0)}, 1, "two atoms");
    expectGood({at(0, 0, 0), at(1.2f, 0.7f, 0, 1.52f), at(-1.1f, 0.6f, 0.2f, 1.2f)}, 1,
               "three atoms");
    expectGood({at(0, 0, 0), at(0, 0, 0), at(0, 0, 0)}, 1, "one place three times");
    expectGood({at(0, 0, 0), at(1.4f, 0, 0), at(2.1f, 1.2f, 0), at(1.4f, 2.4f, 0), at(0, 2.4f, 0),
                at(-0.7f, 1.2f, 0)},
               1, "six in a plane");
    expectGood({at(0, 0, 0), at(30.0f, 1.0f, 2.0f)}, 2, "two far apart");
    expectGood({at(5000.0f, -4000.0f, 3000.0f)}, 1, "one far away");
}

TEST(SmallMolecules, OneAtomIsABallOfItsExactRadius)
{
    const double radius = test::minimalRadius(3.1, {}) - 1.4;
    for (const double voxel : {0.5, 0.25, 0.1, 0.05}) {
        SurfaceOptions options;
        options.voxel = voxel;
        const SurfaceReport s = test::runOn({{corner, 1.7f, 0}}, options).report.surface;
        const double bound = 0.004 * voxel * voxel; // Å, of the radius: second order
        EXPECT_NEAR(std::sqrt(s.area / (4.0 * M_PI)), radius, bound);
        EXPECT_NEAR(std::cbrt(s.volume * 3.0 / (4.0 * M_PI)), radius, bound);
    }
}

TEST(SmallMolecules, FinalEnergyIsThatOfTheSphere)
{
    const double r = test::minimalRadius(3.1, {}), C = M_LN2 / (0.5 * 3.1);
    const double e = std::exp(-C * (r * r - 3.1 * 3.1)), slope = 2.0 * C * r;
    const double w = (1.0 - e) * (1.0 - e) + 0.01 * e * e * slope * slope;
    for (const double voxel : {0.5, 0.25}) {
        SurfaceOptions options;
        options.voxel = voxel;
        const Report report = test::runOn({{corner, 1.7f, 0}}, options).report;
        EXPECT_NEAR(report.evolution->finalEnergy / (4.0 * M_PI * r * r * w), 1.0, 2e-3) << voxel;
    }
}

TEST(SmallMolecules, LabelsNameTheNearestAtom)
{
    const std::vector<Ball> balls = {{corner, 1.7f, 17}, {corner + Vec3f(3.0f, 0, 0), 1.7f, 4}};
    const Mesh mesh = test::runOn(balls).mesh;
    ASSERT_EQ(mesh.labels.size(), 1u);
    EXPECT_EQ(mesh.labels[0].name, "atom_id");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const float x = mesh.positions[v].x() - corner.x();
        if (std::abs(x - 1.5f) < 0.01f) continue;
        EXPECT_EQ(mesh.labels[0].values[v], x < 1.5f ? 17 : 4);
    }
}

// A voxel larger than the molecule: an error that says so, or a surface, but no crash.
TEST(SmallMolecules, AreAnErrorWhereTheVoxelIsFarTooLarge)
{
    int errors = 0;
    for (const double voxel : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0}) {
        for (const float shift : {0.0f, 0.3f, 0.5f}) {
            SurfaceOptions options;
            options.voxel = voxel;
            try {
                const MolecularSurface result =
                    test::runOn({{corner + Vec3f(shift * float(voxel)), 1.7f, 0}}, options);
                EXPECT_TRUE(result.report.surface.closed && result.report.surface.manifold)
                    << voxel << ' ' << shift;
            } catch (const Error& e) {
                EXPECT_EQ(e.kind(), ErrorKind::Numeric) << voxel << ' ' << shift;
                ++errors;
            }
        }
    }
    EXPECT_GT(errors, 3);
}

// What is refused names a voxel that is small enough, of every kind, and is closed with it.
TEST(SmallMolecules, NameAVoxelThatHoldsThem)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> step(-3.0f, 3.0f), radius(1.0f, 2.5f), voxel(2.6f, 10.0f);
    int refused = 0, wrong = 0;
    for (int run = 0; run < 150; ++run) {
        SurfaceOptions options;
        options.kind = std::array{SurfaceKind::Gaussian, SurfaceKind::Gaussian,
                                  SurfaceKind::Variational, SurfaceKind::VanDerWaals,
                                  SurfaceKind::SolventExcluded}[std::size_t(run % 5)];
        options.voxel = double(voxel(random));
        std::vector<Ball> balls;
        Vec3f x = corner;
        for (int i = 0; i <= run % 7; ++i) {
            balls.push_back({x, radius(random), i});
            x += Vec3f{step(random), step(random), step(random)};
        }
        if (run == 0) { // its triangles enclose another volume than their arcs
            balls = {{{2.524f, -36.942f, -21.611f}, 1.19f, 0},
                     {{5.501f, -40.386f, -18.396f}, 2.1f, 1}};
            options.voxel = 2.25;
        }
        try {
            EXPECT_TRUE(test::runOn(balls, options).report.surface.closed);
        } catch (const Error& e) {
            ASSERT_EQ(e.kind(), ErrorKind::Numeric) << e.what();
            const std::string text = e.what(), hint = "[hint: a `voxel` of ";
            const std::size_t at = text.find(hint);
            ASSERT_NE(at, text.npos) << text;
            ++refused;
            wrong += text.find("nothing of the molecule") == text.npos;
            options.voxel = std::stod(text.substr(at + hint.size()));
            const SurfaceReport surface = test::runOn(balls, options).report.surface;
            EXPECT_TRUE(surface.closed && surface.manifold) << text;
        }
    }
    EXPECT_GT(refused, 50);
    EXPECT_GT(wrong, 0);
}

} // namespace
} // namespace molsurf
