// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A leaf and the rim of its 26 neighbours as one small array on the stack: the building block of
/// every hot pass. Gather once, then sweep rows of 8 voxels with plain loops that vectorise.

#include "molsurf/core/leaf_table.h"

#include <algorithm>

namespace molsurf
{

/// The values of a leaf and of the voxels up to Halo steps from it, in (8 + 2 Halo)^3 order with z
/// fastest. Where a neighbour is missing the nearest value of the leaf itself stands.
/// @tparam Halo  width of the rim, 1 to 8
template<typename T, int Halo>
struct LeafBlock {
    static constexpr int dim = leafDim + 2 * Halo;
    static constexpr int strideX = dim * dim, strideY = dim, strideZ = 1;

    alignas(64) T values[dim * dim * dim];

    /// The value at (x, y, z) relative to the leaf's first voxel, each in [-Halo, 8 + Halo).
    const T* at(int x, int y, int z) const
    {
        return values + ((x + Halo) * dim + (y + Halo)) * dim + (z + Halo);
    }
    T* at(int x, int y, int z)
    {
        return values + ((x + Halo) * dim + (y + Halo)) * dim + (z + Halo);
    }

    void gather(const LeafTable& table, const LeafArray<T>& field, std::size_t n)
    {
        const auto& near = table.neighbours(n);
        for (int x = -Halo; x < leafDim + Halo; ++x) {
            const int dx = x < 0 ? 0 : x < leafDim ? 1 : 2;
            for (int y = -Halo; y < leafDim + Halo; ++y) {
                const int dy = y < 0 ? 0 : y < leafDim ? 1 : 2;
                const int row = 64 * (x & 7) + 8 * (y & 7);
                const int inside =
                    64 * std::clamp(x, 0, leafDim - 1) + 8 * std::clamp(y, 0, leafDim - 1);
                const auto source = [&](int dz) {
                    const std::int32_t m = near[9 * dx + 3 * dy + dz];
                    return m == noLeaf ? nullptr : field.leaf(m) + row;
                };
                const T* own = field.leaf(n) + inside;
                const T *below = source(0), *centre = source(1), *above = source(2);
                if (!centre) centre = own;
                T* out = at(x, y, -Halo);
                for (int z = 0; z < Halo; ++z) {
                    out[z] = below ? below[leafDim - Halo + z] : centre[0];
                    out[Halo + leafDim + z] = above ? above[z] : centre[leafDim - 1];
                }
                for (int z = 0; z < leafDim; ++z) out[Halo + z] = centre[z];
            }
        }
    }
};

} // namespace molsurf
