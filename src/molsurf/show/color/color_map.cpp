// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/color_map.h"

#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

openvdb::Vec3f linearLight(const Color& color)
{
    // A table, since pictures and meshes ask for millions of them.
    static const std::array<float, 256> light = [] {
        std::array<float, 256> all;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double s = double(i) / 255.0;
            all[i] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        return all;
    }();
    return {light[color[0]], light[color[1]], light[color[2]]};
}

std::uint8_t fromLinearLight(double light)
{
    const double x = std::clamp(light, 0.0, 1.0);
    const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    return std::uint8_t(std::lround(255.0 * srgb));
}

std::string hexOf(const Color& color)
{
    return formatted("#%02x%02x%02x", color[0], color[1], color[2]);
}

Color ColorScale::at(double value) const
{
    const double range = high - low, last = double(stops.size() - 1);
    double place = range > 0.0 ? (value - low) / range * last : 0.0;
    if (!(place > 0.0)) place = 0.0; // also of what is not a number
    place = std::min(place, last);
    if (steps) return stops[std::size_t(place + 1e-9)]; // a stop has its own, even rounded
    const std::size_t i = std::min(std::size_t(place), stops.size() - 2);
    const double t = place - double(i);
    Color color;
    for (int k = 0; k < 3; ++k)
        color[k] = std::uint8_t(std::lround((1.0 - t) * stops[i][k] + t * stops[i + 1][k]));
    return color;
}

namespace
{

/// From dark to light.
std::vector<Palette> rising()
{
    return {{"viridis",
             {{68, 1, 84},
              {72, 40, 120},
              {62, 74, 137},
              {49, 104, 142},
              {38, 130, 142},
              {31, 158, 137},
              {53, 183, 121},
              {109, 205, 89},
              {180, 222, 44},
              {253, 231, 37}}},
            {"cividis",
             {{0, 34, 78},
              {18, 53, 112},
              {59, 73, 108},
              {87, 93, 109},
              {112, 113, 115},
              {138, 134, 120},
              {165, 156, 116},
              {195, 179, 105},
              {225, 204, 85},
              {254, 232, 56}}},
            {"batlow",
             {{1, 25, 89},
              {16, 63, 96},
              {27, 89, 98},
              {60, 109, 86},
              {104, 123, 62},
              {157, 137, 43},
              {210, 147, 67},
              {248, 162, 126},
              {253, 183, 188},
              {250, 204, 250}}}};
}

/// From light to dark.
Palette falling()
{
    return {"OrRd",
            {{255, 247, 236},
             {254, 232, 200},
             {253, 212, 158},
             {253, 187, 132},
             {252, 141, 89},
             {239, 101, 72},
             {215, 48, 31},
             {179, 0, 0},
             {127, 0, 0}}};
}

/// Through white, and turbo.
std::vector<Palette> others()
{
    return {{"RdBu",
             {{33, 102, 172},
              {67, 147, 195},
              {146, 197, 222},
              {209, 229, 240},
              {247, 247, 247},
              {253, 219, 199},
              {244, 165, 130},
              {214, 96, 77},
              {178, 24, 43}}},
            {"OrPu",
             {{179, 88, 6},
              {224, 130, 20},
              {253, 184, 99},
              {254, 224, 182},
              {247, 247, 247},
              {216, 218, 235},
              {178, 171, 210},
              {128, 115, 172},
              {84, 39, 136}}},
            {"turbo",
             {{48, 18, 59},
              {70, 107, 227},
              {40, 187, 236},
              {49, 242, 153},
              {162, 252, 60},
              {237, 208, 58},
              {251, 128, 34},
              {210, 49, 5},
              {122, 4, 3}}}};
}

} // namespace

const std::vector<Palette>& paletteTable()
{
    static const std::vector<Palette> all = [] {
        std::vector<Palette> rows = rising(), more = others();
        rows.insert(rows.end(), more.begin(), more.end());
        Palette turned = more[0];
        turned.word = "BuRd";
        std::reverse(turned.stops.begin(), turned.stops.end());
        rows.insert(rows.begin() + 4, turned);
        rows.insert(rows.begin() + 3, falling());
        rows.push_back({"plddt", {}, true}); // one stop a unit, from 0 to 100
        for (int i = 0; i <= 100; ++i)
            rows.back().stops.push_back(i >= 90   ? Color{0, 83, 214}
                                        : i >= 70 ? Color{101, 203, 243}
                                        : i >= 50 ? Color{255, 219, 19}
                                                  : Color{255, 125, 69});
        return rows;
    }();
    return all;
}

const Palette* findPalette(const std::string& word)
{
    const std::string wanted = lowered(word);
    for (const Palette& palette : paletteTable())
        if (lowered(palette.word) == wanted) return &palette;
    return nullptr;
}

ColorScale scaleOf(const std::string& palette, double low, double high)
{
    const Palette& row = *findPalette(palette);
    return {row.word, low, high, row.stops, row.steps};
}

} // namespace molsurf
