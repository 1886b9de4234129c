// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/round_ridges.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf
{

namespace
{

// How long S moves [Å^2]: three steps at 0.5 Å. measured: bench/specks.py vdb_molsurf
// crease49.xyzr, the largest |H| and the area at 0.125 Å: 2.44/Å, 580.93 Å^2 for this, 2.09, 580.88
// for 0.15 Å^2, 1.96, 580.86 for 0.25 Å^2; 581.85 Å^2 without.
constexpr double ridgeTime = 0.375 * ridgeRadius * ridgeRadius;
constexpr float reach = 2.5f; // of the spline at a point, with what it depends on [voxel]
constexpr float near = 1.5f;  // from S = 0, where its curvature is looked at [voxel]

/// Voxels about a kink or a sharp place that S moves in: a radius, and two where they are coarse.
int aboutOf(double voxelSize)
{
    return std::max(2, int(std::ceil(ridgeRadius / voxelSize)));
}

/// The number of explicit Euler steps; 0 on voxels so coarse that the spline rounds as much.
int stepsFor(double voxelSize)
{
    constexpr double longest = 0.125; // time of a step [voxel^2]
    if (voxelSize > 1.5 * ridgeRadius) return 0;
    return int(std::ceil(ridgeTime / (longest * voxelSize * voxelSize) - 1e-6));
}

/// The mean curvature of the level set at a voxel, and the slope of S there.
struct Bend {
    float H, slope;
};

inline __attribute__((always_inline)) Bend bendAt(const float* p, float inverse)
{
    const Derivatives d = derivatives<1>(p, inverse);
    const float slope2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-6f;
    const float along = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                         2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                        slope2;
    const float slope = std::sqrt(slope2);
    return {0.5f * (d.xx + d.yy + d.zz - along) / slope, slope};
}

/// The mean curvatures between which S is left as it is [1/Å].
struct Limits {
    float concave, convex;
};

Limits limitsOf(double offset)
{
    constexpr float limit = float(0.5 / ridgeRadius);
    return {-std::max(limit, float(1.0 / offset)), limit};
}

/// The voxels of a leaf whose foot on S = 0 is sharper than any atom: |H| / (1 - S H) > sharpest, H
/// being the mean curvature of the level set through the voxel.
MOLSURF_KERNEL void sharpVoxels(const float* __restrict block, float inverse, LeafMask& mask)
{
    constexpr float sharpest = 4.0f; // mean curvature of a ball of 0.25 Å [1/Å]
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    for (int row = 0; row < 64; ++row) {
        const float* p = block + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        int bits = 0;
        for (int z = 0; z < 8; ++z) {
            const float H = bendAt(p + z, inverse).H;
            bits |= int(std::abs(H) > sharpest * larger(1.0f - p[z] * H, 0.0f)) << z;
        }
        mask.words[row >> 3] |= std::uint64_t(bits) << (8 * (row & 7));
    }
}

/// The voxels that move: about kinks and sharp places near the zero set, of those that S has.
LeafTable ridgesOf(const DistanceBand& S, const Progress& progress)
{
    const float h = float(S.phi.voxelSize), outward = reach * h;
    const float inward = std::max(float(ridgeRadius), outward);
    LeafTable ridges = S.kinks;
    parallelFor(ridges.size(), progress, [&](std::size_t n) {
        const LeafMask close = within(S.phi.leaf(n), near * h) & S.phi.table.active(n);
        ridges.active(n) &= within(S.phi.leaf(n), inward + 0.5f * h);
        if (!close.any()) return;
        LeafBlock<float, 1> block;
        block.gather(S.phi.table, S.phi.values, n);
        LeafMask sharp;
        sharpVoxels(block.values, 1.0f / h, sharp);
        ridges.active(n) |= close & sharp;
    });
    ridges = dilated(pruned(ridges), aboutOf(h), Spread::Ball, progress);
    parallelFor(ridges.size(), progress, [&](std::size_t n) {
        const std::int32_t m = S.phi.table.find(ridges.origin(n));
        LeafMask& mask = ridges.active(n);
        if (m == noLeaf) {
            mask = LeafMask();
            return;
        }
        const float* values = S.phi.leaf(std::size_t(m));
        mask &= S.phi.table.active(m) & lessThan(values, outward) & ~lessThan(values, -inward);
    });
    return pruned(ridges);
}

/// One step: S moves where it bends more than a ridge may.
/// @param[in] block   S in a leaf and about it
/// @param[in] moving  the voxels that may move
MOLSURF_KERNEL void moveRidges(const float* __restrict block, const LeafMask& moving, Limits limits,
                               float inverse, float time, float* __restrict out)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    const float sharpest = 2.0f * inverse;
    for (int row = 0; row < 64; ++row) {
        const int bits = moving.row(row);
        const float* p = block + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) out[8 * row + z] = p[z];
            continue;
        }
        for (int z = 0; z < 8; ++z) {
            const Bend bend = bendAt(p + z, inverse);
            const float H = larger(smaller(bend.H, sharpest), -sharpest);
            const float beyond =
                larger(H - limits.convex, 0.0f) + smaller(H - limits.concave, 0.0f);
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            out[8 * row + z] = p[z] + on * 2.0f * time * beyond * bend.slope;
        }
    }
}

} // namespace

int ridgeReach(double voxelSize)
{
    const int steps = stepsFor(voxelSize);
    if (steps == 0) return 0;
    // What spreads for this time is below the last bit of a float at six deviations.
    const int spread = int(std::ceil(6.0 * std::sqrt(2.0 * ridgeTime) / voxelSize));
    return std::min(steps, spread) + aboutOf(voxelSize) + 1; // a kink depends on the next voxel
}

void roundRidges(DistanceBand& S, double offset, const Progress& progress)
{
    const int steps = stepsFor(S.phi.voxelSize);
    if (steps == 0 || offset <= 0.0) return;
    const Limits limits = limitsOf(offset);
    const float h = float(S.phi.voxelSize), inverse = 1.0f / h, time = float(ridgeTime / steps);
    const LeafTable ridges = ridgesOf(S, progress);
    std::vector<std::size_t> leaf(ridges.size());
    for (std::size_t n = 0; n < ridges.size(); ++n)
        leaf[n] = std::size_t(S.phi.table.find(ridges.origin(n)));
    LeafField next(ridges.size());
    for (int i = 0; i < steps; ++i) {
        parallelFor(ridges.size(), progress, [&](std::size_t n) {
            LeafBlock<float, 1> block;
            block.gather(S.phi.table, S.phi.values, leaf[n]);
            moveRidges(block.values, ridges.active(n), limits, inverse, time, next.leaf(n));
        });
        parallelFor(ridges.size(), progress, [&](std::size_t n) {
            std::copy_n(next.leaf(n), leafSize, S.phi.leaf(leaf[n]));
        });
    }
}

} // namespace molsurf
