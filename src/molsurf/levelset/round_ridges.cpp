// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/round_ridges.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/grid/leaf_block.h"
#include "molsurf/levelset/stencil.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf
{

namespace
{

constexpr float reach = 2.5f; // where S is moved [voxel]
constexpr int about = 2;      // voxels about a kink

int stepsFor(double voxelSize)
{
    constexpr double stepsPerVoxel = 2.0;
    if (voxelSize > 1.5 * ridgeRadius) return 0;
    return int(std::lround(stepsPerVoxel * ridgeRadius / voxelSize + 1.0));
}

/// The voxels near kinks and near the zero set, of those that S has.
LeafTable ridgesOf(const DistanceBand& S, const Progress& progress)
{
    LeafTable ridges = S.kinks;
    const float width = (reach + 0.5f) * float(S.phi.voxelSize);
    for (std::size_t n = 0; n < ridges.size(); ++n)
        ridges.active(n) &= within(S.phi.leaf(n), width);
    ridges = dilated(pruned(ridges), about, Spread::Ball, progress);
    for (std::size_t n = 0; n < ridges.size(); ++n) {
        const std::int32_t m = S.phi.table.find(ridges.origin(n));
        ridges.active(n) = m == noLeaf ? LeafMask() : ridges.active(n) & S.phi.table.active(m);
    }
    return pruned(ridges);
}

/// One step: S moves where it is convex beyond the radius of a ridge.
/// @param[in] block   S in a leaf and about it
/// @param[in] moving  the voxels that may move, where S is not beyond `farthest` [Å]
MOLSURF_KERNEL void moveRidges(const float* __restrict block, const LeafMask& moving, float inverse,
                               float time, float farthest, float* __restrict out)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    constexpr float limit = float(0.5 / ridgeRadius);
    for (int row = 0; row < 64; ++row) {
        const int bits = moving.row(row);
        const float* p = block + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) out[8 * row + z] = p[z];
            continue;
        }
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<1>(p + z, inverse);
            const float slope2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-6f;
            const float along = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                                 2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                                slope2;
            const float slope = std::sqrt(slope2);
            const float H = smaller(0.5f * (d.xx + d.yy + d.zz - along) / slope, 2.0f * inverse);
            const float on = (bits & rowBits[z]) && std::abs(p[z]) <= farthest ? 1.0f : 0.0f;
            out[8 * row + z] = p[z] + on * 2.0f * time * larger(H - limit, 0.0f) * slope;
        }
    }
}

} // namespace

int ridgeReach(double voxelSize)
{
    const int steps = stepsFor(voxelSize);
    return steps > 0 ? steps + about + 1 : 0; // a kink depends on the next voxel
}

void roundRidges(DistanceBand& S, const Progress& progress)
{
    const int steps = stepsFor(S.phi.voxelSize);
    if (steps == 0) return;
    const float h = float(S.phi.voxelSize), inverse = 1.0f / h, time = 0.125f * h * h;
    const LeafTable ridges = ridgesOf(S, progress);
    std::vector<std::size_t> leaf(ridges.size());
    for (std::size_t n = 0; n < ridges.size(); ++n)
        leaf[n] = std::size_t(S.phi.table.find(ridges.origin(n)));
    LeafField next(ridges.size());
    for (int i = 0; i < steps; ++i) {
        parallelFor(ridges.size(), progress, [&](std::size_t n) {
            LeafBlock<float, 1> block;
            block.gather(S.phi.table, S.phi.values, leaf[n]);
            moveRidges(block.values, ridges.active(n), inverse, time, reach * h, next.leaf(n));
        });
        parallelFor(ridges.size(), progress, [&](std::size_t n) {
            std::copy_n(next.leaf(n), leafSize, S.phi.leaf(leaf[n]));
        });
    }
}

} // namespace molsurf
