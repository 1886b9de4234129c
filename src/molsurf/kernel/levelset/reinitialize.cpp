// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/reinitialize.h"

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

using WideBlock = LeafBlock<float, 2>;
constexpr int alongX = WideBlock::strideX, alongY = WideBlock::strideY;

/// Time step in units of h: the scheme is stable up to 1/sqrt(3).
constexpr float timeStep = 0.5f;

/// Changes of an interface voxel below this many voxels are the stencil's own error rather than the
/// field's. They are suppressed: made at every step they would add up to a drift of the interface.
constexpr float stencilError = 0.02f;

static_assert(leafDim == floatLanes, "a row is a vector");

/// The one of two numbers of one sign that is nearer to 0; else 0: b between 0 and a.
/// @param[in] zero  a little more than 0, and unknown to the compiler: with constants GCC takes two
///                  instructions for a minimum
MOLSURF_INLINE Floats minmod(Floats a, Floats b, Floats zero)
{
    return clamped(b, smaller(a, -zero), larger(a, zero));
}

/// Adds to a sum the square of the upwind derivative along one axis, times h^2: second-order ENO
/// differences from below and from above, of which Godunov's flux takes the one that comes from
/// the interface.
/// @param[in] sign  +1 outside, -1 inside
MOLSURF_INLINE Floats addUpwind(Floats sum, const float* p, int stride, Floats sign, Floats zero)
{
    const Floats here = load(p), before = load(p - stride), after = load(p + stride);
    const Floats below = here - before, above = after - here, centre = above - below;
    const Floats minus = minmod(centre, below - (before - load(p - 2 * stride)), zero);
    const Floats plus = minmod(centre, (load(p + 2 * stride) - after) - above, zero);
    const Floats fromBelow = sign * (below + 0.5f * minus);
    const Floats fromAbove = sign * (0.5f * plus - above);
    const Floats slope = larger(larger(fromBelow, fromAbove), zero);
    return sum + slope * slope;
}

/// One Euler step where a mask is on; elsewhere the field, limited to the band. A change c becomes
/// c^3/(c^2 + noise^2), and no voxel changes its sign.
/// @param[in] noise  changes below this are suppressed [Å]
MOLSURF_KERNEL void eulerStep(const float* __restrict block, const LeafMask& moving, float voxel,
                              float width, float noise, float* __restrict out)
{
    const float inverse2 = 1.0f / (voxel * voxel);
    const Floats farthest = splat(width), least = splat(1e-6f * voxel);
    const Floats zero = 1e-20f * least, noise2 = splat(noise * noise + 1e-30f);
    Ints bit;
    for (int z = 0; z < leafDim; ++z) bit[z] = rowBits[z];
    for (int row = 0; row < 64; ++row) {
        const int bits = moving.row(row);
        const float* p = block + (row / 8 + 2) * alongX + (row % 8 + 2) * alongY + 2;
        const Floats value = load(p);
        const Floats limited = clamped(value, -farthest, farthest);
        if (bits == 0) {
            store(out + 8 * row, limited);
            continue;
        }
        const Floats sign = value < 0.0f ? splat(-1.0f) : splat(1.0f);
        Floats slope2 = {};
        for (const int stride : {alongX, alongY, 1})
            slope2 = addUpwind(slope2, p, stride, sign, zero);
        const Floats slope = squareRoot(inverse2 * slope2);
        const Floats change = timeStep * voxel * (slope - 1.0f), change2 = change * change;
        const Floats next =
            clamped(sign * value - change * (change2 / (change2 + noise2)), least, farthest);
        store(out + 8 * row, (bit & bits) != 0 ? sign * next : limited);
    }
}

