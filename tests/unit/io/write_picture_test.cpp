// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_picture.h"

#include "folder.h"

#include <openvdb/tools/LevelSetSphere.h>
#include <png.h>
#include <tbb/global_control.h>

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

openvdb::FloatGrid::Ptr sphere(const openvdb::Vec3f& center)
{
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0f, center, 0.4f);
}

const std::uint8_t* pixel(const Picture& picture, int x, int y)
{
    return picture.rgb.data() + 3 * (y * picture.width + x);
}

TEST(DrawSurface, ShowsASphereInTheMiddleOnWhite)
{
    const Picture picture = drawSurface(*sphere({30.0f, -7.0f, 4.0f}), 100);
    ASSERT_EQ(picture.width, 100);
    ASSERT_EQ(picture.rgb.size(), 3u * 100u * std::size_t(picture.height));
    EXPECT_NEAR(picture.height, 100, 3);
    EXPECT_EQ(pixel(picture, 1, 1)[0], 255);
    EXPECT_LT(pixel(picture, 50, picture.height / 2)[0], 230);
    int colored = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < 100; ++x) colored += pixel(picture, x, y)[0] < 250;
    // What is fitted to the picture is the band, which reaches 2 to 3 voxels beyond the sphere; the
    // pixels on the rim count as a whole, which is half a pixel more of radius, or 3 % of the area.
    const double radius = 50.0 * 5.0 / (5.0 + 2.5 * 0.4) / 1.06 + 0.5;
    const double disc = 3.14159 * radius * radius;
    EXPECT_NEAR(colored, disc, 0.06 * disc);
}

TEST(DrawSurface, SameForOneAndTwoThreads)
{
    const auto grid = sphere({0.1f, 0.2f, 0.3f});
    const Picture two = drawSurface(*grid, 60);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(drawSurface(*grid, 60).rgb, two.rgb);
}

TEST(DrawSurface, EmptyGridIsBlank)
{
    const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(0.5, 3.0);
    const Picture picture = drawSurface(*grid, 20);
    EXPECT_EQ(picture.rgb, std::vector<std::uint8_t>(3 * 20 * 20, 255));
}

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

} // namespace
} // namespace molsurf
