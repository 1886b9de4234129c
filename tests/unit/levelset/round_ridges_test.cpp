// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/round_ridges.h"

#include "molsurf/grid/leaf_block.h"
#include "molsurf/levelset/stencil.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// A lens: its rim is a ridge at which the normal turns by 60 degrees.
double lens(const Vec3d& x)
{
    const Vec3d c(0.13, -0.21, 3.08);
    return std::max((x - c).length(), (x + c).length()) - 6.0;
}

DistanceBand bandOf(double voxel)
{
    DistanceBand S;
    S.phi = test::filled(test::bandTable(lens, Vec3d(0.0), 6.0, voxel, -2.0, 2.0), voxel, lens);
    S.kinks = S.phi.table;
    for (std::size_t n = 0; n < S.kinks.size(); ++n) S.kinks.active(n) = LeafMask();
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const Vec3d c(0.13, -0.21, 3.08);
        if (std::abs((x - c).length() - (x + c).length()) < 1.5 * voxel) S.kinks.active(n).set(v);
    });
    return S;
}

/// The largest mean curvature at voxels next to S = 0 [1/Å].
double sharpest(const DistanceBand& S, double voxel)
{
    double worst = 0.0;
    for (std::size_t n = 0; n < S.phi.table.size(); ++n) {
        LeafBlock<float, 1> block;
        block.gather(S.phi.table, S.phi.values, n);
        S.phi.table.active(n).forEach([&](int v) {
            const float* p = block.at(v >> 6, v >> 3 & 7, v & 7);
            if (std::abs(*p) > 0.5 * voxel) return;
            const Derivatives d = derivatives<1>(p, float(1.0 / voxel));
            const double slope2 = d.x * d.x + d.y * d.y + d.z * d.z;
            const double along = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                                  2.0 * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                                 slope2;
            worst = std::max(worst, 0.5 * (d.xx + d.yy + d.zz - along) / std::sqrt(slope2));
        });
    }
    return worst;
}

TEST(RoundRidges, ComeToTheStatedRadius)
{
    for (const double voxel : {0.25, 0.125}) {
        DistanceBand S = bandOf(voxel);
        const double before = sharpest(S, voxel);
        EXPECT_GT(before, 0.5 / voxel);
        roundRidges(S, Progress());
        EXPECT_LT(sharpest(S, voxel), 1.5 * 0.5 / ridgeRadius + 0.5);
        EXPECT_LT(sharpest(S, voxel), 0.7 * before);
    }
}

TEST(RoundRidges, LeaveAllElseAsItIs)
{
    const double voxel = 0.25;
    const DistanceBand before = bandOf(voxel);
    DistanceBand S = bandOf(voxel);
    roundRidges(S, Progress());
    std::size_t moved = 0;
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        if (S.phi.leaf(n)[v] == before.phi.leaf(n)[v]) return;
        ++moved;
        EXPECT_LT(std::abs(x.dot(Vec3d(0.13, -0.21, 3.08).unit())), ridgeReach(voxel) * voxel);
        EXPECT_GT(S.phi.leaf(n)[v], before.phi.leaf(n)[v]); // inward
    });
    EXPECT_GT(moved, 100u);

    DistanceBand coarse = bandOf(1.0);
    roundRidges(coarse, Progress());
    EXPECT_EQ(ridgeReach(1.0), 0);
}

} // namespace
} // namespace molsurf
