// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/critical_points.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// Newton steps from the voxels of a leaf to grad psi = 0: the stationary point is x - step.
struct NewtonSteps {
    alignas(64) float step[3][leafSize]; ///< [Å]
    alignas(64) float length[leafSize]; ///< [Å]; `none` where psi is too far; not finite where flat
    alignas(64) float there[leafSize];  ///< psi at the stationary point

    static constexpr float none = 1e30f;
};

/// Newton steps H^-1 grad psi by cofactors of the Hessian H, in central differences; psi at their
/// ends is psi - step.grad psi/2.
/// @param[in] block     psi of a leaf and one voxel about it
/// @param[in] low,high  bounds of psi, at the voxel and at the stationary point
MOLSURF_KERNEL void newtonRows(const float* __restrict block, float inverse, float low, float high,
                               NewtonSteps& __restrict out)
{
    using Block = LeafBlock<float, 1>;
    for (int row = 0; row < 64; ++row) {
        const float* p =
            block + (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const Derivatives d = derivatives<1>(p + z, inverse);
            const float cxx = d.yy * d.zz - d.yz * d.yz, cxy = d.xz * d.yz - d.xy * d.zz;
            const float cxz = d.xy * d.yz - d.xz * d.yy, cyy = d.xx * d.zz - d.xz * d.xz;
            const float cyz = d.xy * d.xz - d.xx * d.yz, czz = d.xx * d.yy - d.xy * d.xy;
            const float det = d.xx * cxx + d.xy * cxy + d.xz * cxz;
            const float scale = 1.0f / det; // not finite where psi is flat: no voxel to start from
            const float sx = scale * (cxx * d.x + cxy * d.y + cxz * d.z);
            const float sy = scale * (cxy * d.x + cyy * d.y + cyz * d.z);
            const float sz = scale * (cxz * d.x + cyz * d.y + czz * d.z);
            const float there = p[z] - 0.5f * (sx * d.x + sy * d.y + sz * d.z);
            const float least = smaller(p[z], there), most = larger(p[z], there);
            const float wrong = larger(low - least, most - high);
            const float length = std::sqrt(sx * sx + sy * sy + sz * sz);
            out.step[0][v] = sx;
            out.step[1][v] = sy;
            out.step[2][v] = sz;
            out.length[v] = wrong > 0.0f ? NewtonSteps::none : length;
            out.there[v] = there;
        }
    }
}

/// A voxel to start from. Those from which Newton's method leads to the same cell lead to the same
/// point.
struct Start {
    Coord cell;
    float length;
    int voxel;
    bool high; // psi is above all that is closed without atoms, here or there

    bool operator<(const Start& o) const
    {
        return std::tie(cell, length, voxel) < std::tie(o.cell, o.length, o.voxel);
    }
};

/// The nearest start of each cell, in the order of cells.
std::vector<Start> startsOf(const SparseField& psi, std::size_t n)
{
    const double h = psi.voxelSize, cell = 0.5 * h;
    // The estimates of psi may err by half of farthestGap.
    constexpr float limit = 1.5f * float(farthestGap);
    constexpr float highest = float(highestUncovered + 0.5 * farthestGap);
    LeafBlock<float, 1> block;
    block.gather(psi, n);
    thread_local NewtonSteps steps;
    newtonRows(block.values, float(1.0 / h), -limit, highest, steps);
    std::vector<Start> starts;
    lessThan(steps.length, float(std::max(1.6 * h, 0.8))).forEach([&](int v) {
        const Vec3d step(steps.step[0][v], steps.step[1][v], steps.step[2][v]);
        const Vec3d stationary = Vec3d(v >> 6, v >> 3 & 7, v & 7) * h - step;
        const bool high = std::max(psi.leaf(n)[v], steps.there[v]) > limit;
        starts.push_back({Coord::floor(stationary / cell), steps.length[v], v, high});
    });
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end(),
                             [](const Start& a, const Start& b) { return a.cell == b.cell; }),
                 starts.end());
    return starts;
}

} // namespace

std::vector<Gap> findCriticalPoints(const SparseField& psi, const PsiJetAt& jet,
                                    const std::function<bool(const Vec3d&, double)>& covered,
                                    const Progress& progress)
{
    const double h = psi.voxelSize, reach = gapReach(h);
    std::vector<std::vector<Gap>> found(psi.table.size());
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        const Coord& origin = psi.table.origin(n);
        for (const Start& start : startsOf(psi, n)) {
            // By the middle of its cell, which is at most 0.44 h from the point, itself an
            // estimate.
            const Vec3d place =
                origin.asVec3d() * h + (start.cell.asVec3d() + Vec3d(0.5)) * 0.5 * h;
            if (start.high && covered(place, 0.7 * h)) continue;
            const int v = start.voxel;
            const Coord voxel = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
            if (const auto gap = gapNear(jet, voxel.asVec3d() * h, reach, highestUncovered))
                found[n].push_back(*gap);
        }
    });
    std::vector<Gap> gaps;
    for (const auto& some : found) gaps.insert(gaps.end(), some.begin(), some.end());
    return distinct(std::move(gaps));
}

} // namespace molsurf
