// SPDX-License-Identifier: MPL-2.0
#include "support/runs.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

constexpr SurfaceKind allKinds[] = {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                    SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals,
                                    SurfaceKind::Gaussian};

SurfaceReport reportOf(const std::vector<Ball>& balls, SurfaceKind kind, double voxel)
{
    SurfaceOptions options;
    options.kind = kind;
    options.voxel = voxel;
    return test::runOn(balls, options).report.surface;
}

// The surface of one atom is a ball: smooth, however few voxels it has.
TEST(Kinks, OneAtomHasNone)
{
    for (const SurfaceKind kind : allKinds) {
        for (const double voxel : {1.0, 0.5, 0.25}) {
            for (const Vec3f& centre : {Vec3f(0.0f), Vec3f(0.137f, -0.291f, 0.443f)}) {
                const SurfaceReport s = reportOf({{centre, 1.7f, 0}}, kind, voxel);
                EXPECT_EQ(s.kinkShare, 0.0) << nameOf(kind) << " " << voxel;
                if (voxel == 1.0) continue; // too few voxels for the gradient
                EXPECT_EQ(s.gradientShare, 1.0) << nameOf(kind) << " " << voxel;
            }
        }
    }
}

// A probe passes between two atoms 6 Å apart: each has a tip on the axis, where the probe's other
// places are equally near. Van der Waals balls do not meet.
TEST(Kinks, TwoAtomsHaveTips)
{
    const std::vector<Ball> balls = {{Vec3f(0.13f, 0.37f, -0.21f), 1.7f, 0},
                                     {Vec3f(4.93f, 3.07f, 2.19f), 1.7f, 0}};
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SolventExcluded}) {
        const double coarse = reportOf(balls, kind, 0.5).kinkShare,
                     fine = reportOf(balls, kind, 0.25).kinkShare;
        EXPECT_GT(coarse, 0.1) << nameOf(kind);
        EXPECT_LT(coarse, 0.35) << nameOf(kind);
        EXPECT_GT(fine, 0.02) << nameOf(kind);
        EXPECT_LT(fine, 0.5 * coarse) << nameOf(kind);
    }
    EXPECT_EQ(reportOf(balls, SurfaceKind::VanDerWaals, 0.25).kinkShare, 0.0);
}

// Away from kinks S is a distance: on a protein at most vertices.
TEST(Kinks, TheGradientIsCountedAtMostVertices)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const SurfaceReport smooth = reportOf(balls, SurfaceKind::Variational, 0.5);
    EXPECT_LT(smooth.kinkShare, 0.12);
    EXPECT_GT(smooth.gradientShare, 0.995);
    const SurfaceReport sharp = reportOf(balls, SurfaceKind::SolventExcluded, 0.25);
    EXPECT_GT(sharp.kinkShare, smooth.kinkShare);
    EXPECT_LT(sharp.kinkShare, 0.15);
    EXPECT_GT(sharp.gradientShare, 0.995);
}

} // namespace
} // namespace molsurf
