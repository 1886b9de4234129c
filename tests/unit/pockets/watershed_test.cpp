// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/watershed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

/// A space of one row of voxels along x with these clearances, deep below the cut.
VoidField rowOf(const std::vector<float>& clearances)
{
    const int leaves = int(clearances.size()) / leafDim + 1;
    std::vector<openvdb::Coord> origins;
    for (int i = 0; i < leaves; ++i) origins.emplace_back(leafDim * i, 0, 0);
    VoidField space{LeafTable(origins), LeafField(origins.size()), LeafField(origins.size()), 1.0,
                    nullptr};
    for (std::size_t n = 0; n < space.table.size(); ++n) {
        std::fill_n(space.clearance.leaf(n), leafSize, -1.0f);
        std::fill_n(space.below.leaf(n), leafSize, 9.0f);
    }
    for (std::size_t i = 0; i < clearances.size(); ++i) {
        const auto n = std::size_t(space.table.find({int(i), 0, 0}));
        const int v = 64 * int(i % leafDim);
        space.clearance.leaf(n)[v] = clearances[i];
        space.table.active(n).set(v, clearances[i] > 0.0f);
    }
    return space;
}

std::int32_t basinOf(const VoidField& space, const Basins& basins, int x)
{
    return basins.of.leaf(std::size_t(space.table.find({x, 0, 0})))[64 * (x % leafDim)];
}

TEST(Basins, ANeckBelowTheShareOfTheSmallerPeakSplits)
{
    const VoidField space = rowOf({1.0f, 4.0f, 3.0f, 1.4f, 1.6f, 2.0f, 2.8f, 1.0f, 1.0f, 1.0f});
    EXPECT_EQ(splitAtNecks(space, 0.49, 0.0).count(), 1u);
    const Basins two = splitAtNecks(space, 0.51, 0.0);
    ASSERT_EQ(two.count(), 2u);
    EXPECT_EQ(two.peaks, (std::vector<float>{4.0f, 2.8f}));
    ASSERT_EQ(two.necks.size(), 1u);
    EXPECT_EQ(two.necks[0].clearance, 1.4f);
    EXPECT_EQ(basinOf(space, two, 2), 0);
    EXPECT_EQ(basinOf(space, two, 3), 0); // it is beside 3
    EXPECT_EQ(basinOf(space, two, 4), 1);
    EXPECT_EQ(basinOf(space, two, 9), 1); // in the next leaf
}

TEST(Basins, SmallOnesJoinTheWidestNeck)
{
    const VoidField space = rowOf({4.0f, 1.0f, 3.0f, 1.2f, 3.5f, 3.4f});
    EXPECT_EQ(splitAtNecks(space, 0.5, 0.0).count(), 3u);
    const Basins joined = splitAtNecks(space, 0.5, 2.0);
    ASSERT_EQ(joined.count(), 2u);
    EXPECT_EQ(basinOf(space, joined, 2), basinOf(space, joined, 4));
    EXPECT_NE(basinOf(space, joined, 2), basinOf(space, joined, 0));
}

/// Two small ones that join are one small one, which joins the next.
TEST(Basins, SmallOnesJoinUntilTheyAreLarge)
{
    const VoidField space = rowOf({3.0f, 1.4f, 2.9f, 2.8f, 1.2f, 4.0f, 4.0f, 4.0f, 4.0f, 4.0f});
    EXPECT_EQ(splitAtNecks(space, 0.5, 0.0).count(), 3u);
    EXPECT_EQ(splitAtNecks(space, 0.5, 4.0).count(), 2u);
    EXPECT_EQ(splitAtNecks(space, 0.5, 5.0).count(), 1u);
}

TEST(Basins, WhatDoesNotHangTogetherStaysApart)
{
    const VoidField space = rowOf({2.0f, 2.0f, -1.0f, 2.0f, 2.0f});
    const Basins basins = splitAtNecks(space, 0.0, 10.0);
    EXPECT_EQ(basins.count(), 2u);
    EXPECT_TRUE(basins.necks.empty());
}

} // namespace
} // namespace molsurf
