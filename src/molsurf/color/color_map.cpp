// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/color_map.h"

#include "molsurf/core/words.h"

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
    if (!(place > 0.0)) place = 0.0;
    place = std::min(place, last);
    const std::size_t i = std::min(std::size_t(place), stops.size() - 2);
    const double t = place - double(i);
    Color color;
    for (int k = 0; k < 3; ++k)
        color[k] = std::uint8_t(std::lround((1.0 - t) * stops[i][k] + t * stops[i + 1][k]));
    return color;
}

ColorScale magnitudeScale(double high)
{
    return {"viridis",
            0.0,
            high,
            {{68, 1, 84},
             {72, 40, 120},
             {62, 74, 137},
             {49, 104, 142},
             {38, 130, 142},
             {31, 158, 137},
             {53, 183, 121},
             {109, 205, 89},
             {180, 222, 44},
             {253, 231, 37}}};
}

ColorScale signedScale(double high)
{
    return {"RdBu",
            -high,
            high,
            {{33, 102, 172},
             {67, 147, 195},
             {146, 197, 222},
             {209, 229, 240},
             {247, 247, 247},
             {253, 219, 199},
             {244, 165, 130},
             {214, 96, 77},
             {178, 24, 43}}};
}

} // namespace molsurf
