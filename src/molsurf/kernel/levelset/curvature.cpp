// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/curvature.h"

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <cmath>

namespace molsurf
{

namespace
{

constexpr float tiny = 1e-12f; // keeps divisions finite where the gradient vanishes

/// Normal, slope, mean and Gaussian curvature by central differences at the active voxels of a
/// leaf.
/// @param[in] inverse  1/h
MOLSURF_KERNEL void curvatureRows(const float* __restrict block, const LeafMask& active,
                                  float inverse, float* __restrict nx, float* __restrict ny,
                                  float* __restrict nz, float* __restrict slope,
                                  float* __restrict mean, float* __restrict gauss)
{
    constexpr int X = LeafBlock<float, 1>::strideX, Y = LeafBlock<float, 1>::strideY;
    for (int row = 0; row < 64; ++row) {
        if (active.row(row) == 0) continue;
        const float* p = block + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<1>(p + z, inverse);
            const float norm2 = d.x * d.x + d.y * d.y + d.z * d.z + tiny;
            const float norm = std::sqrt(norm2), scale = 1.0f / norm;
            const float a = d.x * scale, b = d.y * scale, c = d.z * scale;
            // K = n . adj(H) n, and adj(H) = H^2 - (tr H) H + (tr^2 H - tr H^2)/2 (Cayley-Hamilton)
            const float x = d.xx * a + d.xy * b + d.xz * c; // H n
            const float y = d.xy * a + d.yy * b + d.yz * c;
            const float w = d.xz * a + d.yz * b + d.zz * c;
            const float along = a * x + b * y + c * w, trace = d.xx + d.yy + d.zz;
            const float minors =
                d.xx * d.yy + d.yy * d.zz + d.zz * d.xx - (d.xy * d.xy + d.yz * d.yz + d.xz * d.xz);
            const float adjugate = x * x + y * y + w * w - trace * along + minors;
            const int v = 8 * row + z;
            nx[v] = a;
            ny[v] = b;
            nz[v] = c;
            slope[v] = norm;
            mean[v] = (trace - along) * scale;
            gauss[v] = adjugate * scale * scale;
        }
    }
}

} // namespace

void curvature(const LeafBlock<float, 1>& phi, const LeafMask& active, float voxel,
               LeafCurvature& out)
{
    curvatureRows(phi.values, active, 1.0f / voxel, out.normal[0], out.normal[1], out.normal[2],
                  out.slope, out.mean, out.gauss);
}

} // namespace molsurf
