// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The parts of the boundary of a union of balls that the voxels of a small cube are nearest to:
/// patches of spheres, arcs of circles, corners. Places are relative to the centre of a leaf [Å].

#include "molsurf/kernel/balls/ball_boundary.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace molsurf
{

/// What some roundings to floats may change of a cosine, and of a product of three unit vectors.
constexpr float cosineRounding = 16.0f * std::numeric_limits<float>::epsilon();

/// Numbers of a part. Those behind the place bound the region in which it can be the nearest. Let a
/// voxel inside have its nearest point of the boundary where some balls meet: the way from there to
/// it is a sum of the ways to their centres, with weights of 0 or more. So of a corner these voxels
/// lie between three planes, of a patch in a cone about its free part. Those of an arc lie between
/// two cones about its axis and between its ends.
enum PartNumber {
    PartX, ///< the corner, or the centre of the sphere or circle
    PartY,
    PartZ,
    PartRadius,
    AxisX, ///< of the circle, or of the cone about a patch
    AxisY,
    AxisZ,
    MiddleX, ///< unit vector to the middle of the arc
    MiddleY,
    MiddleZ,
    EndCosine, ///< of half the arc's angle
    EndSine,
    FirstCosine, ///< of the angle at the first ball's centre between the axis and the circle
    FirstSine,
    SecondCosine, ///< the same at the second ball
    SecondSine,
    arcNumbers,

    FreeCosine = MiddleX, ///< of half the angle of a patch's cone
    FreeSine,
    patchNumbers,

    NormalX = PartRadius, ///< of the first plane of a corner, inward; two more follow
    cornerNumbers = NormalX + 9,

    ballNumbers = PartRadius + 1
};

/// The range of a patch's caps.
struct CapRange {
    std::uint32_t begin, end;
};

/// Parts of one kind, a list for each number. Eight can be read at any place.
struct PartList {
    std::array<std::vector<float>, arcNumbers> numbers;
    std::vector<std::int32_t> part; ///< their indices in the boundary; of balls, their patches
    std::vector<CapRange> caps;     ///< of patches
    int size = 0;

    void clear() { size = 0; }
    /// Makes room for `more` parts, and eight.
    /// @param[in] count  of the numbers that such a part has
    void makeRoom(int more, int count);
};

/// The parts of a boundary near a leaf, and the balls, with the index of their patch: -1 where
/// none of the sphere is uncovered.
struct LeafParts {
    PartList corners, arcs, patches, balls;
};

/// A cube of 4^3 voxels, as eight cubes of 2^3 one after the other. The place of a voxel in its
/// list is 8 (4 x' + 2 y' + z') + 4 x + 2 y + z in the small cube (x', y', z').
struct VoxelCube {
    static constexpr int edge = 4, size = 64;

    openvdb::Vec3f first; ///< voxel
    float voxel;          ///< its edge [Å]
    float distance[size]; ///< signed [Å]
    std::int32_t part[size];
    float normal[3][size]; ///< of the boundary at the foot, outward; not of unit length
    float bend[size];      ///< the largest curvature of the part there, inward [1/Å]

    /// Where the nearest ball is no farther than this, balls may meet that only by rounding do not
    /// hold the voxel [Å].
    float rounding() const { return 1e-3f * voxel; }
    openvdb::Vec3f centre() const { return first + openvdb::Vec3f(1.5f * voxel); }
    float radius() const { return 1.5f * 1.7320508f * voxel; } ///< of the ball about its voxels
    /// The coordinates of voxel k in the cube.
    static openvdb::Coord coord(int k)
    {
        return {(k >> 5 & 1) * 2 + (k >> 2 & 1), (k >> 4 & 1) * 2 + (k >> 1 & 1),
                (k >> 3 & 1) * 2 + (k & 1)};
    }
};

/// Adds to a list the parts among eight of a table that may be the nearest to a point of a ball.
/// @param[in] place   of the eight parts, x, y and z
/// @param[in] first   the first of the eight in the table, whose own places are not used
/// @param[in] centre  of the ball, from where the list has its places
/// @param[in] inside  parts that are farther than this from all of the ball are left out
struct PartGroup {
    const PartList& table;
    const std::vector<double> (&place)[3];
    std::size_t first;
};
void addCorners(const PartGroup& group, const openvdb::Vec3d& centre, float radius, float inside,
                PartList& out);
void addArcs(const PartGroup& group, const openvdb::Vec3d& centre, float radius, float inside,
             PartList& out);
void addPatches(const PartGroup& group, const openvdb::Vec3d& centre, float radius, float inside,
                PartList& out);
/// The same for balls whose spheres come within `outside` of the box of points within `half` of the
/// centre along the axes.
void addBalls(const PartGroup& group, const openvdb::Vec3d& centre, float half, float outside,
              PartList& out);

/// Memory of nearestParts(), for cube after cube.
struct CubeParts {
    PartList corners, arcs, patches; ///< that may be nearest to a voxel of the cube
    CapLists caps;                   ///< that may cover something of a patch there
    std::vector<float> keys;
    std::vector<std::int32_t> list;
};

/// The signed distance of each voxel to the nearest ball, which counts outside of all balls, the
/// patch of that ball and the normal there. (No curvature: it is 0 or less as seen from outside.)
/// @param[in] outside  balls farther than this from all voxels are left out [Å]
void nearestBalls(VoxelCube& cube, const PartList& balls, float outside, CubeParts& scratch);

/// Completes what nearestBalls() has found, where a voxel lies inside, or may: the part nearest to
/// it, its foot, and its distance below 0. Any corner, and any foot on an arc or an uncovered place
/// of a sphere, is a point of the boundary.
///
/// Where a part can be the nearest, and the parts near the cube's centre, which bound the distances
/// of its voxels, leave few parts of the leaf; the same is done for the voxels of each small cube.
///
/// @param[in] caps    of all patches
/// @param[in] inside  no point that is farther than this is looked for [Å]
void nearestParts(VoxelCube& cube, const LeafParts& parts, const CapLists& caps, float inside,
                  CubeParts& scratch);

} // namespace molsurf
