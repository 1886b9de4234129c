// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/spline.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"

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
    std::uint64_t solved[window]; // bit k: line k has this voxel and both beside it
};

/// Solves (s/6, 1 - s/3, s/6) c = value by Thomas' algorithm, s being 1 where a line is solved and
/// else 0; in the leaf itself c replaces value.
MOLSURF_KERNEL void solveLines(Lines& lines)
{
    alignas(64) float upper[window][64]; // of the eliminated rows
    for (int k = 0; k < 64; ++k) upper[0][k] = 0.0f;
    const Ints bit = laneBits();
    for (int i = 1; i < window; ++i) {
        if (lines.solved[i] == 0) { // these rows are done: their pivots are 1
            std::fill_n(upper[i], 64, 0.0f);
            continue;
        }
        for (int k = 0; k < 64; k += floatLanes) {
            const Ints isSolved = splat(std::int32_t(lines.solved[i] >> k & 0xff)) & bit;
            const Floats off = isSolved != 0 ? splat(1.0f / 6.0f) : Floats{};
            const Floats pivot = 1.0f / (1.0f - 2.0f * off - off * load(upper[i - 1] + k));
            store(upper[i] + k, off * pivot);
            float* value = lines.value[i] + k;
            store(value, (load(value) - off * load(lines.value[i - 1] + k)) * pivot);
        }
    }
    for (int i = window - 2; i >= leafDim; --i) {
        if (lines.solved[i] == 0) continue;
        const float* __restrict u = upper[i];
        const float* __restrict next = lines.value[i + 1];
        float* __restrict value = lines.value[i];
        for (int k = 0; k < 64; ++k) value[k] -= u[k] * next[k];
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

/// Transposes 8 x 8 floats.
/// @param[in] from, to  steps from row to row
MOLSURF_INLINE void transpose8(const float* in, int from, float* out, int to)
{
    Floats a[8], b[8];
    for (int i = 0; i < 8; ++i) a[i] = load(in + from * i);
    for (int i = 0; i < 8; i += 2) {
        b[i] = __builtin_shufflevector(a[i], a[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        b[i + 1] = __builtin_shufflevector(a[i], a[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += 4) {
        for (int j = i; j < i + 2; ++j) {
            a[j] = __builtin_shufflevector(b[j], b[j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            a[j + 2] = __builtin_shufflevector(b[j], b[j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    }
    for (int i = 0; i < 4; ++i) {
        store(out + to * i, __builtin_shufflevector(a[i], a[i + 4], 0, 1, 2, 3, 8, 9, 10, 11));
        store(out + to * (i + 4),
              __builtin_shufflevector(a[i], a[i + 4], 4, 5, 6, 7, 12, 13, 14, 15));
    }
}

/// The lines of a leaf along z: line 8 x + y, voxel z, at row[z][8 x + y].
MOLSURF_KERNEL void linesAlongZ(const float* __restrict leaf, float (*row)[64])
{
    for (int x = 0; x < 8; ++x) transpose8(leaf + 64 * x, 8, row[0] + 8 * x, 64);
}
MOLSURF_KERNEL void leafOfLinesAlongZ(const float (*row)[64], float* __restrict leaf)
{
    for (int x = 0; x < 8; ++x) transpose8(row[0] + 8 * x, 64, leaf + 64 * x, 8);
}

/// Gathers the 64 lines through leaf n along an axis. A line's number is 8 times the first of the
/// two other coordinates plus the second.
/// @param[in] field  values on the leaves of the table; 0 where there is no leaf
void gatherLines(const LeafTable& table, const LeafField& field, std::size_t n, int axis,
                 Lines& lines)
{
    const int step = axis == 0 ? 9 : axis == 1 ? 3 : 1;
    std::uint64_t on[window] = {};
    for (int side = 0; side < 3; ++side) {
        const std::int32_t m = table.neighbours(n)[centreNeighbour + (side - 1) * step];
        float(*rows)[64] = lines.value + leafDim * side;
        if (m == noLeaf) {
            std::fill_n(rows[0], leafSize, 0.0f);
            continue;
        }
        for (int i = 0; i < leafDim; ++i)
            on[leafDim * side + i] = lineBits(table.active(m), axis, i);
        const float* leaf = field.leaf(m);
        switch (axis) {
        case 0:
            std::copy_n(leaf, leafSize, rows[0]);
            break;
        case 1:
            for (int k = 0; k < 64; ++k)
                std::copy_n(leaf + 8 * k, leafDim, rows[k & 7] + 8 * (k >> 3));
            break;
        default:
            linesAlongZ(leaf, rows);
        }
    }
    for (int i = 0; i < window; ++i) {
        const bool inner = i > 0 && i + 1 < window;
        lines.solved[i] = inner ? on[i - 1] & on[i] & on[i + 1] : 0;
    }
}

/// Writes the middle third of lines to their leaf.
void takeLines(const Lines& lines, int axis, float* leaf)
{
    const float(*rows)[64] = lines.value + leafDim;
    switch (axis) {
    case 0:
        std::copy_n(rows[0], leafSize, leaf);
        break;
    case 1:
        for (int k = 0; k < 64; ++k) std::copy_n(rows[k & 7] + 8 * (k >> 3), leafDim, leaf + 8 * k);
        break;
    default:
        leafOfLinesAlongZ(rows, leaf);
    }
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
            takeLines(lines, axis, to.leaf(n));
        });
        std::swap(from, to);
    }
    return {table, std::move(from), field.voxelSize};
}

} // namespace molsurf
