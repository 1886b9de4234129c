// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/thicken.h"

#include "support/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

const Vec3d from(-3.1, 0.4, -0.7), to(2.9, 1.3, 0.6); // ends of a thread, off the lattice [Å]

double toThread(const Vec3d& x)
{
    const Vec3d way = to - from;
    const double t = std::clamp((x - from).dot(way) / way.lengthSqr(), 0.0, 1.0);
    return (x - from - t * way).length();
}

DistanceBand bandOf(const test::Function& distance, double voxel, double inside, double outside)
{
    DistanceBand S;
    const LeafTable table = test::bandTable(distance, Vec3d(0.0), 9.0, voxel, -inside, outside);
    S.phi = test::filled(table, voxel, distance);
    S.kinks = table;
    for (std::size_t n = 0; n < table.size(); ++n) S.kinks.active(n) = LeafMask();
    return S;
}

/// Largest difference from a function at voxels near its zero.
double errorOf(const DistanceBand& S, double voxel, const test::Function& wanted)
{
    double worst = 0.0;
    std::size_t near = 0;
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        if (std::abs(wanted(x)) > voxel) return;
        ++near;
        worst = std::max(worst, std::abs(double(S.phi.leaf(n)[v]) - wanted(x)));
    });
    EXPECT_GT(near, 100u);
    return worst;
}

// A thread of radius 0.6 comes to that of the wall, ends included; half a diagonal of a voxel is
// how far the middle of a ball may be from the thread.
TEST(ThickenWalls, AThreadComesToTheWall)
{
    const double voxel = 0.25, wall = 3.0, width = 1.0;
    DistanceBand S = bandOf([](const Vec3d& x) { return toThread(x) - 0.6; }, voxel,
                            0.5 * wall + width, 0.5 * wall + width);
    thickenWalls(S, wall, width, Progress());
    const auto wanted = [&](const Vec3d& x) { return toThread(x) - 0.5 * wall; };
    EXPECT_LT(errorOf(S, voxel, wanted), 0.5 * std::sqrt(3.0) * voxel);
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d&) {
        ASSERT_LT(std::abs(S.phi.leaf(n)[v]), width);
    });
}

TEST(ThickenWalls, WhatIsThickStaysAsItIs)
{
    const double voxel = 0.25, wall = 3.0, width = 1.0;
    const auto distance = [](const Vec3d& x) { return toThread(x) - 1.8; };
    DistanceBand S = bandOf(distance, voxel, 0.5 * wall + width, 0.5 * wall + width);
    thickenWalls(S, wall, width, Progress());
    EXPECT_LT(errorOf(S, voxel, distance), 1e-6);
}

// Half a wall is what counts: the middle of what is between one and two walls thick is left alone.
TEST(ThickenWalls, WhatIsBarelyThickEnoughStays)
{
    const double voxel = 0.25, wall = 2.0, width = 1.0;
    const auto distance = [](const Vec3d& x) { return toThread(x) - 1.5; };
    DistanceBand S = bandOf(distance, voxel, wall + width, wall + width);
    thickenWalls(S, wall, width, Progress());
    EXPECT_LT(errorOf(S, voxel, distance), 1e-6);
}

// A wall of eight voxels: many voxels lie four voxels from one in the middle. Where S were 0 there,
// vertices of the mesh would fall together.
TEST(ThickenWalls, NoVoxelLiesOnTheSurface)
{
    const double voxel = 0.25, wall = 2.0, width = 1.0;
    DistanceBand S = bandOf([](const Vec3d& x) { return toThread(x) - 0.6; }, voxel,
                            0.5 * wall + width, 0.5 * wall + width);
    thickenWalls(S, wall, width, Progress());
    test::forEachActive(S.phi.table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        ASSERT_GT(std::abs(S.phi.leaf(n)[v]), 0.0009 * voxel) << x;
    });
}

} // namespace
} // namespace molsurf
