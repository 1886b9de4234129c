// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which thin walls and necks of an offset surface are closed. The topology of what lies deeper
/// than an offset inside psi = 0 changes where a point is amid its closest points of psi = 0: two
/// in the middle of a wall, three in that of a neck. Where its depth is near the offset, a grid and
/// its place would decide; here it is decided by the depth, and the level set is changed there such
/// that voxels hold what was decided. docs/math.md, section 7.

#include "molsurf/grid/distance_band.h"
#include "molsurf/levelset/gaps.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// The middle of a wall or neck.
struct Wall {
    openvdb::Vec3d place; ///< [voxel]
    double depth;         ///< its distance to psi = 0 [Å]
};

/// A thin wall is open if its middle lies less than this inside the surface [Å].
constexpr double thinnestWall = 0.06;

/// How many voxels from a voxel, beside ridgeReach(), the walls may lie that its value depends on,
/// with what tells them: a wall is held by what is left of others that were opened.
int wallReach(double voxelSize);

/// Finds two or three sheets of the interface that may bound a thin wall or neck, from the feet of
/// some voxels. Feet nearer to each other than half the depth are of one sheet, which their mean
/// represents. The centre of the smallest sphere through the sheets has to be within 1.2 voxels,
/// and its radius between the depth less 0.75 and plus 1.7 voxels. Lengths are in voxels.
/// @param[in] feet     closest points of the interface to these voxels
/// @param[in] middle   of the voxels
/// @param[in] depth    the offset
/// @param[in,out] out  a place is added for each set of sheets
void findThinPlaces(const std::vector<openvdb::Vec3d>& feet, const openvdb::Vec3d& middle,
                    double depth, std::vector<ThinPlace>& out);

/// Finds the walls and necks that thin places lead to and that are near the decision, each once, in
/// ascending order of places.
/// @param[in] psi     that of the interface, with all that was added to it
/// @param[in] offset  depth of the surface inside psi = 0 [Å]
std::vector<Wall> findWalls(const PsiJetAt& psi, const std::vector<ThinPlace>& places,
                            double offset, double voxelSize, const Progress& progress);

/// Opens the film about the middle of each open wall, before ridges are rounded, as far as it would
/// depend on the voxel how much of it stays: S gets a bump of a height and a radius in Å.
/// @param[in]     offset  as for findWalls()
/// @param[in,out] S       the level set of the surface [Å]
void openWalls(const std::vector<Wall>& walls, double offset, SparseField& S);

/// Decides walls when ridges are rounded: S gets a bump at each, with which its middle lies clearly
/// inside or outside.
/// @param[in]     offset  as for findWalls()
/// @param[in,out] S       the level set of the surface [Å]
GapReport decideWalls(const std::vector<Wall>& walls, double offset, SparseField& S);

} // namespace molsurf
