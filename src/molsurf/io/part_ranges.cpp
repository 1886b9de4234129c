// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/part_ranges.h"

#include <algorithm>

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

} // namespace molsurf
