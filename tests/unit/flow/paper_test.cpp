// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/paper_step.h"
#include "support/convergence.h"
#include "support/exact_minimum.h"
#include "support/fields.h"
#include "support/flow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

const Ball loneAtom{openvdb::Vec3f(0.137f, -0.291f, 0.443f), 1.7f, 0};

double radiusOf(const test::Evolved& out)
{
    double sum = 0.0;
    const auto directions = test::directions(200);
    for (const Vec3d& n : directions)
        sum += test::zeroOnRay(out.spline, Vec3d(loneAtom.center), n, 2.0, 4.5);
    return sum / double(directions.size());
}

// The scheme of the paper as it stands: speeds at voxels see the steep side of the metric, which
// also sets its time step. It comes near the minimum, not to it, and its rule is never met.
TEST(PaperFlow, ComesNearTheMinimumAndNeverMeetsItsRule)
{
    EvolveOptions options;
    options.flow = Flow::Paper;
    options.maxSteps = 600;
    const double exact = test::minimalRadius(3.1, {});
    for (const double voxel : {0.5, 0.25}) {
        const test::Evolved out = test::evolveBalls({loneAtom}, 0.5, voxel, options);
        EXPECT_FALSE(out.report.converged);
        EXPECT_EQ(out.report.steps, 600);
        EXPECT_GT(out.report.maxSpeed.back(), 100.0 * paperSpeed);
        const double off = std::abs(radiusOf(out) - exact);
        EXPECT_GT(off, 0.005) << voxel;
        EXPECT_LT(off, 0.05) << voxel;
    }
}

// The time step is the largest that moves nothing by more than a voxel.
TEST(PaperFlow, MovesByAVoxelAtMost)
{
    EvolveOptions options;
    options.flow = Flow::Paper;
    options.steps = 3;
    const test::Evolved out = test::evolveBalls({loneAtom}, 0.5, 0.5, options);
    ASSERT_EQ(out.report.steps, 3);
    for (const double moved : out.report.meanDisplacement) {
        EXPECT_GT(moved, 0.0);
        EXPECT_LT(moved, 0.5);
    }
}

} // namespace
} // namespace molsurf
