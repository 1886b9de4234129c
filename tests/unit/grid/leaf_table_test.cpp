// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/leaf_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Coord;

/// Leaves at random places about the origin, in random order, each with some active voxels.
LeafTable randomTable(unsigned seed, int places, int voxels)
{
    std::mt19937 random(seed);
    std::set<Coord> chosen;
    for (int i = 0; i < places; ++i) {
        chosen.insert(Coord(8 * (int(random() % 7) - 4), 8 * (int(random() % 7) - 4),
                            8 * (int(random() % 7) - 4)));
    }
    std::vector<Coord> origins(chosen.begin(), chosen.end());
    std::shuffle(origins.begin(), origins.end(), random);
    LeafTable table(origins);
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int i = 0; i < voxels; ++i) table.active(n).set(int(random() % 512));
    }
    return table;
}

// Against one value at a time, with values at the limit, both zeros, and no number.
TEST(LeafMasks, AreOfTheValuesBelowALimit)
{
    std::mt19937 random(11);
    const float special[] = {1.5f, -1.5f, 0.0f, -0.0f, 1e30f, -1e30f, std::nanf("")};
    for (int round = 0; round < 20; ++round) {
        float values[leafSize];
        for (float& value : values) {
            value =
                random() % 4 == 0 ? special[random() % 7] : float(random() % 4001) * 1e-3f - 2.0f;
        }
        const LeafMask less = lessThan(values, 1.5f), near = within(values, 1.5f);
        for (int v = 0; v < leafSize; ++v) {
            EXPECT_EQ(less.on(v), values[v] < 1.5f) << values[v];
            EXPECT_EQ(near.on(v), std::abs(values[v]) < 1.5f) << values[v];
        }
    }
}

std::set<Coord> activeVoxels(const LeafTable& table)
{
    std::set<Coord> out;
    for (std::size_t n = 0; n < table.size(); ++n) {
        table.active(n).forEach(
            [&](int v) { out.insert(table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7)); });
    }
    return out;
}

TEST(LeafTable, NeighboursAndFindAgreeWithASearch)
{
    const LeafTable table = randomTable(7, 150, 1);
    ASSERT_GT(table.size(), 80u);
    const auto index = [&](const Coord& origin) {
        const auto& all = table.origins();
        const auto it = std::find(all.begin(), all.end(), origin);
        return it == all.end() ? noLeaf : std::int32_t(it - all.begin());
    };
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (n > 0) {
            const Coord a = table.origin(n - 1), b = table.origin(n);
            EXPECT_LT(std::make_pair(a >> 6, a), std::make_pair(b >> 6, b)); // tile by tile
        }
        EXPECT_EQ(table.neighbours(n)[centreNeighbour], std::int32_t(n));
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dz = -1; dz <= 1; ++dz) {
                    EXPECT_EQ(table.neighbours(n)[9 * (dx + 1) + 3 * (dy + 1) + dz + 1],
                              index(table.origin(n).offsetBy(8 * dx, 8 * dy, 8 * dz)));
                }
            }
        }
    }
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        const Coord voxel(int(random() % 80) - 40, int(random() % 80) - 40,
                          int(random() % 80) - 40);
        const auto origin = [](int x) { return 8 * int(std::floor(x / 8.0)); };
        EXPECT_EQ(table.find(voxel),
                  index(Coord(origin(voxel.x()), origin(voxel.y()), origin(voxel.z()))));
    }
}

TEST(LeafTable, AnEmptyTableHasNothing)
{
    const LeafTable table;
    EXPECT_EQ(table.size(), 0u);
    EXPECT_EQ(table.find(Coord(0)), noLeaf);
    EXPECT_EQ(table.activeCount(), 0u);
    EXPECT_EQ(dilated(table, 3, Spread::Ball, Progress()).size(), 0u);
}

// Every step by hand, on coordinates, from single voxels at corners, edges and faces of leaves.
std::set<Coord> dilatedByHand(std::set<Coord> now, int steps, Spread spread)
{
    for (int step = 0; step < steps; ++step) {
        const bool full = spread == Spread::Cube || step % 2 == 1;
        std::set<Coord> next = now;
        for (const Coord& c : now) {
            for (int k = 0; k < 27; ++k) {
                const int dx = k / 9 - 1, dy = k / 3 % 3 - 1, dz = k % 3 - 1;
                if (full || std::abs(dx) + std::abs(dy) + std::abs(dz) == 1)
                    next.insert(c.offsetBy(dx, dy, dz));
            }
        }
        now = std::move(next);
    }
    return now;
}

TEST(Dilated, AgreesWithASearchAcrossLeavesAndSigns)
{
    for (const Spread spread : {Spread::Cube, Spread::Ball}) {
        for (const int steps : {0, 1, 2, 5, 8}) {
            const LeafTable table = randomTable(11 + steps, 6, 2);
            const LeafTable out = dilated(table, steps, spread, Progress());
            EXPECT_EQ(activeVoxels(out), dilatedByHand(activeVoxels(table), steps, spread))
                << steps << " steps";
            for (std::size_t n = 0; n < out.size(); ++n) EXPECT_TRUE(out.active(n).any());
        }
    }
}

TEST(Dilated, BallOfNStepsHoldsTheEuclideanBall)
{
    for (const Coord& seed : {Coord(0), Coord(-1, 7, 8), Coord(-8, -9, 3)}) {
        LeafTable table({seed & ~7});
        table.active(0).set(64 * (seed.x() & 7) + 8 * (seed.y() & 7) + (seed.z() & 7));
        for (int n = 1; n <= 8; ++n) {
            const std::set<Coord> out = activeVoxels(dilated(table, n, Spread::Ball, Progress()));
            for (int x = -n; x <= n; ++x) {
                for (int y = -n; y <= n; ++y) {
                    for (int z = -n; z <= n; ++z) {
                        if (x * x + y * y + z * z > n * n) continue;
                        EXPECT_TRUE(out.count(seed.offsetBy(x, y, z)))
                            << n << " steps: " << x << ' ' << y << ' ' << z;
                    }
                }
            }
        }
    }
}

TEST(Pruned, DropsOnlyTheEmptyLeaves)
{
    LeafTable table = randomTable(5, 40, 1);
    for (std::size_t n = 0; n < table.size(); n += 3) table.active(n) = LeafMask();
    const LeafTable out = pruned(table);
    EXPECT_LT(out.size(), table.size());
    EXPECT_EQ(activeVoxels(out), activeVoxels(table));
    for (std::size_t n = 0; n < out.size(); ++n) EXPECT_TRUE(out.active(n).any());
}

} // namespace
} // namespace molsurf
