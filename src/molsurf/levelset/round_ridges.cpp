// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/round_ridges.h"

#include "molsurf/core/parallel.h"
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

/// What a step adds to S at a voxel.
float change(const float* p, float inverse, float time)
{
    constexpr float limit = float(0.5 / ridgeRadius);
    const Derivatives d = derivatives<1>(p, inverse);
    const float slope2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-6f, slope = std::sqrt(slope2);
    const float along = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                         2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                        slope2;
    const float H = std::min(0.5f * (d.xx + d.yy + d.zz - along) / slope, 2.0f * inverse);
    return H > limit ? 2.0f * time * (H - limit) * slope : 0.0f;
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
            float* out = next.leaf(n);
            std::copy_n(S.phi.leaf(leaf[n]), leafSize, out);
            ridges.active(n).forEach([&](int v) {
                const float* p = block.at(v >> 6, v >> 3 & 7, v & 7);
                if (std::abs(*p) <= reach * h) out[v] += change(p, inverse, time);
            });
        });
        parallelFor(ridges.size(), progress, [&](std::size_t n) {
            std::copy_n(next.leaf(n), leafSize, S.phi.leaf(leaf[n]));
        });
    }
}

} // namespace molsurf
