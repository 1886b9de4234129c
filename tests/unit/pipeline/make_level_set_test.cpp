// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel.h"

#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

namespace molsurf
{

namespace
{

/// Whether two level sets have the same voxels, with the same bits.
bool same(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b)
{
    if (!a.tree().hasSameTopology(b.tree())) return false;
    auto other = b.cbeginValueAll();
    for (auto it = a.cbeginValueAll(); it; ++it, ++other)
        if (*it != *other) return false;
    return true;
}

} // namespace

TEST(MakeLevelSet, IsTheSurfaceOfAllAtoms)
{
    const BallModel model{test::randomBalls(60, 9.0, {3, -2, 5}, 4), {}};
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                   SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
        SurfaceOptions options;
        options.kind = kind;
        options.voxel = 0.6;
        options.ballAreas = kind == SurfaceKind::VanDerWaals;
        options.fields = {"spline", "mean_curvature", "density"};
        const LevelSetSurface made = makeLevelSet(model, options, options);
        const MolecularSurface known = makeSurface(model.balls, options);
        EXPECT_TRUE(same(*made.surface, *known.surface)) << nameOf(kind);
        EXPECT_EQ(made.mesh.positions, known.mesh.positions);
        EXPECT_EQ(made.report.surface.area, known.report.surface.area);
        EXPECT_EQ(made.ballAreas, known.ballAreas);
        EXPECT_EQ(made.fields.size(), 3u);
    }
}

TEST(MakeLevelSet, IsTheSameWithoutWhatNobodyReads)
{
    int meshed = 0, alone = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        const BallModel model{test::randomBalls(60, 9.0, {3, -2, 5}, seed), {}};
        for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                       SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
            SurfaceSpec spec;
            spec.kind = kind;
            spec.voxel = 0.6;
            KernelProducts few;
            few.energy = few.closedForm = few.needs.statistics = few.needs.passages = false;
            const LevelSetSurface all = makeLevelSet(model, spec);
            const LevelSetSurface quick = makeLevelSet(model, spec, few);
            EXPECT_TRUE(same(*quick.surface, *all.surface)) << nameOf(kind);
            EXPECT_EQ(quick.mesh.positions, all.mesh.positions) << nameOf(kind);
            EXPECT_TRUE(std::isnan(quick.report.surface.kinkShare));
            EXPECT_TRUE(std::isfinite(all.report.surface.kinkShare));

            few.needs.levelSet = false;
            const LevelSetSurface ofMesh = makeLevelSet(model, spec, few);
            EXPECT_EQ(ofMesh.mesh.positions, all.mesh.positions) << nameOf(kind);
            EXPECT_EQ(ofMesh.mesh.triangles, all.mesh.triangles) << nameOf(kind);
            EXPECT_EQ(ofMesh.report.activeVoxels, all.report.activeVoxels);
            EXPECT_EQ(ofMesh.report.gridBytes, all.report.gridBytes);

            few.needs.levelSet = true;
            few.needs.mesh = false;
            const LevelSetSurface ofVoxels = makeLevelSet(model, spec, few);
            EXPECT_TRUE(same(*ofVoxels.surface, *all.surface)) << nameOf(kind);
            ofVoxels.mesh.triangles.empty() ? ++alone : ++meshed;
            const bool known = kind == SurfaceKind::VanDerWaals || !ofVoxels.mesh.triangles.empty();
            EXPECT_EQ(std::isfinite(ofVoxels.report.surface.area), known);
        }
    }
    EXPECT_GT(alone, 8);
    EXPECT_GT(meshed, 0); // specks
}

// A voxel of 1.5 Å is too large for some surfaces of these balls, which only a mesh shows.
TEST(MakeLevelSet, HasAMeshWhereItIsTheCheck)
{
    const BallModel model{test::randomBalls(60, 9.0, {3, -2, 5}, 4), {}};
    SurfaceSpec spec;
    spec.voxel = 1.5;
    KernelProducts few;
    few.needs.mesh = false;
    EXPECT_FALSE(makeLevelSet(model, spec, few).mesh.triangles.empty());
}

TEST(MakeLevelSet, RefusesWhatIsNoBall)
{
    EXPECT_THROW(makeLevelSet({}, {}), Error);
    EXPECT_THROW(makeLevelSet({{{openvdb::Vec3d(NAN), 1.0, 0}}, {}}, {}), Error);
}

} // namespace molsurf
