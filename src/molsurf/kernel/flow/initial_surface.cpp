// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/initial_surface.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/reinitialize.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// The way from psi = 0 to where w' + w kappa = 0, outward, to first order in kappa, if psi is
/// linear: to the bottom of the valley, (1 + q) e^psi = 1, and from there by curvature.
/// @param[in] slope2  |grad psi|^2 [1/Å^2]
MOLSURF_INLINE float wayToRest(float slope2, float kappa, const Weights& weights)
{
    const float q = weights.gradient * slope2;
    return fastLog(1.0f + q) / std::sqrt(slope2) -
           0.5f * kappa * (weights.gradient + weights.area / slope2);
}

/// phi = distance of the zero of psi + a s + q s^2/2 = 0 along psi's gradient, from its slope a and
/// its second derivative q; -psi/a where that has no zero. Less the way from there to rest.
MOLSURF_KERNEL void firstGuess(const float* __restrict block, float voxel, float width,
                               const Weights weights, float* __restrict phi)
{
    using Block = LeafBlock<float, 1>;
    constexpr float farthest = 0.2f; // the way to rest to first order is trusted so far [voxel]
    const float inverse = 1.0f / voxel;
    for (int row = 0; row < 64; ++row) {
        const float* p =
            block + (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<1>(p + z, inverse);
            const float norm2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-12f;
            const float second = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                                  2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                                 norm2;
            const float discriminant = norm2 - 2.0f * second * p[z];
            const float root = std::sqrt(larger(discriminant, 0.25f * norm2));
            const float distance = -2.0f * p[z] / (std::sqrt(norm2) + root);

            // At the foot: grad psi, and the curvature of the level set.
            const float scale = -1.0f / std::sqrt(norm2), t = distance * scale;
            const float x = d.x - t * (d.xx * d.x + d.xy * d.y + d.xz * d.z);
            const float y = d.y - t * (d.xy * d.x + d.yy * d.y + d.yz * d.z);
            const float w = d.z - t * (d.xz * d.x + d.yz * d.y + d.zz * d.z);
            const float k = clamped((d.xx + d.yy + d.zz - second) * scale, -inverse, inverse);
            const float kappa = k / larger(1.0f - 0.5f * k * distance, 0.3f);
            const float way = wayToRest(x * x + y * y + w * w + 1e-6f, kappa, weights);
            const float limit = farthest * voxel;
            phi[8 * row + z] = clamped(distance - clamped(way, -limit, limit), -width, width);
        }
    }
}

} // namespace

SparseField initialSurface(const SparseField& psi, double width, const Weights& weights,
                           const Progress& progress)
{
    const double h = psi.voxelSize;
    SparseField phi{psi.table, LeafField(psi.table.size()), h};
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        LeafBlock<float, 1> block;
        block.gather(psi, n);
        firstGuess(block.values, float(h), float(width), weights, phi.leaf(n));
    });
    // Half a voxel an iteration, from the interface to the rim of the band.
    const int iterations = int(std::ceil(2.0 * width / h)) - 1;
    reinitialize(phi, width, iterations, progress);
    return phi;
}

} // namespace molsurf
