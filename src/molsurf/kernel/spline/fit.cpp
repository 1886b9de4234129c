// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/fit.h"

#include <algorithm>

namespace molsurf
{

using openvdb::Coord;

Spline fitSpline(const SparseField& field, int level, const Progress& progress)
{
    if (level == 0) return {prefilter(field, progress)};
    // The leaves of a block of 2^level leaves become one.
    std::vector<Coord> origins;
    for (const Coord& origin : field.table.origins())
        origins.push_back((origin >> level) & ~(leafDim - 1));
    std::sort(origins.begin(), origins.end());
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    SparseField samples;
    samples.voxelSize = field.voxelSize * (1 << level);
    samples.table = LeafTable(std::move(origins));
    samples.values = LeafField(samples.table.size());
    for (std::size_t n = 0; n < samples.table.size(); ++n)
        std::fill_n(samples.leaf(n), leafSize, 0.0f);
    const int stride = 1 << level;
    for (std::size_t n = 0; n < field.table.size(); ++n) {
        const Coord coarse = field.table.origin(n) >> level;
        const std::int32_t m = samples.table.find(coarse);
        field.table.active(n).forEach([&](int v) {
            const Coord local(v >> 6, v >> 3 & 7, v & 7);
            if ((local.x() | local.y() | local.z()) & (stride - 1)) return; // between samples
            const int w =
                int(openvdb::FloatTree::LeafNodeType::coordToOffset(coarse + (local >> level)));
            samples.leaf(m)[w] = field.leaf(n)[v];
            samples.table.active(m).set(w);
        });
    }
    return {prefilter(samples, progress)};
}

} // namespace molsurf
