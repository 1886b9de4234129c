// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/leaf_mask.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace molsurf
{
namespace
{

LeafMask randomMask(unsigned seed, std::vector<bool>& plain)
{
    std::mt19937 random(seed);
    plain.assign(512, false);
    LeafMask mask;
    for (int v = 0; v < 512; ++v) {
        plain[v] = random() % 3 == 0;
        mask.set(v, plain[v]);
    }
    return mask;
}

TEST(LeafMask, AgreesWithAPlainArray)
{
    std::vector<bool> a, b;
    const LeafMask A = randomMask(1, a), B = randomMask(2, b);
    int count = 0;
    for (int v = 0; v < 512; ++v) {
        EXPECT_EQ(A.on(v), a[v]);
        EXPECT_EQ((A & B).on(v), a[v] && b[v]);
        EXPECT_EQ((A | B).on(v), a[v] || b[v]);
        EXPECT_EQ((~A).on(v), !a[v]);
        EXPECT_EQ(bool(A.row(v >> 3) >> (v & 7) & 1), a[v]);
        count += a[v];
    }
    EXPECT_EQ(A.count(), count);
    std::vector<int> seen;
    A.forEach([&](int v) { seen.push_back(v); });
    ASSERT_EQ(int(seen.size()), count);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_TRUE(a[seen[i]]);
        if (i > 0) {
            EXPECT_LT(seen[i - 1], seen[i]);
        }
    }
}

TEST(LeafMask, StartsEmptyAndItsInverseIsFull)
{
    EXPECT_FALSE(LeafMask().any());
    EXPECT_EQ(LeafMask().count(), 0);
    EXPECT_EQ((~LeafMask()).count(), 512);
    for (const int v : {0, 63, 64, 511}) {
        LeafMask mask;
        mask.set(v);
        EXPECT_TRUE(mask.any());
        EXPECT_EQ(mask.count(), 1);
        EXPECT_TRUE(mask.on(v));
    }
}

} // namespace
} // namespace molsurf
