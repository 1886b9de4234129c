// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/smooth_level_function.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

constexpr float unknown = 1e9f;       // v where it is not known
constexpr float nearInterface = 0.7f; // voxels no farther from the interface have v [voxel]

/// The weight of the distance against psi, a smoothstep of |level|: 1 where the interface has left
/// the valley of the metric, as it does where it spans a gap. Levels of psi mean nothing there.
/// @param[in] level  of psi on the interface, above that at the bottom of the valley
MOLSURF_INLINE float leaving(float level)
{
    constexpr float begin = 0.5f, end = 1.2f;
    const float t = clamped((std::abs(level) - begin) / (end - begin), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// The second-order Taylor polynomial of psi, from each voxel of a mask to its foot on the
/// interface. `out` keeps its value where the slope of phi is below leastSlope, so that there is
/// no normal.
void levelsAtFeet(const LeafBlock<float, 1>& phi, const LeafBlock<float, 1>& psi,
                  const LeafMask& mask, float voxel, float* out)
{
    constexpr float leastSlope = 0.3f;
    const float inverse = 1.0f / voxel;
    mask.forEach([&](int v) {
        const float* p = psi.at(v >> 6, v >> 3 & 7, v & 7);
        const float* f = phi.at(v >> 6, v >> 3 & 7, v & 7);
        float nx = f[phi.strideX] - f[-phi.strideX], ny = f[phi.strideY] - f[-phi.strideY],
              nz = f[1] - f[-1];
        const float slope = std::sqrt(nx * nx + ny * ny + nz * nz);
        if (slope * 0.5f * inverse < leastSlope) return;
        nx /= slope;
        ny /= slope;
        nz /= slope;
        const Derivatives d = derivatives<1>(p, inverse);
        const float along = d.x * nx + d.y * ny + d.z * nz;
        const float bend = nx * nx * d.xx + ny * ny * d.yy + nz * nz * d.zz +
                           2.0f * (nx * ny * d.xy + ny * nz * d.yz + nx * nz * d.xz);
        const float distance = distanceOf(*f, 0.5f * slope * inverse);
        out[v] = *p - distance * along + 0.5f * distance * distance * bend;
    });
}

using MeanBlock = LeafBlock<float, 3>;
constexpr int blockSize = MeanBlock::dim * MeanBlock::dim * MeanBlock::dim;

/// Binomial filter: sums with the weights (1, 2, 1) along z, then y, then x, not divided by 64.
/// Voxels `rim` or more steps from the ends along x and y get them. The loops run on over the ends
/// of rows of z, whose sums mix two rows and are not used.
MOLSURF_KERNEL void spread(const float* __restrict in, int rim, float* __restrict scratch,
                           float* __restrict out)
{
    constexpr int X = MeanBlock::strideX, Y = MeanBlock::strideY;
    const int low = rim, high = MeanBlock::dim - rim;
    for (int x = low - 1; x <= high; ++x) {
        const int end = std::min(X * x + Y * (high + 1), blockSize - 1);
        for (int i = std::max(X * x + Y * (low - 1), 1); i < end; ++i)
            out[i] = in[i - 1] + 2.0f * in[i] + in[i + 1];
    }
    for (int x = low - 1; x <= high; ++x) {
        for (int i = X * x + Y * low; i < X * x + Y * high; ++i)
            scratch[i] = out[i - Y] + 2.0f * out[i] + out[i + Y];
    }
    for (int x = low; x < high; ++x) {
        for (int i = X * x + Y * low; i < X * x + Y * high; ++i)
            out[i] = scratch[i - X] + 2.0f * scratch[i] + scratch[i + X];
    }
}

/// Splits v into values and weights, both 0 where it is not known.
MOLSURF_KERNEL void split(const float* __restrict v, float* __restrict sum,
                          float* __restrict weight)
{
    for (int i = 0; i < blockSize; ++i) {
        const float on = v[i] < 0.5f * unknown ? 1.0f : 0.0f;
        weight[i] = on;
        sum[i] = on * v[i];
    }
}

/// Inner voxels become the weighted mean of the known ones about them.
/// @param[in,out] weight         1 where a voxel is known, else 0
/// @param[in]     sums, weights  both after spread(): their quotient is the mean
/// @param[in]     keep           1: known voxels stay; 0: they become the mean, too
MOLSURF_KERNEL void takeMeans(float* __restrict sum, float* __restrict weight, int rim,
                              const float* __restrict sums, const float* __restrict weights,
                              float keep)
{
    constexpr int X = MeanBlock::strideX, Y = MeanBlock::strideY;
    for (int x = rim; x < MeanBlock::dim - rim; ++x) {
        for (int i = X * x + Y * rim; i < X * x + Y * (MeanBlock::dim - rim); ++i) {
            const float has = weights[i] > 0.0f ? 1.0f : 0.0f;
            const float mean = sums[i] / larger(weights[i], 1e-6f);
            sum[i] += (1.0f - keep * weight[i]) * has * (mean - sum[i]);
            weight[i] = larger(weight[i], has);
        }
    }
}

/// The carrier (level - psi)/slope in a leaf, blended into the distance by leaving(). Farther
/// than `beside` from the interface it has the sign of the distance d and a size of at
/// least leastShare (|d| - beside).
/// @param[in]     levels, weights  of the leaf's block; the levels count where the weight is not 0
/// @param[in]     limit            largest size of (level - psi)/slope [Å]
/// @param[in]     beside           distance up to which a voxel may change sides [Å]
/// @param[in,out] out              the slope [1/Å]; then the carrier [Å]
MOLSURF_KERNEL void carry(const float* __restrict levels, const float* __restrict weights,
                          const float* __restrict psi, const float* __restrict distance,
                          float lambda, float limit, float beside, float* __restrict out)
{
    constexpr int rim = 3;
    constexpr float leastShare = 0.6f;
    for (int row = 0; row < 64; ++row) {
        const int first =
            (row / 8 + rim) * MeanBlock::strideX + (row % 8 + rim) * MeanBlock::strideY + rim;
        for (int z = 0; z < 8; ++z) {
            const int i = 8 * row + z;
            // Far from the interface no level is known: that of the bottom of the valley serves.
            const float known = weights[first + z] > 0.0f ? 1.0f : 0.0f;
            const float slope = out[i];
            const float bottom = -fastLog(1.0f + lambda * slope * slope);
            const float level = known > 0.0f ? levels[first + z] : bottom;
            const float value = clamped((level - psi[i]) / slope, -limit, limit);
            const float mixed = value + leaving(level - bottom) * (distance[i] - value);
            // psi alone would put zeros away from the interface: beside a front that spans a gap,
            // and in a cavity that was filled.
            const float side = distance[i] < 0.0f ? -1.0f : 1.0f;
            const float depth = side * distance[i] - beside;
            const float bounded = larger(side * mixed, leastShare * depth);
            out[i] = depth > 0.0f ? side * bounded : mixed;
        }
    }
}

} // namespace

SparseField smoothCarrier(const SparseField& phi, const CarrierSource& source, double width,
                          const Progress& progress)
{
    const LeafTable& table = phi.table;
    const float voxelSize = float(phi.voxelSize);
    LeafField levels(table.size());
    SparseField out{table, LeafField(table.size()), phi.voxelSize};
    parallelFor(table.size(), progress, [&](std::size_t n) {
        std::fill_n(levels.leaf(n), leafSize, unknown);
        const LeafMask mask = table.active(n) & within(phi.leaf(n), nearInterface * voxelSize);
        if (source.onPsiZero || !mask.any()) return;
        LeafBlock<float, 1> f, p;
        f.gather(table, phi.values, n);
        p.gather(table, source.psi, n);
        levelsAtFeet(f, p, mask, voxelSize, levels.leaf(n));
    });
    const float limit = float(2.0 * width), lambda = float(source.lambda);
    parallelFor(table.size(), progress, [&](std::size_t n) {
        MeanBlock v;
        v.gather(table, levels, n);
        alignas(64) float sum[blockSize], weight[blockSize], sums[blockSize], weights[blockSize],
            scratch[blockSize];
        split(v.values, sum, weight);
        for (int rim = 1; rim <= 3; ++rim) { // two rounds of extension, one of smoothing
            spread(sum, rim, scratch, sums);
            spread(weight, rim, scratch, weights);
            takeMeans(sum, weight, rim, sums, weights, rim == 3 ? 0.0f : 1.0f);
        }
        std::copy_n(source.slope.leaf(n), leafSize, out.leaf(n));
        carry(sum, weight, source.psi.leaf(n), phi.leaf(n), lambda, limit, 1.0f * voxelSize,
              out.leaf(n));
    });
    return out;
}

} // namespace molsurf
