// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/refine.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/kernel/levelset/reinitialize.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/kernel/spline/fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;

SparseField refined(const SparseField& phi, const openvdb::CoordBBox& box, const Progress& progress)
{
    constexpr float trusted = 2.55f; // [coarse voxel]: beyond, the spline feels the band's rim
    constexpr int iterations = 2;
    const double h = 0.5 * phi.voxelSize;
    const float width = float(bandWidthVox * h), limit = trusted * float(phi.voxelSize);
    const Spline spline = fitSpline(phi, 0, progress);

    std::vector<Coord> origins;
    for (std::size_t n = 0; n < phi.table.size(); ++n) {
        if (!phi.table.active(n).any()) continue;
        for (int k = 0; k < 8; ++k) {
            const Coord origin =
                (phi.table.origin(n) + phi.table.origin(n))
                    .offsetBy(leafDim * (k >> 2), leafDim * (k >> 1 & 1), leafDim * (k & 1));
            if (box.isInside(origin)) origins.push_back(origin);
        }
    }
    SparseField fine{LeafTable(std::move(origins)), {}, h};
    fine.values = LeafField(fine.table.size());
    parallelFor(fine.table.size(), progress, [&](std::size_t n) {
        SplineSampler sampler(spline);
        const Coord origin = fine.table.origin(n);
        const auto m = std::size_t(phi.table.find(origin >> 1));
        for (int v = 0; v < leafSize; ++v) {
            const Coord x = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
            const int w = int(openvdb::FloatTree::LeafNodeType::coordToOffset(x >> 1));
            const float near = phi.leaf(m)[w];
            float& value = fine.leaf(n)[v];
            value = std::copysign(width, near);
            if (!phi.table.active(m).on(w) || std::abs(near) > limit) continue;
            value = std::clamp(float(sampler.at(x.asVec3d() * h).value), -width, width);
            if (std::abs(value) < width) fine.table.active(n).set(v);
        }
    });
    SparseField band{pruned(fine.table), {}, h};
    band.values = LeafField(band.table.size());
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        const auto m = std::size_t(fine.table.find(band.table.origin(n)));
        std::copy_n(fine.leaf(m), leafSize, band.leaf(n));
    });
    reinitialize(band, width, iterations, progress);
    return band;
}

} // namespace molsurf
