// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_legend.h"

#include "molsurf/show/picture/font.h"
#include "molsurf/show/picture/legend_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace molsurf
{
namespace
{

constexpr Color background = {255, 255, 255};

Picture blank(int width, int height)
{
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgb.assign(3 * std::size_t(width) * std::size_t(height), 255);
    return picture;
}

Picture drawn(const Legend& legend, int width, int height)
{
    const int column = legendWidth({legend}, width);
    EXPECT_LT(column, width / 2);
    return withLegends(blank(width - column, height), {legend}, width, background);
}

std::size_t pixelsOf(const Picture& picture, const Color& color)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        count += std::equal(color.begin(), color.end(), picture.rgb.begin() + std::ptrdiff_t(i));
    return count;
}

TEST(DrawLegend, HasAPatchForEveryName)
{
    Legend legend;
    legend.title = "Chain";
    legend.entries = {{"A", {200, 10, 20}}, {"B-2", {10, 20, 200}}};
    const Picture picture = drawn(legend, 800, 400);
    EXPECT_EQ(picture.width, 800);
    EXPECT_EQ(picture.height, 400);
    for (const LegendEntry& entry : legend.entries)
        EXPECT_GT(pixelsOf(picture, entry.color), 100u) << entry.name;
}

TEST(DrawLegend, TellsHowManyNamesHaveNoRoom)
{
    Legend legend;
    legend.title = "Chain";
    for (int i = 0; i < 180; ++i)
        legend.entries.push_back({"A-" + std::to_string(i), {std::uint8_t(i), 7, 9}});
    const Picture picture = drawn(legend, 800, 400);
    EXPECT_EQ(picture.height, 400);
    std::size_t shown = 0;
    for (const LegendEntry& entry : legend.entries) shown += pixelsOf(picture, entry.color) > 0;
    EXPECT_GT(shown, 10u);
    EXPECT_LT(shown, 40u);
}

// The line that counts the rest may be wider than title and names.
TEST(DrawLegend, HasAMarginOnTheRight)
{
    Legend legend;
    legend.title = "C";
    for (int i = 0; i < 180000; ++i) legend.entries.push_back({"A", {200, 7, 9}});
    const Picture picture = drawn(legend, 800, 400);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = picture.width - 3; x < picture.width; ++x) {
            const std::uint8_t* p = &picture.rgb[3 * std::size_t(y * picture.width + x)];
            ASSERT_TRUE(std::equal(p, p + 3, background.begin())) << x << " " << y;
        }
    }
}

// The longest row of ink is the bar.
TEST(ScaleBar, IsAsLongAsItSays)
{
    const struct {
        double pixel; // [Å]
        int length;   // of the bar [pixel]
    } cases[] = {{0.1, 200}, {0.24, 208}, {0.25, 200}, {1.0, 200}, {3.0, 167}, {0.011, 182}};
    for (const auto& c : cases) {
        Picture picture;
        picture.width = 1000;
        picture.height = 50;
        picture.pixel = c.pixel;
        picture.rgb.assign(3 * 1000 * 50, 200);
        const Picture out = withScaleBar(picture, 1000, background);
        EXPECT_EQ(out.width, 1000);
        ASSERT_GT(out.height, 60);
        EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), out.rgb.begin()));
        int longest = 0;
        for (int y = 50; y < out.height; ++y) {
            for (int x = 0, run = 0; x < 1000; ++x) {
                const bool ink = out.rgb[3 * std::size_t(y * 1000 + x)] < 60;
                run = ink ? run + 1 : 0;
                longest = std::max(longest, run);
            }
        }
        EXPECT_EQ(longest, c.length) << c.pixel;
    }
}

/// From the first column from x on that is darker than paper to the last [pixel].
int inkFrom(const Picture& picture, int x, int top)
{
    int first = picture.width, last = 0;
    for (int y = top; y < picture.height; ++y)
        for (int at = x; at < picture.width; ++at)
            if (picture.rgb[3 * std::size_t(y * picture.width + at)] < 250) {
                first = std::min(first, at);
                last = std::max(last, at);
            }
    return last - first;
}

