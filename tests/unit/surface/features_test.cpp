// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

/// Atoms spread over a sphere, close enough to shut it (a Fibonacci lattice).
std::vector<Ball> shellOfBalls(int count, double radius)
{
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, rho = std::sqrt(1.0 - z * z);
        const double angle = 2.399963229728653 * i; // golden angle
        const openvdb::Vec3d c(rho * std::cos(angle), rho * std::sin(angle), z);
        balls.push_back({openvdb::Vec3f(radius * c + openvdb::Vec3d(0.31, -0.17, 0.23)), 1.7f, i});
    }
    return balls;
}

TEST(Run, FillsCavitiesOnRequest)
{
    const std::vector<Ball> balls = shellOfBalls(220, 9.0);
    SurfaceOptions options;
    Progress progress;
    const MolecularSurface kept = makeSurface(balls, options, &progress);
    ASSERT_EQ(kept.report.surface.cavities.size(), 1u);
    options.fillCavities = true;
    const MolecularSurface filled = makeSurface(balls, options, &progress);
    EXPECT_TRUE(filled.report.surface.cavities.empty());
    EXPECT_EQ(filled.report.surface.components, 1);
    EXPECT_EQ(filled.report.surface.eulerCharacteristic, 2);
    // The outer wall stays where it was.
    EXPECT_NEAR(filled.report.surface.area, kept.report.surface.outerArea,
                1e-3 * kept.report.surface.outerArea);
    EXPECT_NEAR(filled.report.surface.volume, kept.report.surface.outerVolume,
                1e-3 * kept.report.surface.outerVolume);
}

// One atom: coarse splines see the same sphere, with errors of fourth order in their own spacing.
TEST(Run, TakesCoarseSplines)
{
    const std::vector<Ball> atom = {{openvdb::Vec3f(0.13f, 0.29f, 0.41f), 1.7f, 0}};
    Progress progress;
    for (const int level : {1, 2}) {
        SurfaceOptions options;
        options.voxel = 0.25;
        options.splineLevel = level;
        options.fields = {"spline"};
        const MolecularSurface result = makeSurface(atom, options, &progress);
        EXPECT_NEAR(std::sqrt(result.report.surface.area / (4.0 * M_PI)), 1.7208,
                    level == 1 ? 0.005 : 0.02)
            << level;
        ASSERT_EQ(result.fields.size(), 1u);
        EXPECT_NEAR(result.fields[0]->voxelSize()[0], options.voxel * (1 << level), 1e-12);
        EXPECT_TRUE(result.report.surface.closed && result.report.surface.manifold);
    }
}

TEST(Run, GivesAtomGrids)
{
    const std::vector<Ball> atom = {{openvdb::Vec3f(0.13f, 0.29f, 0.41f), 1.7f, 7}};
    SurfaceOptions options;
    options.voxel = 0.25;
    options.fields = {"atom_id"};
    Progress progress;
    const MolecularSurface result = makeSurface(atom, options, &progress);
    ASSERT_EQ(result.fields.size(), 1u);
    const auto id = openvdb::gridPtrCast<openvdb::Int32Grid>(result.fields[0]);
    for (auto it = result.surface->cbeginValueOn(); it; ++it)
        EXPECT_EQ(id->tree().getValue(it.getCoord()), 7);
}

} // namespace
} // namespace molsurf
