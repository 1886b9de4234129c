// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/value_colors.h"

#include "molsurf/color/palette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

namespace
{

/// Four steps, with edges a hundredth of the range wide.
ColorScale confidenceScale()
{
    ColorScale out{"pLDDT", 0.0, 100.0, {}};
    for (int i = 0; i <= 100; ++i)
        out.stops.push_back(i >= 90   ? Color{0, 83, 214}
                            : i >= 70 ? Color{101, 203, 243}
                            : i >= 50 ? Color{255, 219, 19}
                                      : Color{255, 125, 69});
    return out;
}

} // namespace

ColorScale scaleOf(const BallValues& values)
{
    ColorScale out;
    switch (values.map) {
    case BallValues::Map::Magnitude:
        out = magnitudeScale(1.0);
        break;
    case BallValues::Map::Signed:
        out = signedScale(1.0);
        break;
    case BallValues::Map::Charge:
        out = signedScale(1.0);
        out.map = "BuRd";
        std::reverse(out.stops.begin(), out.stops.end());
        break;
    case BallValues::Map::Confidence:
        out = confidenceScale();
        break;
    case BallValues::Map::Rainbow:
        out = {"turbo",
               0.0,
               1.0,
               {{48, 18, 59},
                {70, 107, 227},
                {40, 187, 236},
                {49, 242, 153},
                {162, 252, 60},
                {237, 208, 58},
                {251, 128, 34},
                {210, 49, 5},
                {122, 4, 3}}};
        break;
    }
    out.low = values.low;
    out.high = values.high;
    return out;
}

std::vector<Color> valueColors(const BallValues& values)
{
    const ColorScale scale = scaleOf(values);
    std::vector<Color> out;
    out.reserve(values.valueOf.size());
    for (const float v : values.valueOf)
        out.push_back(std::isfinite(v) ? scale.at(double(v)) : neutralColor);
    return out;
}

void addValues(const BallValues& values, const Labels& nearest, Mesh& mesh)
{
    Attribute<float>& out = mesh.scalars.emplace_back();
    out.name = values.name;
    out.values.reserve(nearest.size());
    for (std::size_t v = 0; v < nearest.size(); ++v) {
        const std::int32_t ball = nearest[v];
        float value = std::numeric_limits<float>::quiet_NaN();
        if (values.centre)
            value = float((openvdb::Vec3d(mesh.positions[v]) - *values.centre).length());
        else if (ball >= 0)
            value = values.valueOf[std::size_t(ball)];
        out.values.push_back(value);
    }
    if (!values.centre) return;
    const ColorScale scale = scaleOf(values);
    for (std::size_t v = 0; v < nearest.size(); ++v)
        mesh.colors[v] = scale.at(double(out.values[v]));
}

} // namespace molsurf
