// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/write_png.h"

#include "support/folder.h"

#include <png.h>

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(WritePng, ReadsBackAsItWas)
{
    Picture picture;
    picture.width = 7;
    picture.height = 5;
    for (int n = 0; n < 3 * 7 * 5; ++n) picture.rgb.push_back(std::uint8_t(37 * n));
    const std::string bytes = test::written([&](OutputFile& file) { writePng(picture, file); });

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    image.format = PNG_FORMAT_RGB;
    EXPECT_EQ(image.width, 7u);
    EXPECT_EQ(image.height, 5u);
    std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(image));
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, back.data(), 0, nullptr));
    EXPECT_EQ(back, picture.rgb);
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
