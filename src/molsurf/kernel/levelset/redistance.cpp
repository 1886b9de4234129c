// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/redistance.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/levelset/leaf_distances.h"
#include "molsurf/kernel/levelset/seed_kinks.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace molsurf
{

namespace
{

/// The voxels of a leaf that have a nearest seed; all get the distance that those beyond the band
/// have.
/// @param[in]  own       indices of the nearest seeds
/// @param[in]  negative  the voxels inside
/// @param[out] phi       -inside or outside
MOLSURF_KERNEL void beginLeaf(const std::int32_t* own, const LeafMask& negative, float inside,
                              float outside, float* phi, LeafMask& reached)
{
    const Ints bits = splat(1) << laneNumbers();
    for (int row = 0; row < leafSize / floatLanes; ++row) {
        const Ints in = (bits & negative.row(row)) != 0;
        store(phi + floatLanes * row, in ? splat(-inside) : splat(outside));
        const Ints known = (load(own + floatLanes * row) != splat(noSeed)) & bits;
        reached.words[std::size_t(row >> 3)] |= std::uint64_t(bitsOf(known)) << (8 * (row & 7));
    }
}

/// Replaces the nearest seed of each voxel of a leaf by its signed distance; makes voxels of the
/// band active.
/// @param[in]     negative  the voxels inside
/// @param[in]     level  that gets the best distances [Å]
/// @param[in,out] band   the leaf's active voxels and kinks are set, and its values: bytes of the
///                       seeds' indices before
void takeDistances(LeafDistances leaf, const LeafMask& negative, const BandWidths& width,
                   double level, std::size_t n, DistanceBand& band)
{
    const float h = float(band.phi.voxelSize);
    float* phi = band.phi.leaf(n);
    std::int32_t own[leafSize];
    std::memcpy(own, phi, sizeof own);
    LeafMask reached;
    beginLeaf(own, negative, float(width.inside), float(width.outside), phi, reached);
    std::uint16_t voxels[leafSize];
    const int count = listOf(reached, voxels);
    float distance[leafSize];
    leaf.compute(own, voxels, count, negative, float(level) / h, distance);
    LeafMask active;
    for (int k = 0; k < count; ++k) {
        const int v = voxels[k];
        const float d = std::max(distance[v], 1e-6f) * h;
        if (d >= float(negative.on(v) ? width.inside : width.outside)) continue;
        phi[v] = negative.on(v) ? -d : d;
        active.set(v);
    }
    band.phi.table.active(n) = active;
    band.kinks.active(n) &= active;
}

} // namespace

DistanceBand distancesBy(NearestSeeds near, LeafTable kinks, const BandWidths& width, double level,
                         const Progress& progress)
{
    DistanceBand band;
    band.phi.voxelSize = near.coefficients.voxelSize;
    band.phi.table = near.domain;
    band.kinks = std::move(kinks);
    band.phi.values = std::move(near.index).reused<float>();
    parallelFor(near.domain.size(), progress, [&](std::size_t n) {
        takeDistances(LeafDistances(near, near.domain.origin(n)), near.inside[n], width, level, n,
                      band);
    });
    return band;
}

DistanceBand redistance(SparseField phi, const BandWidths& width, double level,
                        const Progress& progress, const openvdb::CoordBBox& box)
{
    NearestSeeds near = nearestSeeds(std::move(phi), width, level, box, progress);
    SeedKinks kinks = kinksOf(near, progress);
    return distancesBy(std::move(near), std::move(kinks.kinks), width, level, progress);
}

} // namespace molsurf
