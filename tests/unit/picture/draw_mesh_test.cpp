// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_mesh.h"

#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/picture/style.h"
#include "unit/picture/add_ball.h"

#include <tbb/global_control.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;
using test::addBall;

constexpr Color red = {200, 30, 30}, blue = {30, 30, 200};

Color pixel(const Picture& picture, int x, int y)
{
    const std::uint8_t* p = picture.rgb.data() + 3 * (y * picture.width + x);
    return {p[0], p[1], p[2]};
}

TEST(DrawMesh, ShowsABallInTheMiddle)
{
    Mesh mesh;
    addBall(mesh, {30.0f, -7.0f, 4.0f}, 5.0f, red);
    DrawOptions options;
    options.width = 100;
    const Picture picture = drawMesh(mesh, options, Progress());
    ASSERT_EQ(picture.rgb.size(), 3u * 100u * std::size_t(picture.height));
    EXPECT_NEAR(picture.height, 100, 1);
    EXPECT_EQ(pixel(picture, 1, 1), options.background);
    const Color middle = pixel(picture, 50, picture.height / 2);
    EXPECT_GT(middle[0], 150);
    EXPECT_LT(middle[1], 80);
    int covered = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < 100; ++x) covered += pixel(picture, x, y) != options.background;
    }
    // Pixels on the rim, and under the line about it, count as a whole.
    const double disc = M_PI * std::pow(50.0 / 1.04 + 0.7, 2);
    EXPECT_NEAR(covered, disc, 0.03 * disc);
}

TEST(DrawMesh, LooksFromWhereItIsTold)
{
    Mesh mesh;
    addBall(mesh, {0.0f, 0.0f, 0.0f}, 2.0f, red);
    addBall(mesh, {0.0f, 0.0f, 6.0f}, 2.0f, blue);
    DrawOptions options;
    options.width = 90;
    const Picture side = drawMesh(mesh, options, Progress()); // both, side by side
    EXPECT_NEAR(side.height, 90.0 * 4.0 / 10.0, 2);
    const Color left = pixel(side, 18, side.height / 2), right = pixel(side, 72, side.height / 2);
    EXPECT_GT(left[0], left[2]);
    EXPECT_GT(right[2], right[0]);

    options.toEye = {0, 0, 1};
    options.up = {0, 1, 0};
    const Picture top = drawMesh(mesh, options, Progress());
    EXPECT_NEAR(top.height, 90, 1);
    EXPECT_GT(pixel(top, 45, 45)[2], pixel(top, 45, 45)[0]); // the blue one hides the red one

    options.turn = 180.0;
    const Picture back = drawMesh(mesh, options, Progress());
    const Color middle = pixel(back, 45, back.height / 2);
    EXPECT_GT(middle[0], middle[2]);
}

// Two parts, one of them twice and turned by a right angle, are drawn as if they had been copied.
TEST(DrawMesh, CopiesLookLikeWhatTheyAreCopiesOf)
{
    Mesh parts, whole;
    addBall(parts, {3.0f, 0.0f, 0.0f}, 2.0f, {255, 255, 255});
    parts.parts = {{"a", 0}, {"b", std::uint32_t(parts.triangles.size())}};
    addBall(parts, {0.0f, 0.0f, 0.0f}, 1.5f, {255, 255, 255});
    addBall(whole, {3.0f, 5.0f, 0.0f}, 2.0f, red);   // x -> x + (0, 5, 0)
    addBall(whole, {-1.0f, 3.0f, 1.0f}, 2.0f, blue); // (x, y, z) -> (-y - 1, x, z + 1)
    addBall(whole, {0.0f, 0.0f, -4.0f}, 1.5f, red);
    DrawOptions options;
    options.width = 120;
    options.toEye = {1, 2, 3};
    options.up = {0, 1, 0};
    const Picture expected = drawMesh(whole, options, Progress());
    const std::array<std::array<double, 3>, 3> same = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    options.instances = {{{same, {0, 5, 0}}, 0, "1", red},
                         {{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, {-1, 0, 1}}, 0, "2", blue},
                         {{same, {0, 0, -4}}, 1, "3", red}};
    const Picture copies = drawMesh(parts, options, Progress());
    // The frame comes from the outermost vertices alone, and the triangles of a turned ball differ.
    ASSERT_NEAR(copies.height, expected.height, 1);
    int differs = 0;
    for (int y = 0; y < expected.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const Color a = pixel(expected, x, y),
                        b = pixel(copies, x, y * copies.height / expected.height);
            for (std::size_t c = 0; c < 3; ++c) differs += std::abs(int(a[c]) - int(b[c])) > 40;
        }
    }
    EXPECT_LT(differs, 0.05 * double(expected.rgb.size()));
}

