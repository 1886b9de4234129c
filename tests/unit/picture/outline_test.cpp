// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/outline.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(InkOf, IsADiscAboutEachSampleWithASoftRim)
{
    constexpr std::size_t width = 11;
    std::vector<std::uint8_t> edges(width * 9, 0);
    edges[4 * width + 5] = 1;
    edges[0] = 2;
    const auto ink = inkOf(width, edges, {0.0f, 2.25f, 0.0f}, Progress());
    const auto at = [&](std::size_t x, std::size_t y) { return int(ink[y * width + x]); };
    EXPECT_EQ(at(5, 4), 255);
    EXPECT_EQ(at(7, 4), 191); // 2.25 + 0.5 - 2 = 0.75
    EXPECT_EQ(at(5, 2), 191);
    EXPECT_EQ(at(8, 4), 0);
    EXPECT_NEAR(at(7, 5), 255 * (2.75 - 2.2360680), 1.0);
    EXPECT_EQ(at(0, 0), 0); // lines of its kind have no width
}

} // namespace
} // namespace molsurf
