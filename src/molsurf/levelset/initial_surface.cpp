// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/initial_surface.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/grid/leaf_block.h"
#include "molsurf/levelset/reinitialize.h"
#include "molsurf/levelset/stencil.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

/// phi = distance of the zero of psi + a s + q s^2/2 = 0 along psi's gradient, from its slope a and
/// its second derivative q; -psi/a where that has no zero.
MOLSURF_KERNEL void firstGuess(const float* __restrict block, float voxel, float width,
                               float* __restrict phi)
{
    using Block = LeafBlock<float, 1>;
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
            phi[8 * row + z] = clamped(distance, -width, width);
        }
    }
}

} // namespace

SparseField initialSurface(const SparseField& psi, double width, const Progress& progress)
{
    const double h = psi.voxelSize;
    SparseField phi{psi.table, LeafField(psi.table.size()), h};
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        LeafBlock<float, 1> block;
        block.gather(psi, n);
        firstGuess(block.values, float(h), float(width), phi.leaf(n));
    });
    // Half a voxel an iteration, from the interface to the rim of the band.
    const int iterations = int(std::ceil(2.0 * width / h)) - 1;
    reinitialize(phi, width, iterations, progress);
    return phi;
}

} // namespace molsurf
