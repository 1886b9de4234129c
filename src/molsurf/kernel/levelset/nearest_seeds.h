// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// For every voxel of a band about an interface the closest of its seeds.

#include "molsurf/kernel/grid/distance_band.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/seeds.h"
#include "molsurf/progress.h"

#include <vector>

namespace molsurf
{

using SeedIndex = LeafArray<std::int32_t>;
using SeedBlock = LeafBlock<std::int32_t, 1>;

/// The seeds of an interface, and which is nearest to each voxel of a band about it.
struct NearestSeeds {
    SparseField coefficients; ///< of the spline through the level set
    PagedArray<Seed> seeds;
    LeafTable domain;             ///< active: the voxels that may lie in the band
    SeedIndex index;              ///< the number of the seed of each voxel of the domain, or noSeed
    std::vector<LeafMask> inside; ///< the voxels inside the interface, a mask a leaf of the domain

    const Seed& operator[](std::int32_t seed) const { return seeds[std::size_t(seed)]; }

    /// From the first voxel of a leaf to that of the leaf that a seed belongs to [voxel].
    /// @param[in] origin  of the former
    openvdb::Vec3f shift(const Seed& seed, const openvdb::Coord& origin) const
    {
        return openvdb::Vec3f((coefficients.table.origin(seed.leaf) - origin).asVec3s());
    }

    /// From a seed to a voxel of a leaf [voxel].
    openvdb::Vec3f offset(const Seed& seed, const openvdb::Coord& origin, int v) const
    {
        return placeOf(v) - seed.y - shift(seed, origin);
    }
};

/// Finds the seeds of phi = 0 and the nearest of each voxel.
/// @param[in] phi    as for redistance(); its values are freed when they have been read
/// @param[in] width  how deep and how high the band reaches
/// @param[in] level  of the band that is wanted [Å]: if it is more than two voxels inside, the
///                   inner voxels alone have seeds
/// @param[in] box    of whole leaves: no others are looked at
/// @return without seeds and leaves if phi has one sign
NearestSeeds nearestSeeds(SparseField phi, const BandWidths& width, double level,
                          const openvdb::CoordBBox& box, const Progress& progress);

} // namespace molsurf
