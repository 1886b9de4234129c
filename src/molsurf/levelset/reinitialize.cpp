// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/reinitialize.h"

#include "molsurf/core/leaf_block.h"
#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/levelset/stencil.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

using Block = LeafBlock<float, 2>;
constexpr int X = Block::strideX, Y = Block::strideY;

/// Time step in units of h: the scheme is stable up to 1/sqrt(3).
constexpr float timeStep = 0.5f;

/// The one of two numbers of one sign that is nearer to 0; else 0.
inline __attribute__((always_inline)) float minmod(float a, float b)
{
    return larger(smaller(a, b), 0.0f) + smaller(larger(a, b), 0.0f);
}

/// The square of the upwind derivative along one axis, times h^2.
/// @param[in] sign  +1 outside, -1 inside
inline __attribute__((always_inline)) float upwind(const float* p, int stride, float sign)
{
    const float below = p[0] - p[-stride], above = p[stride] - p[0];
    const float centre = above - below;
    const float before = below - (p[-stride] - p[-2 * stride]);
    const float after = (p[2 * stride] - p[stride]) - above;
    const float minus = below + 0.5f * minmod(centre, before);
    const float plus = above - 0.5f * minmod(centre, after);
    const float slope = larger(larger(sign * minus, -sign * plus), 0.0f);
    return slope * slope;
}

/// One Euler step where a mask is on; elsewhere the field, limited to the band.
MOLSURF_KERNEL void eulerStep(const float* __restrict block, const LeafMask& moving, float voxel,
                              float width, float* __restrict out)
{
    const float inverse2 = 1.0f / (voxel * voxel);
    for (int row = 0; row < 64; ++row) {
        const int bits = moving.row(row);
        const float* p = block + (row / 8 + 2) * X + (row % 8 + 2) * Y + 2;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) out[8 * row + z] = clamped(p[z], -width, width);
            continue;
        }
        for (int z = 0; z < 8; ++z) {
            const float value = p[z], sign = std::copysign(1.0f, value);
            const float slope2 = inverse2 * (upwind(p + z, X, sign) + upwind(p + z, Y, sign) +
                                             upwind(p + z, 1, sign));
            const float next = sign * value - timeStep * voxel * (std::sqrt(slope2) - 1.0f);
            const float stepped = sign * clamped(next, 1e-6f * voxel, width);
            out[8 * row + z] = bits & rowBits[z] ? stepped : clamped(value, -width, width);
        }
    }
}

/// The voxels of a mask that have a face neighbour of the other sign; 0 counts as outside.
MOLSURF_KERNEL void nextToInterface(const float* __restrict block, const LeafMask& among,
                                    LeafMask& mask)
{
    for (int row = 0; row < 64; ++row) {
        const int candidates = among.row(row);
        if (candidates == 0) continue;
        const float* p = block + (row / 8 + 2) * X + (row % 8 + 2) * Y + 2;
        int bits = 0;
        for (int z = 0; z < 8; ++z) {
            const float* q = p + z;
            const float x = smaller(q[X], q[-X]), y = smaller(q[Y], q[-Y]),
                        w = smaller(q[1], q[-1]);
            const float u = larger(q[X], q[-X]), v = larger(q[Y], q[-Y]), t = larger(q[1], q[-1]);
            const float low = smaller(smaller(x, y), w), high = larger(larger(u, v), t);
            const float crossing = q[0] < 0.0f ? -high - 1e-30f : low;
            bits |= int(crossing < 0.0f) << z;
        }
        mask.words[row >> 3] |= std::uint64_t(bits & candidates) << (8 * (row & 7));
    }
}

/// Changes of an interface voxel below this many voxels are the stencil's own error rather than the
/// field's. They are suppressed: made at every step they would add up to a drift of the interface.
constexpr float stencilError = 0.02f;

/// Signed distance of the zero of the second-order Taylor polynomial along the gradient, where a
/// mask is on; the value itself where the polynomial has no zero nearby (in crevices that the grid
/// does not resolve).
MOLSURF_KERNEL void taylorDistance(const float* __restrict block, const LeafMask& mask,
                                   float inverse, float* __restrict out)
{
    const float noise = stencilError / inverse;
    for (int row = 0; row < 64; ++row) {
        const int bits = mask.row(row);
        if (bits == 0) continue;
        const float* p = block + (row / 8 + 2) * X + (row % 8 + 2) * Y + 2;
        alignas(32) float distance[8];
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<2>(p + z, inverse);
            const float value = p[z];
            const float norm2 = larger(d.x * d.x + d.y * d.y + d.z * d.z, 1e-6f);
            const float second = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                                  2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                                 norm2;
            // |phi| = a s - second s^2 / 2 for the step s toward the zero
            const float discriminant = norm2 - 2.0f * second * value;
            const float root = std::sqrt(larger(discriminant, 0.0f));
            const float change = 2.0f * value / (std::sqrt(norm2) + root) - value;
            const float damped = change * change * change / (change * change + noise * noise);
            const float first = norm2 >= 0.25f ? 1.0f : 0.0f;
            const float zero = discriminant >= 0.25f * norm2 ? first : 0.0f;
            distance[z] = value + zero * damped; // a factor, since a branch does not vectorise
        }
        for (int z = 0; z < 8; ++z)
            out[8 * row + z] = bits & rowBits[z] ? distance[z] : out[8 * row + z];
    }
}

} // namespace

void reinitialize(const LeafTable& table, LeafField& phi, double voxel, double width,
                  int iterations, LeafField& scratch, const Progress& progress)
{
    const float h = float(voxel), w = float(width);
    std::vector<LeafMask> interface(table.size());
    if (scratch.leafCount() != table.size()) scratch = LeafField(table.size());
    for (int i = 0; i < iterations; ++i) {
        // scratch <- phi after one step; interface voxels keep the value that step 0 has given them
        parallelFor(table.size(), progress, [&](std::size_t n) {
            Block block;
            block.gather(table, phi, n);
            scratch.prefetchAfter(n);
            LeafMask& fixed = interface[n];
            if (i == 0) nextToInterface(block.values, table.active(n), fixed);
            eulerStep(block.values, table.active(n) & ~fixed, h, w, scratch.leaf(n));
            if (i == 0) taylorDistance(block.values, fixed, 1.0f / h, scratch.leaf(n));
        });
        std::swap(phi, scratch);
    }
}

} // namespace molsurf