// From 100 Å on its length is in nm.
TEST(ScaleBar, SaysItsLengthInItsUnit)
{
    for (const auto& [pixel, text] :
         {std::pair(0.25, "50 \xC3\x85"), {0.5, "10 nm"}, {1.0, "20 nm"}}) {
        Picture picture = blank(1000, 50), written = blank(1000, 50);
        picture.pixel = pixel;
        const Font font(letterHeight(1000));
        font.draw(text, 100, 40, Color{30, 33, 38}, written);
        const int end = 200 + letterHeight(1000) / 2 + 1; // of the bar
        EXPECT_EQ(inkFrom(withScaleBar(picture, 1000, background), end, 50), inkFrom(written, 0, 0))
            << text;
    }
}

TEST(DrawLegend, TakesAnyName)
{
    Legend legend;
    legend.title = "Group";
    legend.entries = {{"", {1, 2, 3}},
                      {std::string(1000, 'W'), {4, 5, 6}},
                      {"\xC3\xA9\xC3\x85\xCE\xB1", {7, 8, 9}}, // é Å α
                      {"\xFF\xC3", {10, 11, 12}}};             // no UTF-8
    const Picture picture = drawn(legend, 1200, 600);
    for (const LegendEntry& entry : legend.entries) EXPECT_GT(pixelsOf(picture, entry.color), 100u);
}

TEST(DrawLegend, BarRunsFromHighToLow)
{
    Legend legend;
    legend.title = "Mean curvature";
    legend.unit = "1/\xC3\x85";
    legend.scale = scaleOf("RdBu", -0.123, 0.123);
    const Picture picture = drawn(legend, 800, 500);
    const auto row = [&](const Color& color) {
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const std::uint8_t* p = &picture.rgb[3 * std::size_t(y * picture.width + x)];
                int far = 0;
                for (std::size_t c = 0; c < 3; ++c) far = std::max(far, std::abs(p[c] - color[c]));
                if (far <= 4) return y;
            }
        }
        return -1;
    };
    const int top = row(legend.scale->stops.back()), bottom = row(legend.scale->stops.front());
    EXPECT_GE(top, 0);
    EXPECT_GT(bottom, top + 100);
}

// Lines of 20 units, with a baseline 16 below their top, and one between two legends.
TEST(LegendSvg, LegendsLieBelowEachOther)
{
    const Legend names{"Chain", "chain", "", "", {}, {{"A", {1, 2, 3}}, {"B & C", {4, 5, 6}}}};
    Legend scale{"Charge", "charge", "", "e", {}, {{"no value", {7, 8, 9}}}};
    scale.scale = ColorScale{"own", -1.0, 1.0, {{0, 0, 0}, {100, 0, 0}, {200, 0, 0}}, true};
    const std::string text = legendSvg({names, scale}, {255, 255, 255});
    const auto has = [&](const std::string& part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(has("<text x=\"0\" y=\"16\">Chain</text>")) << text;
    EXPECT_TRUE(has("<text x=\"24\" y=\"36\">A</text>"));
    EXPECT_TRUE(has("<text x=\"24\" y=\"56\">B &amp; C</text>"));
    EXPECT_TRUE(has("<text x=\"0\" y=\"96\">Charge</text>")); // a line is left out
    EXPECT_TRUE(has("<text x=\"0\" y=\"116\">[e]</text>"));
    EXPECT_TRUE(has("<rect x=\"0\" y=\"130\" width=\"16\" height=\"180\""));
    EXPECT_TRUE(has("<text x=\"24\" y=\"346\">no value</text>"));
    // In steps each colour begins and ends at a stop.
    EXPECT_TRUE(has("<stop offset=\"0.5\" stop-color=\"#000000\"/>"
                    "<stop offset=\"0.5\" stop-color=\"#640000\"/>"));
    scale.scale->steps = false;
    EXPECT_EQ(legendSvg({scale}, {0, 0, 0}).find("<stop offset=\"0.5\" stop-color=\"#000000\"/>"),
              std::string::npos);
}

} // namespace
} // namespace molsurf
