// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where an offset surface may have a thin wall or neck: voxels amid two or three sheets of the
/// interface that it is offset from. Lengths in voxels.

#include "molsurf/kernel/levelset/nearest_seeds.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// Where what lies deeper than a level may be a thin wall or neck, by the seeds of voxels.
struct ThinPlace {
    std::vector<openvdb::Vec3d> sheets; ///< closest points on the two or three sheets of the
                                        ///< interface that it lies between
    std::vector<openvdb::Vec3d> near;   ///< on all sheets about it, half a voxel apart
};

/// The smallest sphere through two or three points.
struct Rim {
    openvdb::Vec3d centre;
    double radius;
    double least; ///< the smallest weight of a point in the centre: negative if it is not amid them
};
Rim rimOf(const std::vector<openvdb::Vec3d>& points);

/// How much deeper than the depth of a surface the middle of a wall lies that voxels or the
/// rounding of ridges may open, and how much less deep that of one that may be closed.
constexpr double deepestWall = 1.2, highestWall = 0.25;

/// How far from the middle of a cell the centre of the smallest sphere through the sheets may lie,
/// of unitAt().
constexpr double farthestRim = 1.2;

/// Unit of lengths near a wall: as voxels come near to the depth, everything would be near.
double unitAt(double depth);

/// Finds two or three sheets of the interface that may bound a thin wall or neck, from the feet of
/// some voxels. Feet nearer to each other than half the depth are of one sheet, which their mean
/// represents. The centre of the smallest sphere through the sheets has to be within 1.2 voxels,
/// and its radius between the depth less 0.75 and plus 1.7 voxels.
/// @param[in] feet     closest points of the interface to these voxels
/// @param[in] middle   of the voxels
/// @param[in] depth    the offset
/// @param[in,out] out  a place is added for each set of sheets
void findThinPlaces(const std::vector<openvdb::Vec3d>& feet, const openvdb::Vec3d& middle,
                    double depth, std::vector<ThinPlace>& out);

/// Finds the thin places of a level, near which normals turn.
/// @param[in] turns  voxels between which they do, a mask a leaf of the domain
/// @param[in] depth  of the level inside the interface
/// @return by leaf
std::vector<ThinPlace> thinPlaces(const NearestSeeds& near, const std::vector<LeafMask>& turns,
                                  double depth, const Progress& progress);

} // namespace molsurf
