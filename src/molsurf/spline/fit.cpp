// SPDX-License-Identifier: MPL-2.0
#include "molsurf/spline/fit.h"

#include <algorithm>

namespace molsurf
{

using openvdb::Coord;

Spline fitSpline(const LeafTable& table, const LeafField& field, double voxel, int level,
                 const Progress& progress)
{
    Spline spline;
    spline.voxel = voxel * (1 << level);
    if (level == 0) {
        spline.table = table;
        spline.coefficients = prefilter(table, field, progress);
        return spline;
    }
    // The leaves of a block of 2^level leaves become one.
    std::vector<Coord> origins;
    for (const Coord& origin : table.origins())
        origins.push_back((origin >> level) & ~(leafDim - 1));
    std::sort(origins.begin(), origins.end());
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    spline.table = LeafTable(std::move(origins));
    LeafField samples(spline.table.size());
    for (std::size_t n = 0; n < samples.leafCount(); ++n)
        std::fill_n(samples.leaf(n), leafSize, 0.0f);
    const int stride = 1 << level;
    for (std::size_t n = 0; n < table.size(); ++n) {
        const Coord coarse = table.origin(n) >> level;
        const std::int32_t m = spline.table.find(coarse);
        table.active(n).forEach([&](int v) {
            const Coord local(v >> 6, v >> 3 & 7, v & 7);
            if ((local.x() | local.y() | local.z()) & (stride - 1)) return;
            const int w =
                int(openvdb::FloatTree::LeafNodeType::coordToOffset(coarse + (local >> level)));
            samples.leaf(m)[w] = field.leaf(n)[v];
            spline.table.active(m).set(w);
        });
    }
    spline.coefficients = prefilter(spline.table, samples, progress);
    return spline;
}

} // namespace molsurf
