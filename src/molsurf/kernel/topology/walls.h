// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which thin walls and necks of an offset surface are closed. The topology of what lies deeper
/// than an offset inside psi = 0 changes where a point is amid its closest points of psi = 0: two
/// in the middle of a wall, three in that of a neck. Where its depth is near the offset, the depth
/// decides. docs/math.md, section 7.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/psi_jet.h"
#include "molsurf/kernel/topology/decision.h"
#include "molsurf/kernel/topology/thin_places.h"
#include "molsurf/progress.h"

#include <vector>

namespace molsurf
{

/// A thin wall is open if its middle lies less than this inside the surface [Å].
constexpr double thinnestWall = 0.06;

/// How many voxels from a voxel, beside ridgeReach(), the walls may lie that its value depends on,
/// with what tells them: a wall is held by what is left of others that were opened.
int wallReach(double voxelSize);

/// Decides the walls and necks that thin places lead to and that are near the decision, each once,
/// in ascending order of places.
/// @param[in] psi     that of the interface, with all that was added to it
/// @param[in] offset  depth of the surface inside psi = 0 [Å]
std::vector<Decision> decideWalls(const PsiJetAt& psi, const std::vector<ThinPlace>& places,
                                  double offset, double voxelSize, const Progress& progress);

/// Opens the film about the middle of each open wall, before ridges are rounded, as far as it would
/// depend on the voxel how much of it stays: S gets a bump of a height and a radius in Å.
/// @param[in,out] S  the level set of the surface [Å]
void openWalls(const std::vector<Decision>& walls, SparseField& S);

/// Holds walls when ridges are rounded: S gets a bump at each, with which its middle lies clearly
/// inside or outside.
/// @param[in,out] S  the level set of the surface [Å]
void holdWalls(const std::vector<Decision>& walls, SparseField& S);

} // namespace molsurf
