// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A leaf and the rim of its 26 neighbours as one small array on the stack: the building block of
/// every hot pass. Gather once, then sweep rows of 8 voxels with plain loops that vectorise.

#include "molsurf/kernel/grid/sparse_field.h"

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
        prefetchAfter(table, field, n);
        const Source from{table.neighbours(n).data(), field, field.leaf(n)};
        gatherColumn<-1, -1>(from);
        gatherColumn<-1, 0>(from);
        gatherColumn<-1, 1>(from);
        gatherColumn<0, -1>(from);
        gatherColumn<0, 0>(from);
        gatherColumn<0, 1>(from);
        gatherColumn<1, -1>(from);
        gatherColumn<1, 0>(from);
        gatherColumn<1, 1>(from);
    }

    void gather(const SparseField& field, std::size_t n) { gather(field.table, field.values, n); }

private:
    struct Source {
        const std::int32_t* near;
        const LeafArray<T>& field;
        const T* own;
    };

    /// Asks for a leaf that a pass will soon come to, and for what its block needs of those that
    /// come later still, beside it along x and y.
    static inline __attribute__((always_inline)) void
    prefetchAfter(const LeafTable& table, const LeafArray<T>& field, std::size_t n)
    {
        field.prefetchAfter(n);
        if (n + field.ahead >= table.size()) return;
        const auto& near = table.neighbours(n + field.ahead);
        const auto prefetch = [&](int k, int begin, int end, int step) {
            if (near[k] != noLeaf) field.prefetch(std::size_t(near[k]), begin, end, step);
        };
        prefetch(16, 0, leafSize, 64);              // (0, 1, 0): the first row of each x
        prefetch(19, 56, 64 * Halo, 64);            // (1, -1, 0)
        prefetch(22, 0, 64 * Halo, 64 / sizeof(T)); // (1, 0, 0): all rows of the first x
        prefetch(25, 0, 64 * Halo, 64);             // (1, 1, 0)
    }

    /// Copies what is needed of the three leaves above one another at (dx, dy). The loops know
    /// their lengths and which leaves there are: they have no branch.
    template<int dx, int dy>
    void gatherColumn(const Source& from)
    {
        const T* column[3]; // the leaves below, beside and above
        for (int k = 0; k < 3; ++k) {
            const std::int32_t m = from.near[9 * (dx + 1) + 3 * (dy + 1) + k];
            column[k] = m == noLeaf ? nullptr : from.field.leaf(m);
        }
        if (column[0]) {
            column[2] ? copyRows<dx, dy, true, true>(column, from.own)
                      : copyRows<dx, dy, true, false>(column, from.own);
        } else {
            column[2] ? copyRows<dx, dy, false, true>(column, from.own)
                      : copyRows<dx, dy, false, false>(column, from.own);
        }
    }

    /// Copies the rows of a column into the block: `centre`, `under` and `over` are the first row
    /// of 8 voxels and the ends beside it. Without a leaf beside, the leaf's own rim is repeated.
    template<int dx, int dy, bool below, bool above>
    void copyRows(const T* const* column, const T* own)
    {
        constexpr int x0 = begin(dx), y0 = begin(dy), first = 64 * (x0 & 7) + 8 * (y0 & 7);
        const bool beside = column[1] != nullptr;
        const T* centre =
            beside ? column[1] + first
                   : own + 64 * std::clamp(x0, 0, leafDim - 1) + 8 * std::clamp(y0, 0, leafDim - 1);
        const T* under = below ? column[0] + first + leafDim - Halo : centre;
        const T* over = above ? column[2] + first : centre + leafDim - 1;
        const int stepX = beside || dx == 0 ? 64 : 0, stepY = beside || dy == 0 ? 8 : 0;
        for (int x = 0; x < width(dx); ++x) {
            for (int y = 0; y < width(dy); ++y) {
                const int step = 64 * x + 8 * y, ownStep = stepX * x + stepY * y;
                T* out = at(x0 + x, y0 + y, 0);
                std::memcpy(out, centre + ownStep, leafDim * sizeof(T));
                copyEnd<below>(under + (below ? step : ownStep), out - Halo);
                copyEnd<above>(over + (above ? step : ownStep), out + leafDim);
            }
        }
    }

    /// The end of a row: that of the next leaf's, or one value where there is none.
    template<bool known>
    static void copyEnd(const T* in, T* out)
    {
        if (known) {
            std::memcpy(out, in, Halo * sizeof(T));
        } else {
            std::fill_n(out, Halo, T(*in));
        }
    }

    static constexpr int begin(int side) { return side < 0 ? -Halo : side * leafDim; }
    static constexpr int width(int side) { return side == 0 ? leafDim : Halo; }
};

} // namespace molsurf
