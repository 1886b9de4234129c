// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/round_ridges.h"

#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/stencil.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
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

constexpr double probe = 1.4;

/// @param[in] sign  -1: the space about the lens, whose rim is a concave crease
DistanceBand bandOf(double voxel, double sign = 1.0)
{
    const auto f = [sign](const Vec3d& x) { return sign * lens(x); };
    const double width = std::max(4.0 * voxel, 0.75);
    DistanceBand S;
    S.phi = test::filled(test::bandTable(f, Vec3d(0.0), 6.0, voxel, -width, width), voxel, f);
    S.kinks = S.phi.table;
    for (std::size_t n = 0; n < S.kinks.size(); ++n) S.kinks.active(n) = LeafMask();
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const Vec3d c(0.13, -0.21, 3.08);
        if (std::abs((x - c).length() - (x + c).length()) < 1.5 * voxel) S.kinks.active(n).set(v);
    });
    return S;
}

/// The largest mean curvature at voxels next to S = 0 [1/Å], in magnitude of one sign.
double sharpest(const DistanceBand& S, double voxel, double sign = 1.0)
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
            worst = std::max(worst, sign * 0.5 * (d.xx + d.yy + d.zz - along) / std::sqrt(slope2));
        });
    }
    return worst;
}

// Convex and concave ones, to a curvature that does not depend on the voxel.
TEST(RoundRidges, ComeToTheStatedRadius)
{
    for (const double sign : {1.0, -1.0}) {
        double coarser = 0.0;
        for (const double voxel : {0.25, 0.125, 0.0625}) {
            DistanceBand S = bandOf(voxel, sign);
            const double before = sharpest(S, voxel, sign);
            EXPECT_GT(before, 0.5 / voxel);
            roundRidges(S, probe, Progress());
            const double after = sharpest(S, voxel, sign);
            EXPECT_LT(after, 1.5 * 0.5 / ridgeRadius + 0.1) << sign << " " << voxel;
            EXPECT_LT(after, 0.7 * before);
            if (voxel == 0.0625) {
                EXPECT_NEAR(after, coarser, 0.15 * coarser) << sign;
            }
            coarser = after;
        }
    }
}

// Where no kink is marked, a sharp place is found by its curvature.
TEST(RoundRidges, AreFoundByCurvatureToo)
{
    const double voxel = 0.125;
    DistanceBand S = bandOf(voxel);
    for (std::size_t n = 0; n < S.kinks.size(); ++n) S.kinks.active(n) = LeafMask();
    const double before = sharpest(S, voxel);
    roundRidges(S, probe, Progress());
    EXPECT_LT(sharpest(S, voxel), 0.5 * before);
}

// A concave crease of a surface that lies 0.2 Å inside another may have a radius of 0.2 Å.
TEST(RoundRidges, LeaveWhatAnOffsetBends)
{
    const double voxel = 0.125;
    DistanceBand wide = bandOf(voxel, -1.0), narrow = bandOf(voxel, -1.0), none = bandOf(voxel);
    roundRidges(wide, probe, Progress());
    roundRidges(narrow, 0.2, Progress());
    EXPECT_GT(sharpest(narrow, voxel, -1.0), 1.2 * sharpest(wide, voxel, -1.0));
    const double before = sharpest(none, voxel);
    roundRidges(none, 0.0, Progress());
    EXPECT_EQ(sharpest(none, voxel), before);
}

/// A small ball bends more than a ridge may, and its inner voxels more still.
TEST(RoundRidges, LeaveSmallBalls)
{
    constexpr double voxel = 0.25, radius = 0.8;
    const auto ball = [](const Vec3d& x) {
        return (x - Vec3d(0.13, -0.21, 0.08)).length() - radius;
    };
    DistanceBand S;
    S.phi = test::filled(test::bandTable(ball, Vec3d(0.0), 2.0, voxel, -0.7, 1.0), voxel, ball);
    S.kinks = S.phi.table;
    for (std::size_t n = 0; n < S.kinks.size(); ++n) S.kinks.active(n) = LeafMask();
    const LeafField before = copied(S.phi).values;
    roundRidges(S, probe, Progress());
    for (std::size_t n = 0; n < S.phi.table.size(); ++n)
        for (int v = 0; v < leafSize; ++v) EXPECT_EQ(S.phi.leaf(n)[v], before.leaf(n)[v]);
}

TEST(RoundRidges, LeaveAllElseAsItIs)
{
    const double voxel = 0.25;
    const DistanceBand before = bandOf(voxel);
    DistanceBand S = bandOf(voxel);
    roundRidges(S, probe, Progress());
    std::size_t moved = 0;
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        if (S.phi.leaf(n)[v] == before.phi.leaf(n)[v]) return;
        ++moved;
        EXPECT_LT(std::abs(x.dot(Vec3d(0.13, -0.21, 3.08).unit())), ridgeReach(voxel) * voxel);
        EXPECT_GT(S.phi.leaf(n)[v], before.phi.leaf(n)[v]); // inward
    });
    EXPECT_GT(moved, 100u);

    DistanceBand coarse = bandOf(1.0);
    roundRidges(coarse, probe, Progress());
    EXPECT_EQ(ridgeReach(1.0), 0);
}

} // namespace
} // namespace molsurf
