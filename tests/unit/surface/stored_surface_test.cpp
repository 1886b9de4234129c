// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/stored_surface.h"

#include "molsurf/progress.h"

#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

openvdb::FloatGrid::Ptr sphere(double shift)
{
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        5.0f, openvdb::Vec3f(0.1f, 0.2f, 0.3f), 0.5f);
    grid->setName("surface");
    grid->transform().postTranslate(openvdb::Vec3d(shift, 0.0, 0.0));
    return grid;
}

StoredSurface stored(const openvdb::GridPtrVec& grids)
{
    Progress progress;
    SurfaceOptions options;
    options.curvatureTotals = true;
    return storedSurface(grids, openvdb::MetaMap(), options, Coloring(), progress);
}

// Coordinates of 32 bits are 0.06 Å apart there.
TEST(StoredSurface, IsMeasuredInTheFrameOfItsGrid)
{
    const SurfaceReport near = stored({sphere(0.0)}).result.report.surface;
    EXPECT_NEAR(near.area, 100.0 * M_PI, 0.1);
    const StoredSurface far = stored({sphere(9e5)});
    EXPECT_EQ(far.result.report.surface.area, near.area);
    EXPECT_EQ(far.result.report.surface.volume, near.volume);
    EXPECT_EQ(far.result.report.surface.integrals->gaussianCurvature,
              near.integrals->gaussianCurvature);
    for (const openvdb::Vec3f& p : far.result.mesh.positions) ASSERT_NEAR(p[0], 9e5, 5.2);
}

TEST(StoredSurface, NamesGridsOfOneName)
{
    const auto colors = [] {
        auto grid = openvdb::Vec3SGrid::create();
        grid->setName("Cd");
        return grid;
    };
    const StoredSurface found = stored({sphere(0.0), colors(), colors()});
    const auto& warnings = found.warnings;
    EXPECT_EQ(std::count(warnings.begin(), warnings.end(),
                         "grid 'Cd': 2 of this name, of which the first counts"),
              1);
}

} // namespace
} // namespace molsurf