TEST(DrawMesh, CrevicesAreDark)
{
    Mesh mesh;
    addBall(mesh, {0.0f, 0.0f, 0.0f}, 4.0f, red);
    addBall(mesh, {6.0f, 0.0f, 0.0f}, 4.0f, red);
    DrawOptions options;
    options.width = 140;
    options.toEye = {0, 0, 1};
    options.up = {0, 1, 0};
    const Picture picture = drawMesh(mesh, options, Progress());
    EXPECT_LT(int(pixel(picture, 70, picture.height / 2)[0]) + 20,
              int(pixel(picture, 40, picture.height / 2)[0]));
}

/// Two balls, the smaller one above the middle of the larger, seen from there.
struct TwoBalls : testing::Test {
    Mesh mesh;
    DrawOptions options;
    TwoBalls()
    {
        addBall(mesh, {0.0f, 0.0f, 0.0f}, 10.0f, red);
        addBall(mesh, {0.0f, 0.0f, 14.0f}, 2.0f, blue);
        options.width = 208; // 0.1 Å a pixel
        options.toEye = {0, 0, 1};
        options.up = {0, 1, 0};
    }
    Picture drawn(const char* style)
    {
        options.style = findStyle(style);
        return drawMesh(mesh, options, Progress());
    }
};

TEST_F(TwoBalls, FlatColoursAreThoseOfTheMesh)
{
    const Picture picture = drawn("flat");
    EXPECT_EQ(pixel(picture, 104, 104), blue);
    EXPECT_EQ(pixel(picture, 30, 104), red);
}

// The lamp stands to the upper left: the small ball darkens what lies to its lower right.
TEST_F(TwoBalls, CastShadows)
{
    const Picture picture = drawn("soft");
    const auto sum = [&](int x, int y) {
        const Color c = pixel(picture, x, y);
        return int(c[0]) + int(c[1]) + int(c[2]);
    };
    // From the middle of the small ball along -lamp to the large one: (0, 0, 14) - t (-0.46, 0.57,
    // 0.69) has length 10 at t = 6.1, (2.8, -3.5, 9.8) Å, 28 pixels to the right and 35 down.
    EXPECT_GT(sum(104 - 28, 104 - 35), sum(104 + 28, 104 + 35) + 60);
    EXPECT_GT(sum(104 + 35, 104 - 28), sum(104 + 28, 104 + 35) + 30);
}

TEST_F(TwoBalls, TheNearestWallAloneLetsThrough)
{
    options.opacity = 0.5;
    const Picture picture = drawn("flat");
    const Vec3f expected = 0.5f * linearLight(blue) + Vec3f(0.5f);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(picture, 107, 101)[c], fromLinearLight(double(expected[int(c)])), 2);
}

TEST_F(TwoBalls, AllWallsLetThroughInTheRightOrder)
{
    options.opacity = 0.5;
    options.showBehind = true;
    const Picture picture = drawn("flat");
    // Four walls in the middle, of which each, seen from the front, takes half.
    const Vec3f b = linearLight(blue), r = linearLight(red);
    const Vec3f expected = 0.5f * b + 0.25f * b + 0.125f * r + 0.0625f * r + Vec3f(0.0625f);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(picture, 107, 101)[c], fromLinearLight(double(expected[int(c)])), 2);
}

