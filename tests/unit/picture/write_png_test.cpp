// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/write_png.h"

#include "support/folder.h"

#include <png.h>

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

// Of one block of rows and of many, with noise and with nothing in them.
TEST(WritePng, ReadsBackAsItWas)
{
    for (const int width : {1, 7, 1600}) {
        for (const bool clear : {false, true}) {
            Picture picture;
            picture.width = width;
            picture.height = 5 * width;
            const std::size_t pixels = std::size_t(5 * width * width);
            std::uint32_t noise = 1;
            const auto next = [&](std::size_t i) {
                noise = noise * 1664525u + 1013904223u;
                return std::uint8_t(i % 3000 < 1500 ? noise >> 24 : i / 3000);
            };
            std::vector<std::uint8_t> expected;
            for (std::size_t i = 0; i < pixels; ++i) {
                for (int c = 0; c < 3; ++c) picture.rgb.push_back(next(i));
                if (clear) picture.alpha.push_back(next(i));
                expected.insert(expected.end(), picture.rgb.end() - 3, picture.rgb.end());
                if (clear) expected.push_back(picture.alpha.back());
            }
            const std::string bytes =
                test::written([&](OutputFile& file) { writePng(picture, file); });

            png_image image{};
            image.version = PNG_IMAGE_VERSION;
            ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
            EXPECT_EQ(image.format, png_uint_32(clear ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB));
            EXPECT_EQ(image.width, png_uint_32(width));
            EXPECT_EQ(image.height, png_uint_32(5 * width));
            std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(image));
            ASSERT_TRUE(png_image_finish_read(&image, nullptr, back.data(), 0, nullptr));
            EXPECT_TRUE(back == expected) << width;
            EXPECT_EQ(image.warning_or_error, 0u) << image.message;
        }
    }
}

TEST(WritePng, SaysHowLargeItIsOnPaper)
{
    Picture picture;
    picture.width = picture.height = 1;
    picture.rgb = {1, 2, 3};
    picture.dpi = 300.0;
    const std::string bytes = test::written([&](OutputFile& file) { writePng(picture, file); });
    // 300 / 0.0254 = 11811 pixels a metre, both ways.
    EXPECT_NE(bytes.find(std::string("pHYs\0\0\x2E\x23\0\0\x2E\x23\1", 13)), std::string::npos);
    picture.dpi = 0.0;
    const std::string plain = test::written([&](OutputFile& file) { writePng(picture, file); });
    EXPECT_EQ(plain.find("pHYs"), std::string::npos);
}

} // namespace
} // namespace molsurf
