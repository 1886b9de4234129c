// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/pose_error.h"

#include "molsurf/surface.h"

#include "unit/structure/temp_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace molsurf
{
namespace
{

SurfaceOptions withLambda(double lambda)
{
    SurfaceOptions options;
    options.evolution.lambda = lambda;
    return options;
}

TEST(PoseError, IsAskedForWhereFrontsDecide)
{
    EXPECT_FALSE(dependsOnPose(withLambda(0.04)));
    EXPECT_TRUE(dependsOnPose(withLambda(0.045)));
    SurfaceOptions options = withLambda(0.1);
    options.kind = SurfaceKind::SmoothAccessible;
    EXPECT_TRUE(dependsOnPose(options));
    options.kind = SurfaceKind::SolventExcluded;
    EXPECT_FALSE(dependsOnPose(options));
    options.kind = SurfaceKind::Variational;
    options.evolution.steps = 3;
    EXPECT_FALSE(dependsOnPose(options));
    options.evolution.steps.reset();
    options.evolution.flow = Flow::Paper;
    EXPECT_FALSE(dependsOnPose(options));
}

// The ends of the groove between two balls come to rest elsewhere on voxels of an Å.
TEST(PoseError, IsThatOfTwoRunsThatAreTurned)
{
    const std::vector<Ball> balls = {{{0.1, 0.2, 0.3}, 1.7, 0}, {{5.6, 0.2, 0.3}, 1.7, 1}};
    const SurfaceOptions options = withLambda(0.1);
    const MolecularSurface made = makeSurface(balls, options);
    SurfaceOptions coarse = options;
    coarse.voxel = 2.0 * options.voxel;
    const double other = makeSurface(balls, coarse).report.surface.area;
    const double share = std::abs(1.0 - other / made.report.surface.area);
    EXPECT_GT(made.report.evolution->areaError, 0.5 * share);
    EXPECT_LT(made.report.evolution->areaError, 0.1);
    ASSERT_EQ(made.report.warnings.size(), 1u);
    EXPECT_HAS(made.report.warnings[0], "`lambda` 0.1: the place of the molecule on the grid");
    EXPECT_GT(made.report.evolution->areaError,
              makeSurface(balls, withLambda(0.04)).report.evolution->areaError);
}

/// Its poses have the tolerances of the balls and its probe, and their cavities are filled as its
/// own.
TEST(PoseError, IsOfTheSameSurface)
{
    BallSet atoms;
    atoms.balls = {{{0.1, 0.2, 0.3}, 1.7, 0}, {{4.1, 0.2, 0.3}, 1.7, 1}};
    atoms.decays = {{0.6f, 0.3f}, {0.6f, 0.3f}};
    EXPECT_LT(makeSurface(atoms, withLambda(0.1)).report.evolution->areaError, 0.05);

    std::vector<Ball> cube; // which another probe fits round
    for (int i = 0; i < 8; ++i)
        cube.push_back(
            {openvdb::Vec3d(0.1, 0.2, 0.3) + 3.8 * openvdb::Vec3d(i >> 2, i >> 1 & 1, i & 1), 1.7,
             i});
    SurfaceOptions small = withLambda(0.1);
    small.probe = 0.5;
    EXPECT_LT(makeSurface(cube, small).report.evolution->areaError, 0.02);

    std::vector<Ball> shell; // about a hollow
    for (int i = 0; i < 140; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / 140, turn = i * M_PI * (3.0 - std::sqrt(5.0));
        const double rim = std::sqrt(1.0 - z * z);
        shell.push_back(
            {7.0 * openvdb::Vec3d(rim * std::cos(turn), rim * std::sin(turn), z), 1.7, i});
    }
    SurfaceOptions options = withLambda(0.06);
    options.fillCavities = true;
    EXPECT_LT(makeSurface(shell, options).report.evolution->areaError, 0.05);
}

TEST(PoseError, OfWhatIsTooSmallForTwiceTheVoxelIsFoundOnTheSame)
{
    SurfaceOptions options = withLambda(0.1);
    options.probe = 0.0;
    options.voxel = 0.9;
    const MolecularSurface made = makeSurface({{{0.1, 0.2, 0.3}, 1.2, 0}}, options);
    EXPECT_LT(made.report.evolution->areaError, 1.0);
    EXPECT_EQ(made.report.warnings.size(), 1u);
}

// Of a surface that has not come to rest the flow may know a larger one.
TEST(PoseError, DoesNotHideALargerOne)
{
    BallSet atoms;
    atoms.balls = {{{0.1, 0.2, 0.3}, 1.7, 0}};
    const SurfaceOptions options = withLambda(0.1);
    Report report = makeSurface(atoms, options).report;
    Progress progress;
    for (const double known : {0.9, std::nan("")}) {
        report.evolution->areaError = known;
        estimatePoseError(atoms, options, progress, report);
        if (std::isnan(known))
            EXPECT_LT(report.evolution->areaError, 0.5);
        else
            EXPECT_EQ(report.evolution->areaError, known);
    }
}

TEST(PoseError, IsNotAskedForBelow)
{
    const MolecularSurface made = makeSurface({{{0.1, 0.2, 0.3}, 1.7, 0}}, withLambda(0.04));
    EXPECT_TRUE(made.report.warnings.empty());
}

} // namespace
} // namespace molsurf