// A wall of one thickness is crossed by a longer way where it is seen from the side.
TEST_F(TwoBalls, WhatIsSeenAslantHidesMore)
{
    options.opacity = 0.5;
    options.showBehind = true;
    const Picture picture = drawn("flat");
    const double x = 8.05,
                 facing = std::sqrt(1.0 - x * x / 100.0); // of both walls of the large ball
    const double through = std::pow(0.5, 2.0 / facing);
    const Vec3f r = linearLight(red);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(picture, 104 + 80, 104)[c],
                    fromLinearLight((1.0 - through) * double(r[int(c)]) + through), 3);
}

TEST_F(TwoBalls, ACueOfDepthLeavesWhatIsNear)
{
    options.depthCue = true;
    const Picture picture = drawn("flat");
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel(picture, 104, 104)[c], blue[c], 2);
    EXPECT_GT(pixel(picture, 30, 104)[2], red[2] + 20);
}

// Without the cut the small ball would darken the plane of the cut on the lower right alone.
TEST_F(TwoBalls, WhatIsCutAwayCastsNoShadow)
{
    options.clip = 3.0;
    const Picture picture = drawn("soft");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(picture, 104 + 42, 104 + 53)[c], pixel(picture, 104 - 42, 104 - 53)[c],
                    3);
}

TEST_F(TwoBalls, WallsBehindWallsAreNotInTheDark)
{
    options.opacity = 0.5;
    options.showBehind = true;
    const Picture flat = drawn("flat"), soft = drawn("soft");
    for (std::size_t c = 0; c < 3; ++c) {
        const float light = linearLight(pixel(soft, 107, 101))[int(c)];
        EXPECT_GT(light, 0.9f * linearLight(pixel(flat, 107, 101))[int(c)]) << c << " " << light;
    }
}

TEST_F(TwoBalls, ACutShowsTheInside)
{
    options.clip = 3.0; // the middle in depth is at z = 3
    options.inside = [](const openvdb::Vec3d& x) {
        EXPECT_NEAR(x[2], 6.0, 1e-6);
        return x.length() < 9.0 ? Color{10, 200, 10} : Color{200, 200, 10};
    };
    const Picture picture = drawn("flat");
    EXPECT_EQ(pixel(picture, 110, 97), (Color{10, 200, 10})); // the blue ball is away
    EXPECT_EQ(pixel(picture, 104 + 75, 104), (Color{200, 200, 10}));
    EXPECT_EQ(pixel(picture, 104 + 85, 104), red); // the cut has a radius of 8 Å
}

TEST_F(TwoBalls, BordersAreFoundByThePixel)
{
    // By the plane x = 0.35, whatever the vertices have.
    constexpr Color other = {190, 30, 30};
    options.borders = std::make_shared<ColorOwners>(
        colorOwners({{{-5.0f, 0, 0}, 6.0, 0}, {{5.7f, 0, 0}, 6.0, 1}}, {red, other}));
    options.style = findStyle("flat");
    mesh.triangles.resize(mesh.triangles.size() / 2); // the larger ball
    for (const int width : {208, 1194}) { // the border is a tenth into a pixel of the latter
        options.width = width;
        const Picture picture = drawMesh(mesh, options, Progress());
        const double edge = 20.8 / width; // of a pixel [Å]
        int wrong = 0;
        for (int x = width / 10; x < width - width / 10; ++x) {
            const double place = (x + 0.5 - 0.5 * width) * edge;
            if (std::abs(place - 0.35) < 0.51 * edge) continue;
            wrong += pixel(picture, x, width / 2 - width / 50) != (place < 0.35 ? red : other);
        }
        EXPECT_EQ(wrong, 0) << width;
    }
}

