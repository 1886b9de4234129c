// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The points of a boundary nearest to the voxels of a leaf, and the kinks of the distance between
/// them.

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_mask.h"
#include "molsurf/kernel/grid/leaf_table.h"
#include "molsurf/kernel/levelset/nearest_part.h"

#include <openvdb/Types.h>

#include <cstdint>

namespace molsurf
{

/// The feet of a VoxelCube in the voxel order of leaves; eight can be read at any place.
struct LeafFeet {
    static constexpr int padded = leafSize + floatLanes;

    float distance[padded];    ///< signed, not cut off [Å]
    std::int32_t part[padded]; ///< -1 where there is none
    float normal[3][padded];   ///< outward unit vectors
    float bend[padded];        ///< the largest curvature of the part [1/Å]

    /// Takes over a cube of the leaf.
    /// @param[in] corner  its first voxel in the leaf
    void set(const VoxelCube& cube, const openvdb::Coord& corner);

    /// Takes over its distances alone, which cutOff() reads.
    void setDistances(const VoxelCube& cube, const openvdb::Coord& corner);

    /// Makes the normals unit vectors, and the padding nothing, when all cubes are set.
    void finish();

    /// The distances cut off, and the voxels within the limits.
    LeafMask cutOff(float inside, float outside, float* phi) const;
};

/// Voxels with a kink between them and the next voxel of the leaf along an axis (isKink()).
struct KinkMasks {
    LeafMask sure;
    LeafMask possible[3]; ///< by axes: where the curvature along the chord decides, or how near
                          ///< voxels of one arc are to its axis
};

/// @param[in] patches  number of them: lower parts are patches, without kinks of their own
KinkMasks findKinks(const LeafFeet& feet, float voxel, std::int32_t patches);

} // namespace molsurf
