// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/paper_step.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

// Where the speed acts, in voxels: fully up to `inner`, not at all beyond `outer`.
constexpr float inner = 1.5f, outer = 2.25f;

/// Sums of a step over a leaf.
struct LeafSums {
    InterfaceSums interface;
    double speed = 0.0; // sum of |F| within a voxel of the interface [1/Å]
    double count = 0.0; // of these voxels

    LeafSums& operator+=(const LeafSums& o)
    {
        interface += o.interface;
        speed += o.speed;
        count += o.count;
        return *this;
    }
};

/// The speeds of a leaf's voxels, times |grad phi| and the cut-off.
MOLSURF_KERNEL void speedRows(const float* __restrict phiBlock, const float* __restrict psiBlock,
                              const LeafCurvature& __restrict shape, const LeafMask& active,
                              float h, const Weights weights, InterfaceRows& __restrict sums,
                              float* __restrict speed)
{
    using Block = LeafBlock<float, 1>;
    const float inverse = 1.0f / h;
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        const int first = (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        const float *p = phiBlock + first, *q = psiBlock + first;
        for (int z = 0; z < 8; ++z) speed[8 * row + z] = 0.0f;
        if (bits == 0) continue;
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float t =
                clamped((std::abs(p[z]) * inverse - inner) / (outer - inner), 0.0f, 1.0f);
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            const float cutoff = on * (1.0f - t * t * (3.0f - 2.0f * t));
            const Front here = frontAt(q + z, shape, v, 0.0f, inverse, weights);
            speed[v] = cutoff * shape.slope[v] * here.speed;
            const Front foot = frontAt(q + z, shape, v, p[z], inverse, weights);
            addVoxel(foot, shape, row, z, p[z], p[z], h, on, sums);
        }
    }
}

} // namespace

InterfaceSums paperStep(const NarrowBand& band, const Weights& weights, int level, LeafField& next,
                        double& moved, const Progress& progress)
{
    const LeafTable& table = band.phi.table;
    const double h = band.phi.voxelSize;
    const Spline spline = splineOf(band.phi, level, progress);
    const openvdb::Coord first = sumOrigin(table, Region());
    LeafSums sums = parallelSum<LeafSums>(table.size(), progress, [&](std::size_t n) {
        const LeafMask active = table.active(n) & within(band.phi.leaf(n), outer * float(h));
        float* speed = next.leaf(n);
        if (!active.any()) {
            std::fill_n(speed, leafSize, 0.0f);
            return LeafSums();
        }
        LeafBlock<float, 1> phi, psi;
        phi.gather(band.phi, n);
        psi.gather(table, band.psi, n);
        LeafCurvature shape;
        curvature(phi, active, float(h), shape);
        takeCurvature(spline, table.origin(n), h, active, shape);
        InterfaceRows rows;
        speedRows(phi.values, psi.values, shape, active, float(h), weights, rows, speed);
        LeafSums out{rows.total((table.origin(n) - first).asVec3d() * h)};
        out.interface.maxSpeed = 0.0f;
        for (int v = 0; v < leafSize; ++v) {
            out.interface.maxSpeed = std::max(out.interface.maxSpeed, std::abs(speed[v]));
            if (!active.on(v) || std::abs(band.phi.leaf(n)[v]) >= h) continue;
            out.speed += double(std::abs(speed[v]));
            out.count += 1.0;
        }
        return out;
    });
    const double time = std::min(h, h / std::max(double(sums.interface.maxSpeed), 1e-30));
    moved = sums.count > 0.0 ? time * sums.speed / sums.count / h : 0.0;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        for (int v = 0; v < leafSize; ++v)
            next.leaf(n)[v] = band.phi.leaf(n)[v] + float(time) * next.leaf(n)[v];
    });
    return sums.interface;
}

} // namespace molsurf
