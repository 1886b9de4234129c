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

TEST(MakeLevelSet, RefusesWhatIsNoBall)
{
    EXPECT_THROW(makeLevelSet({}, {}), Error);
    EXPECT_THROW(makeLevelSet({{{openvdb::Vec3d(NAN), 1.0, 0}}, {}}, {}), Error);
}

} // namespace molsurf
