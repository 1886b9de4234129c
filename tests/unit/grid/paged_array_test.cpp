// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/leaf_table.h"
#include "molsurf/kernel/grid/paged_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>

namespace molsurf
{
namespace
{

constexpr std::size_t perPage = PagedMemory::pageBytes / sizeof(std::int32_t);

TEST(PagedArray, HoldsEveryValueOnItsOwn)
{
    for (const std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(1000), perPage - 1,
                                   perPage, perPage + 1, 3 * perPage + 7}) {
        PagedArray<std::int32_t> array(size);
        EXPECT_EQ(array.size(), size);
        EXPECT_EQ(array.empty(), size == 0);
        for (std::size_t i = 0; i < size; ++i) array[i] = std::int32_t(i);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < size; ++i) wrong += array[i] != std::int32_t(i);
        EXPECT_EQ(wrong, 0u) << size;
    }
}

TEST(PagedArray, MovesAndLeavesNothing)
{
    for (const std::size_t size : {std::size_t(100), 2 * perPage}) {
        PagedArray<std::int32_t> a(size);
        a[size - 1] = 7;
        const std::int32_t* last = &a[size - 1];
        PagedArray<std::int32_t> b = std::move(a);
        EXPECT_EQ(a.size(), 0u); // NOLINT(bugprone-use-after-move)
        EXPECT_EQ(&b[size - 1], last);
        b = PagedArray<std::int32_t>(1);
        EXPECT_EQ(b.size(), 1u);
    }
}

TEST(PagedArray, TakesThePagesThatAnotherHasLeft)
{
    std::set<const void*> first, second;
    {
        PagedArray<float> a(4 * perPage);
        for (std::size_t p = 0; p < 4; ++p) first.insert(&a[p * perPage]);
    }
    PagedArray<float> b(4 * perPage);
    for (std::size_t p = 0; p < 4; ++p) second.insert(&b[p * perPage]);
    EXPECT_EQ(first, second);
}

TEST(PagedArray, IsWrittenAfterItsPagesWereReleased)
{
    {
        PagedArray<float> a(2 * perPage);
        a[0] = 1.0f;
    }
    releasePages();
    PagedArray<float> b(2 * perPage);
    b[perPage] = 2.0f;
    EXPECT_EQ(b[perPage], 2.0f);
}

TEST(LeafArray, HasItsLeavesInOnePieceEach)
{
    LeafArray<float> field(3000); // several pages
    EXPECT_EQ(field.leafCount(), 3000u);
    for (std::size_t n = 0; n < field.leafCount(); ++n) {
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.leaf(n)) % 64, 0u);
        for (int v = 0; v < leafSize; ++v) field.leaf(n)[v] = float(n);
    }
    const LeafField same = copied(field);
    for (std::size_t n = 0; n < field.leafCount(); ++n)
        ASSERT_EQ(same.leaf(n)[leafSize - 1], float(n));
}

TEST(LeafArray, LendsItsBytesToAnotherType)
{
    LeafArray<std::int32_t> index(2000);
    for (std::size_t n = 0; n < 2000; ++n) index.leaf(n)[511] = std::int32_t(n);
    LeafField phi = std::move(index).reused<float>();
    EXPECT_EQ(index.leafCount(), 0u); // NOLINT(bugprone-use-after-move)
    ASSERT_EQ(phi.leafCount(), 2000u);
    for (std::size_t n = 0; n < 2000; ++n) {
        std::int32_t value;
        std::memcpy(&value, phi.leaf(n) + 511, sizeof value);
        ASSERT_EQ(value, std::int32_t(n));
    }
}

} // namespace
} // namespace molsurf