/// The voxels of a mask that have a face neighbour of the other sign; 0 counts as outside.
MOLSURF_KERNEL void nextToInterface(const float* __restrict block, const LeafMask& among,
                                    LeafMask& mask)
{
    Ints bit;
    for (int z = 0; z < leafDim; ++z) bit[z] = rowBits[z];
    for (int half = 0; half < 16; ++half) { // of a plane
        Ints found = {};
        for (int y = 4 * (half & 1); y < 4 * (half & 1) + 4; ++y) {
            const float* p = block + (half / 2 + 2) * alongX + (y + 2) * alongY + 2;
            const Floats here = load(p);
            Floats low = load(p + alongX), high = low;
            for (const int step : {-alongX, alongY, -alongY, 1, -1}) {
                const Floats next = load(p + step);
                low = smaller(next, low);
                high = larger(next, high);
            }
            // Below 0 if a neighbour of the other sign is there; with high = 0, too.
            const Floats crossing = here < 0.0f ? -high - 1e-30f : low;
            found |= crossing < 0.0f ? bit << (8 * (y & 3)) : Ints{};
        }
        mask.words[half / 2] |= std::uint64_t(bitsOf(found)) << (32 * (half & 1));
    }
    mask &= among;
}

/// Signed distance of the zero of the second-order Taylor polynomial along the gradient, where a
/// mask is on; the value itself where the polynomial has no zero nearby (in gaps that the grid
/// does not resolve).
MOLSURF_KERNEL void taylorDistance(const float* __restrict block, const LeafMask& mask,
                                   float inverse, float* __restrict out)
{
    const float noise = stencilError / inverse;
    for (int row = 0; row < 64; ++row) {
        const int bits = mask.row(row);
        if (bits == 0) continue;
        const float* p = block + (row / 8 + 2) * alongX + (row % 8 + 2) * alongY + 2;
        alignas(32) float distance[8];
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<2>(p + z, inverse);
            const float value = p[z];
            const float norm2 = larger(d.x * d.x + d.y * d.y + d.z * d.z, 1e-6f);
            const float second = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                                  2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                                 norm2;
            // With a = |grad phi| the zero is at the root s of phi - a s + second s^2 / 2, taken as
            // 2 phi / (a + sqrt(a^2 - 2 second phi)), which does not cancel.
            const float discriminant = norm2 - 2.0f * second * value;
            const float root = std::sqrt(larger(discriminant, 0.0f));
            const float change = 2.0f * value / (std::sqrt(norm2) + root) - value;
            const float damped = change * change * change / (change * change + noise * noise);
            const float steep = norm2 >= 0.25f ? 1.0f : 0.0f;
            const float hasZero = discriminant >= 0.25f * norm2 ? steep : 0.0f;
            distance[z] = value + hasZero * damped; // a factor: a branch does not vectorise
        }
        for (int z = 0; z < 8; ++z)
            out[8 * row + z] = bits & rowBits[z] ? distance[z] : out[8 * row + z];
    }
}

} // namespace

void reinitialize(SparseField& phi, const Reinitialization& options, const Progress& progress,
                  LeafField& scratch)
{
    const LeafTable& table = phi.table;
    const float h = float(phi.voxelSize), w = float(options.width);
    const float noise = options.repair == Repair::Errors ? stencilError * h : 0.0f;
    std::vector<LeafMask> interface(table.size());
    if (scratch.leafCount() != table.size()) scratch = LeafField(table.size());
    for (int i = 0; i < options.iterations; ++i) {
        // scratch <- phi after one step; interface voxels keep the value that step 0 has given them
        parallelFor(table.size(), progress, [&](std::size_t n) {
            WideBlock block;
            block.gather(phi, n);
            scratch.prefetchAfter(n);
            LeafMask& fixed = interface[n];
            float before[leafSize];
            if (i == 0) nextToInterface(block.values, table.active(n), fixed);
            const bool watched = options.watch && i == 0 && fixed.any();
            if (watched) std::copy_n(scratch.leaf(n), leafSize, before);
            eulerStep(block.values, table.active(n) & ~fixed, h, w, noise, scratch.leaf(n));
            if (i == 0 && fixed.any())
                taylorDistance(block.values, fixed, 1.0f / h, scratch.leaf(n));
            if (watched) options.watch(n, before, scratch.leaf(n), fixed);
        });
        std::swap(phi.values, scratch);
    }
}

void reinitialize(SparseField& phi, double width, int iterations, const Progress& progress)
{
    LeafField scratch;
    reinitialize(phi, {width, iterations}, progress, scratch);
}

} // namespace molsurf
