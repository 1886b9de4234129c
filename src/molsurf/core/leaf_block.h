// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A leaf and the rim of its 26 neighbours as one small array on the stack: the building block of
/// every hot pass. Gather once, then sweep rows of 8 voxels with plain loops that vectorise.

#include "molsurf/core/leaf_table.h"

#include <algorithm>
#include <cstring>

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
        const T* own = field.leaf(n);
        for (int side = 0; side < 9; ++side) {
            const int dx = side / 3 - 1, dy = side % 3 - 1;
            const T* column[3]; // the leaves below, beside and above
            for (int k = 0; k < 3; ++k) {
                const std::int32_t m = near[3 * side + k];
                column[k] = m == noLeaf ? nullptr : field.leaf(m);
            }
            for (int x = begin(dx); x < begin(dx) + width(dx); ++x) {
                for (int y = begin(dy); y < begin(dy) + width(dy); ++y) {
                    const int row = 64 * (x & 7) + 8 * (y & 7);
                    const T* centre = column[1] ? column[1] + row
                                                : own + 64 * std::clamp(x, 0, leafDim - 1) +
                                                      8 * std::clamp(y, 0, leafDim - 1);
                    T* out = at(x, y, 0);
                    std::memcpy(out, centre, leafDim * sizeof(T));
                    if (column[0]) {
                        std::memcpy(out - Halo, column[0] + row + leafDim - Halo, Halo * sizeof(T));
                    } else {
                        for (int z = 0; z < Halo; ++z) out[z - Halo] = out[0];
                    }
                    if (column[2]) {
                        std::memcpy(out + leafDim, column[2] + row, Halo * sizeof(T));
                    } else {
                        for (int z = 0; z < Halo; ++z) out[leafDim + z] = out[leafDim - 1];
                    }
                }
            }
        }
    }

private:
    static constexpr int begin(int side) { return side < 0 ? -Halo : side * leafDim; }
    static constexpr int width(int side) { return side == 0 ? leafDim : Halo; }
};

} // namespace molsurf
