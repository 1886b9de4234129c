// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/value_colors.h"

#include "molsurf/color/palette.h"
#include "molsurf/core/parallel.h"
#include "molsurf/grid/grid_like.h"
#include "molsurf/selection/scalar_map.h"

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

Color colorOf(const ColorScale& scale, float value)
{
    return std::isfinite(value) ? scale.at(double(value)) : neutralColor;
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
    for (const float v : values.valueOf) out.push_back(colorOf(scale, v));
    return out;
}

float valueAt(const BallValues& values, const openvdb::Vec3d& x, const openvdb::Vec3d& normal)
{
    if (values.field) return values.field->at(x + values.outward * normal);
    return float((x - *values.centre).length());
}

openvdb::GridBase::Ptr valueGrid(const openvdb::FloatGrid& surface, const BallValues& values,
                                 const Progress& progress)
{
    auto grid = gridLike<openvdb::Vec3SGrid>(surface, "Cd", linearLight(neutralColor));
    const ColorScale scale = scaleOf(values);
    std::vector<openvdb::Vec3STree::LeafNodeType*> leaves;
    grid->tree().getNodes(leaves);
    const double h = surface.voxelSize()[0];
    parallelFor(leaves.size(), progress, [&](std::size_t n) {
        const auto from = surface.getConstAccessor();
        for (auto voxel = leaves[n]->beginValueOn(); voxel; ++voxel) {
            const openvdb::Coord at = voxel.getCoord();
            openvdb::Vec3d normal(0.0); // by differences of the distance
            for (int a = 0; a < 3; ++a) {
                openvdb::Coord step(0);
                step[a] = 1;
                normal[a] = double(from.getValue(at + step)) - double(from.getValue(at - step));
            }
            if (normal.lengthSqr() > 0.0) normal.normalize();
            // From the voxel to the surface.
            const openvdb::Vec3d x = at.asVec3d() * h - double(from.getValue(at)) * normal;
            voxel.setValue(linearLight(colorOf(scale, valueAt(values, x, normal))));
        }
    });
    return grid;
}

void addValues(const BallValues& values, const Labels& nearest, Mesh& mesh)
{
    Attribute<float>& out = mesh.scalars.emplace_back();
    out.name = values.name;
    out.values.reserve(nearest.size());
    for (std::size_t v = 0; v < nearest.size(); ++v) {
        const std::int32_t ball = nearest[v];
        float value = std::numeric_limits<float>::quiet_NaN();
        if (values.byPoint())
            value =
                valueAt(values, openvdb::Vec3d(mesh.positions[v]), openvdb::Vec3d(mesh.normals[v]));
        else if (ball >= 0)
            value = values.valueOf[std::size_t(ball)];
        out.values.push_back(value);
    }
    if (!values.byPoint()) return;
    const ColorScale scale = scaleOf(values);
    for (std::size_t v = 0; v < nearest.size(); ++v) mesh.colors[v] = colorOf(scale, out.values[v]);
}

} // namespace molsurf
