// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/curvature_colors.h"

#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/palette.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace molsurf
{

const char* curvatureNameOf(ColorBy by)
{
    const ColorKind& kind = kindOf(by);
    return kind.ofCurvature ? kind.attribute : nullptr;
}

ColorScale curvatureScale(const std::vector<float>& curvature, const Coloring& options)
{
    constexpr double least = 1e-6; // of a plane
    const std::string palette = options.palette.empty() ? "RdBu" : options.palette;
    if (options.range) return scaleOf(palette, (*options.range)[0], (*options.range)[1]);
    if (curvature.empty()) return scaleOf(palette, -least, least);
    std::vector<float> sizes;
    sizes.reserve(curvature.size());
    for (const float c : curvature) sizes.push_back(std::abs(c));
    const std::size_t place = sizes.size() * 95 / 100;
    std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(place), sizes.end());
    const double high = std::max(double(sizes[place]), least);
    return scaleOf(palette, -high, high);
}

void colorByCurvature(ColorBy by, const Coloring& options, Mesh& mesh)
{
    const char* name = curvatureNameOf(by);
    if (!name) return;
    for (const auto& scalar : mesh.scalars) {
        if (scalar.name != name) continue;
        const ColorScale scale = curvatureScale(scalar.values, options);
        mesh.colors.clear();
        for (const float c : scalar.values) mesh.colors.push_back(scale.at(c));
    }
}

openvdb::GridPtrVec curvatureColors(ColorBy by, const Coloring& options, const Mesh& mesh,
                                    const openvdb::GridPtrVec& fields)
{
    const std::string name = curvatureNameOf(by);
    openvdb::GridPtrVec colors;
    const auto scalar = std::find_if(mesh.scalars.begin(), mesh.scalars.end(),
                                     [&](const auto& s) { return s.name == name; });
    if (scalar == mesh.scalars.end()) return colors;
    const ColorScale scale = curvatureScale(scalar->values, options);
    for (const auto& field : fields) {
        const std::string whole = field->getName();
        const auto values = openvdb::gridPtrCast<openvdb::FloatGrid>(field);
        if (whole.rfind(name, 0) != 0 || !values) continue;
        auto grid = gridLike<openvdb::Vec3SGrid>(*values, "Cd" + whole.substr(name.size()),
                                                 linearLight(neutralColor));
        auto to = grid->beginValueOn();
        for (auto from = values->cbeginValueOn(); from; ++from, ++to)
            to.setValue(linearLight(scale.at(*from)));
        describeColors(*grid);
        colors.push_back(grid);
    }
    return colors;
}

} // namespace molsurf
