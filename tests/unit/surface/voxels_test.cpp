// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

TEST(Voxels, AreThoseOfTheGrid)
{
    BallSet atoms;
    atoms.balls = {{{0.3, 0.1, -0.2}, 2.0, 0}};
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    const MolecularSurface surface = makeSurface(atoms, options);
    const Voxels voxels = voxelsOf(*surface.surface);
    ASSERT_EQ(voxels.values.size(), std::size_t(surface.surface->activeVoxelCount()));
    ASSERT_EQ(voxels.coordinates.size(), voxels.values.size());
    EXPECT_EQ(voxels.edge, 0.5);
    const auto accessor = surface.surface->getConstAccessor();
    for (std::size_t n = 0; n < voxels.values.size(); ++n) {
        const auto& ijk = voxels.coordinates[n];
        EXPECT_EQ(voxels.values[n], accessor.getValue({ijk[0], ijk[1], ijk[2]}));
        const Vec3d x = voxels.origin + voxels.edge * Vec3d(ijk[0], ijk[1], ijk[2]);
        const double value = voxels.values[n];
        if (std::abs(value) < 0.25) {
            EXPECT_NEAR(value, (x - atoms.balls[0].center).length() - 2.0, 0.01);
        }
    }
    const auto turned = surface.surface->deepCopy();
    turned->transform().preRotate(0.1);
    EXPECT_THROW(voxelsOf(*turned), Error);
}

} // namespace
} // namespace molsurf
