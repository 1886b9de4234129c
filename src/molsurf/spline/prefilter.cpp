// SPDX-License-Identifier: MPL-2.0
#include "molsurf/spline/spline.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"

#include <algorithm>
#include <utility>

namespace molsurf
{

namespace
{

constexpr int window = 3 * leafDim; // a leaf and the two beside it, along an axis

/// 64 lines through a leaf and its two neighbours along an axis.
struct Lines {
    alignas(64) float value[window][64];
    alignas(64) float solve[window][64]; // 1 where a voxel and both beside it are active, else 0
};

/// Solves (solve/6, 1 - solve/3, solve/6) c = value on all lines by Thomas' algorithm; c replaces
/// value.
MOLSURF_KERNEL void solveLines(Lines& lines)
{
    alignas(64) float upper[window][64]; // of the eliminated rows
    for (int k = 0; k < 64; ++k) upper[0][k] = 0.0f;
    for (int i = 1; i < window; ++i) {
        const float* __restrict s = lines.solve[i];
        const float* __restrict before = upper[i - 1];
        const float* __restrict last = lines.value[i - 1];
        float* __restrict value = lines.value[i];
        float* __restrict out = upper[i];
        for (int k = 0; k < 64; ++k) {
            const float off = s[k] * (1.0f / 6.0f);
            const float pivot = 1.0f / (1.0f - 2.0f * off - off * before[k]);
            out[k] = off * pivot;
            value[k] = (value[k] - off * last[k]) * pivot;
        }
    }
    for (int i = window - 2; i >= 0; --i) {
        const float* __restrict u = upper[i];
        const float* __restrict next = lines.value[i + 1];
        float* __restrict value = lines.value[i];
        for (int k = 0; k < 64; ++k) value[k] -= u[k] * next[k];
    }
}

/// Index in a leaf of voxel i along an axis on line k.
int voxelOf(int axis, int i, int k)
{
    switch (axis) {
    case 0:
        return 64 * i + k;
    case 1:
        return 64 * (k >> 3) + 8 * i + (k & 7);
    default:
        return 8 * k + i;
    }
}

/// Bit k: whether voxel i along an axis on line k is on.
std::uint64_t lineBits(const LeafMask& mask, int axis, int i)
{
    if (axis == 0) return mask.words[i];
    std::uint64_t bits = 0;
    for (int x = 0; x < 8; ++x) {
        const std::uint64_t word = mask.words[x];
        // For z, bit i of each byte is folded into one byte (y).
        const std::uint64_t byte =
            axis == 1 ? word >> (8 * i) & 0xff
                      : (word >> i & 0x0101010101010101ull) * 0x0102040810204080ull >> 56;
        bits |= byte << (8 * x);
    }
    return bits;
}

MOLSURF_KERNEL void expand(std::uint64_t bits, float* __restrict out)
{
    for (int byte = 0; byte < 8; ++byte) {
        const int b = int(bits >> (8 * byte) & 0xff);
        for (int k = 0; k < 8; ++k) out[8 * byte + k] = float(b >> k & 1);
    }
}

/// @param[in] field  values on the leaves of the table
void gatherLines(const LeafTable& table, const LeafField& field, std::size_t n, int axis,
                 Lines& lines)
{
    const int step = axis == 0 ? 9 : axis == 1 ? 3 : 1;
    std::uint64_t on[window] = {};
    for (int side = 0; side < 3; ++side) {
        const std::int32_t m = table.neighbours(n)[centreNeighbour + (side - 1) * step];
        for (int i = 0; i < leafDim; ++i) {
            float* row = lines.value[leafDim * side + i];
            if (m == noLeaf) {
                std::fill_n(row, 64, 0.0f);
                continue;
            }
            on[leafDim * side + i] = lineBits(table.active(m), axis, i);
            const float* leaf = field.leaf(m);
            if (axis < 2) {
                for (int x = 0; x < 8; ++x) {
                    std::copy_n(leaf + (axis == 0 ? 64 * i + 8 * x : 64 * x + 8 * i), 8,
                                row + 8 * x);
                }
            } else {
                for (int k = 0; k < 64; ++k) row[k] = leaf[8 * k + i];
            }
        }
    }
    std::fill_n(lines.solve[0], 64, 0.0f);
    std::fill_n(lines.solve[window - 1], 64, 0.0f);
    for (int i = 1; i + 1 < window; ++i) expand(on[i - 1] & on[i] & on[i + 1], lines.solve[i]);
}

} // namespace

SparseField prefilter(const SparseField& field, const Progress& progress)
{
    const LeafTable& table = field.table;
    LeafField from(table.size()), to(table.size());
    for (int axis = 0; axis < 3; ++axis) {
        // to <- from filtered along the axis
        const LeafField& source = axis == 0 ? field.values : from;
        parallelFor(table.size(), progress, [&](std::size_t n) {
            Lines lines;
            gatherLines(table, source, n, axis, lines);
            solveLines(lines);
            float* out = to.leaf(n);
            for (int i = 0; i < leafDim; ++i) {
                for (int k = 0; k < 64; ++k) out[voxelOf(axis, i, k)] = lines.value[leafDim + i][k];
            }
        });
        std::swap(from, to);
    }
    return {table, std::move(from), field.voxelSize};
}

} // namespace molsurf
