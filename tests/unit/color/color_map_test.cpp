// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/color_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

TEST(LinearLight, IsThatOfTheStandardOfSrgb)
{
    const openvdb::Vec3f ends = linearLight({0, 255, 10}), middle = linearLight({128, 188, 55});
    EXPECT_EQ(ends.x(), 0.0f);
    EXPECT_EQ(ends.y(), 1.0f);
    // IEC 61966-2-1; the first is on its straight part.
    EXPECT_NEAR(ends.z(), 0.0030353, 1e-6);
    EXPECT_NEAR(middle.x(), 0.2158605, 1e-6);
    EXPECT_NEAR(middle.y(), 0.5028865, 1e-6);
    EXPECT_NEAR(middle.z(), 0.0382044, 1e-6);
}

TEST(ColorScale, EndsMiddleAndBeyond)
{
    const ColorScale plain = scaleOf("viridis", 0.0, 2.0);
    EXPECT_EQ(plain.at(0.0), (Color{68, 1, 84}));
    EXPECT_EQ(plain.at(2.0), (Color{253, 231, 37}));
    EXPECT_EQ(plain.at(5.0), plain.at(2.0));
    EXPECT_EQ(plain.at(-1.0), plain.at(0.0));
    EXPECT_EQ(plain.at(std::nan("")), plain.at(0.0));
    EXPECT_EQ(plain.at(2.0 / 9.0), plain.stops[1]);
    const ColorScale both = scaleOf("RdBu", -2.0, 2.0);
    EXPECT_EQ(both.at(0.0), (Color{247, 247, 247}));
    EXPECT_GT(both.at(2.0)[0], both.at(2.0)[2]);   // red outside
    EXPECT_GT(both.at(-2.0)[2], both.at(-2.0)[0]); // blue inside
}

// In steps each stop has its own colour from its value on, whatever rounding does to that.
TEST(ColorScale, AStepBeginsAtItsValue)
{
    ColorScale scale{"steps", 0.0, 100.0, {}, true};
    for (int i = 0; i <= 100; ++i) scale.stops.push_back({std::uint8_t(i), 0, 0});
    for (const double size : {1.0, 0.01, 0.7, 30.0}) {
        scale.low = -3.0 * size;
        scale.high = 97.0 * size;
        for (int i = 0; i <= 100; ++i) {
            EXPECT_EQ(scale.at((i - 3) * size), scale.stops[std::size_t(i)]) << i << " " << size;
            EXPECT_EQ(scale.at((i - 2.001) * size), scale.stops[std::size_t(i)]) << i;
        }
    }
}

} // namespace
} // namespace molsurf
