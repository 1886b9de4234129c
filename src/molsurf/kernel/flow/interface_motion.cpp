// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/interface_motion.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// The values of a leaf before and after, with room to read beyond the last row.
struct LeafChange {
    alignas(64) float before[leafSize + leafDim], after[leafSize + leafDim];
};

/// How far the crossings of the eight edges moved that begin in a row [voxel]; -1 where there is
/// none. A crossing that was on no edge before has come as far as the end changed that it passed.
MOLSURF_KERNEL void waysInRow(const LeafChange& __restrict leaf, int first, int stride,
                              float inverse, float* __restrict way)
{
    const float* p = leaf.before + first;
    const float* q = leaf.after + first;
    for (int z = 0; z < leafDim; ++z) {
        const float a = p[z], b = p[z + stride], c = q[z], d = q[z + stride];
        const bool was = (a < 0.0f) != (b < 0.0f), is = (c < 0.0f) != (d < 0.0f);
        const float before = a / (was ? a - b : 1.0f), after = c / (is ? c - d : 1.0f);
        const float moved = std::abs((after - before) * (c - d));
        const float one = (a < 0.0f) != (c < 0.0f) ? std::abs(c - a) : 0.0f;
        const float other = (b < 0.0f) != (d < 0.0f) ? std::abs(d - b) : 0.0f;
        const float along = inverse * (was ? moved : larger(one, other));
        way[z] = is ? along : -1.0f;
    }
}

} // namespace

InterfaceWatch InterfaceMotion::watch()
{
    return [this](std::size_t n, const float* before, const float* after, const LeafMask& near) {
        LeafChange leaf;
        std::copy_n(before, leafSize, leaf.before);
        std::copy_n(after, leafSize, leaf.after);
        // The last row reads values beyond the leaf; no result comes of them.
        std::fill_n(leaf.before + leafSize, leafDim, 1.0f);
        std::fill_n(leaf.after + leafSize, leafDim, 1.0f);
        const bool counts = region_.owned.isInside(table_.origin(n));
        Displacements& part = parts_.local();
        float largest = 0.0f;
        for (int row = 0; row < 64; ++row) {
            if (near.row(row) == 0) continue;
            for (const int stride : {64, 8, 1}) {
                // Edges that end in another leaf are left out.
                if ((stride == 64 && row >= 56) || (stride == 8 && row % 8 == 7)) continue;
                alignas(32) float way[leafDim];
                waysInRow(leaf, 8 * row, stride, inverse_, way);
                for (int z = 0; z < (stride == 1 ? leafDim - 1 : leafDim); ++z) {
                    if (way[z] < 0.0f) continue;
                    largest = larger(largest, way[z]);
                    if (counts) part.add(way[z]);
                }
            }
        }
        largest_[n] = largest;
    };
}

Displacements InterfaceMotion::sum() const
{
    Displacements all;
    for (const Displacements& part : parts_) all += part;
    return all;
}

} // namespace molsurf
