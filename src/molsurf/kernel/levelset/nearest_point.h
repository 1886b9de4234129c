// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The nearest of many points on a surface, for every voxel of a band about it.

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/grid/leaf_table.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// How far from a voxel of its leaf a point may lie; a closest point on an interface that would lie
/// farther from its voxel does not count [voxel].
constexpr float farthestSeed = 1.45f;

/// Points in the leaves of a table, in units of voxels: those of leaf n are [begins[n], begins[n +
/// 1]). A point may lie up to farthestSeed outside its leaf.
struct LeafPoints {
    const LeafTable& table;
    std::vector<std::size_t> begins;
    std::vector<float> x, y, z; ///< from the first voxel of their leaf [voxel]; `padding` more than
                                ///< there are points
    static constexpr std::size_t padding = floatLanes;
};

/// Room for one search, kept from leaf to leaf by a thread.
struct NearestScratch {
    /// Where a leaf may lie that holds the nearest point, nearest first.
    struct Offset {
        double gap; // between its voxels and those of the leaf that is searched for [voxel]
        openvdb::Coord offset;
    };
    std::vector<Offset> offsets;
    double reach = -1.0; // that they are for [voxel]
    std::vector<float> x, y, z;
    std::vector<std::int32_t> index;
    std::vector<float> nearX, nearY, nearZ;
    std::vector<std::int32_t> nearIndex;
};

/// The nearest point of each voxel of a leaf, exactly; of equally near ones any, always the same.
///
/// Cubes of 4^3 voxels share a list of candidates: a point y can be nearer than y0 to a voxel of a
/// box of half edge r about the centre c only if |y - c|^2 <= |y0 - c|^2 + 2 r |y - y0|_1.
///
/// @param[in]  origin  of the leaf, which need not be one of the points' table
/// @param[in]  mask    voxels to look for; others are left alone
/// @param[in]  reach   farthest that a point may be [voxel]
/// @param[out] out     index into positions, or -1 where there is none within reach
void nearestPoints(const LeafPoints& points, const openvdb::Coord& origin, const LeafMask& mask,
                   double reach, NearestScratch& scratch, std::int32_t* out);

} // namespace molsurf