// A quick picture sends fewer rays than it has samples.
TEST_F(TwoBalls, QuickPicturesHaveTheSameRims)
{
    options.transparent = true;
    options.frame = PictureFrame{{0.0, 0.0, 3.0}, 270.0, 234.0}; // at smaller pixels all are quick
    options.width = 980;
    const auto areaOf = [&](bool quick) {
        options.quick = quick;
        double sum = 0.0;
        for (const std::uint8_t alpha : drawn("flat").alpha) sum += alpha / 255.0;
        return sum;
    };
    const double dense = areaOf(false);
    EXPECT_GT(dense, 100.0);
    EXPECT_NEAR(areaOf(true), dense, 1e-4 * dense);
}

TEST_F(TwoBalls, LinesGrowWithThePicture)
{
    const auto inkAcross = [&](int width) {
        options.width = width;
        const Picture picture = drawn("flat");
        double ink = 0.0; // along the beginning of the middle row, where the ball has its rim
        for (int x = 0; x < width / 12; ++x)
            ink += pixel(picture, x, picture.height / 2)[0] < 150 ? 1.0 : 0.0;
        return ink;
    };
    EXPECT_NEAR(inkAcross(500), 0.8, 1.0);
    EXPECT_NEAR(inkAcross(1500), 2.4, 1.1);
}

// Under a lid that hides half of the sky everywhere alike there is no pattern.
TEST(DrawMesh, DarknessIsSmooth)
{
    Mesh mesh;
    addBall(mesh, {0.0f, 0.0f, 0.0f}, 4.0f, red);
    addBall(mesh, {7.0f, 0.0f, 0.0f}, 4.0f, red);
    DrawOptions options;
    options.width = 300;
    options.toEye = {0, 0, 1};
    options.up = {0, 1, 0};
    const Picture picture = drawMesh(mesh, options, Progress());
    int roughest = 0;
    for (int y = picture.height / 2 - 30; y < picture.height / 2 + 30; ++y)
        for (int x = 60; x < 120; ++x) {
            const auto at = [&](int i, int j) { return int(pixel(picture, i, j)[0]); };
            roughest = std::max(roughest, std::abs(at(x - 1, y) - 2 * at(x, y) + at(x + 1, y)));
        }
    EXPECT_LE(roughest, 4);
}

// A picture of more than 1000 pixels asks for the light of every fourth one.
TEST_F(TwoBalls, WidePicturesAreLitLikeOthers)
{
    options.frame = PictureFrame{{0.0, 0.0, 3.0}, 104.0, 26.0};
    options.width = 980;
    const Picture all = drawn("soft");
    options.width = 1020;
    const Picture other = drawn("soft");
    int sum = 0, farthest = 0;
    for (int i = 0; i < 900; ++i) { // to the right of the small ball, where its shadow lies
        const auto at = [&](const Picture& picture) {
            return int(pixel(picture, int((0.53 + 0.03 * (i % 30) / 30.0) * picture.width),
                             int((0.3 + 0.4 * (i / 30) / 30.0) * picture.height))[0]);
        };
        sum += std::abs(at(all) - at(other));
        farthest = std::max(farthest, std::abs(at(all) - at(other)));
    }
    EXPECT_LT(sum, 900);
    EXPECT_LT(farthest, 12);
}

TEST(DrawMesh, SameForOneAndTwoThreads)
{
    Mesh mesh;
    addBall(mesh, {0.1f, 0.2f, 0.3f}, 3.0f, blue);
    DrawOptions options;
    options.width = 60;
    const Picture two = drawMesh(mesh, options, Progress());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(drawMesh(mesh, options, Progress()).rgb, two.rgb);
}

TEST(DrawMesh, NothingIsBlank)
{
    DrawOptions options;
    options.width = 20;
    options.background = {1, 2, 3};
    const Picture picture = drawMesh(Mesh(), options, Progress());
    ASSERT_EQ(picture.rgb.size(), 3u * 20 * 20);
    EXPECT_EQ(pixel(picture, 7, 7), options.background);
}

} // namespace
} // namespace molsurf
