// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The parts of the boundary of a union of balls that the voxels of a small cube are nearest to:
/// patches of spheres, arcs of circles, corners. Places are relative to the centre of a leaf [Å].

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace molsurf
{

/// Numbers of a part: corners have the first three, patches the first four.
enum PartNumber {
    PartX, ///< the corner, or the centre of the sphere or circle
    PartY,
    PartZ,
    PartRadius,
    AxisX, ///< of the circle
    AxisY,
    AxisZ,
    MiddleX, ///< unit vector to the middle of the arc
    MiddleY,
    MiddleZ,
    EndCosine, ///< of half the arc's angle; -2 for a whole circle
    partNumbers
};

/// The range of a patch's caps.
struct CapRange {
    std::uint32_t begin, end;
};

/// Parts of one kind, a list for each number. Eight can be read at any place.
struct PartList {
    std::array<std::vector<float>, partNumbers> numbers;
    std::vector<std::int32_t> part; ///< their indices in the boundary
    std::vector<CapRange> caps;     ///< of patches
    int size = 0;

    void clear() { size = 0; }
    /// @param[in] values  the first numbers of the part
    void add(std::initializer_list<float> values, std::int32_t index, CapRange range = {0, 0});
};

/// Caps of spheres, a list for each number. Eight can be read at any place.
struct CapLists {
    std::vector<float> x, y, z, cosine, sine;

    void clear();
    void add(float ax, float ay, float az, float cosineOf, float sineOf);
    void pad();
};

/// The parts of a boundary near a leaf.
struct LeafParts {
    PartList corners, arcs, patches;
};

/// A ball near a leaf.
struct NearBall {
    openvdb::Vec3f centre;
    float radius;
    std::int32_t patch; ///< -1: none of its sphere is uncovered
};

/// A cube of 4^3 voxels, as eight cubes of 2^3 one after the other. The place of a voxel in its
/// list is 8 (4 x' + 2 y' + z') + 4 x + 2 y + z in the small cube (x', y', z').
struct VoxelCube {
    static constexpr int edge = 4, size = 64;

    openvdb::Vec3f first; ///< voxel
    float voxel;          ///< its edge [Å]
    float distance[size]; ///< signed [Å]
    std::int32_t part[size];

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

/// The signed distance of each voxel to the nearest ball, which counts outside of all balls, and
/// the patch of that ball.
void nearestBalls(VoxelCube& cube, const std::vector<NearBall>& balls);

/// Memory of nearestParts(), for cube after cube.
struct CubeParts {
    PartList corners, arcs, patches; ///< that may be nearest to a voxel of the cube
    CapLists caps;                   ///< that may cover something of a patch there
    std::vector<float> keys;
    std::vector<std::int32_t> list;
};

/// Completes what nearestBalls() has found, where a voxel lies inside, or may: the part nearest to
/// it, and its distance below 0. Any corner, and any foot on an arc or an uncovered place of a
/// sphere, is a point of the boundary.
///
/// The parts near the cube's centre bound the distances of its voxels, so most parts of the leaf
/// can be left out; then so do, for the voxels of each small cube, those near its own centre.
///
/// @param[in] caps    of all patches
/// @param[in] inside  no point that is farther than this is looked for [Å]
void nearestParts(VoxelCube& cube, const LeafParts& parts, const CapLists& caps, float inside,
                  CubeParts& scratch);

} // namespace molsurf
