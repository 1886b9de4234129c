// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/part_ranges.h"

#include <algorithm>
#include <cstddef>

namespace molsurf
{

std::vector<PartRange> partRanges(const Mesh& mesh, const std::string& name)
{
    if (mesh.parts.empty()) return {{name, 0, mesh.positions.size(), 0, mesh.triangles.size()}};
    std::vector<PartRange> ranges;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        PartRange range{mesh.parts[p].name, mesh.positions.size(), 0, mesh.parts[p].firstTriangle,
                        p + 1 < mesh.parts.size() ? mesh.parts[p + 1].firstTriangle
                                                  : mesh.triangles.size()};
        for (std::size_t t = range.firstTriangle; t < range.triangleEnd; ++t) {
            for (const std::uint32_t corner : mesh.triangles[t]) {
                range.firstVertex = std::min<std::size_t>(range.firstVertex, corner);
                range.vertexEnd = std::max<std::size_t>(range.vertexEnd, corner + 1ull);
            }
        }
        if (range.firstTriangle < range.triangleEnd) ranges.push_back(range);
    }
    return ranges;
}

void appendPart(const Mesh& mesh, const PartRange& range, Mesh& out)
{
    const std::size_t begin = out.positions.size();
    const auto add = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to.insert(to.end(), from.begin() + std::ptrdiff_t(range.firstVertex),
                  from.begin() + std::ptrdiff_t(range.vertexEnd));
    };
    add(mesh.positions, out.positions);
    add(mesh.normals, out.normals);
    add(mesh.colors, out.colors);
    for (std::size_t i = 0; i < out.scalars.size(); ++i)
        add(mesh.scalars[i].values, out.scalars[i].values);
    for (std::size_t i = 0; i < out.labels.size(); ++i)
        add(mesh.labels[i].values, out.labels[i].values);
    out.parts.push_back({range.name, out.triangles.size()});
    for (std::size_t t = range.firstTriangle; t < range.triangleEnd; ++t) {
        auto& corners = out.triangles.emplace_back(mesh.triangles[t]);
        for (std::uint32_t& corner : corners)
            corner = std::uint32_t(corner - range.firstVertex + begin);
    }
}

std::vector<VertexField> vertexFields(const Mesh& mesh)
{
    const auto& all = mesh.scalars;
    std::vector<VertexField> out;
    for (std::size_t s = 0; s < all.size(); s += out.back().count) {
        const std::string& first = all[s].name;
        const std::string stem =
            first.substr(0, first.size() - std::min<std::size_t>(first.size(), 2));
        bool isVector = s + 3 <= all.size();
        for (std::size_t axis = 0; axis < 3 && isVector; ++axis)
            isVector = all[s + axis].name == stem + "_" + "xyz"[axis];
        out.push_back({isVector ? stem : first, &all[s], isVector ? std::size_t(3) : 1});
    }
    return out;
}

} // namespace molsurf
