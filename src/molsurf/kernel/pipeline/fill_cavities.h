// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Closes the cavities of a surface.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/mesh.h"

#include <vector>

namespace molsurf
{

/// Finds the voxels of the cavities of a surface.
/// @param[in] mesh  of S = 0
/// @return one mask a leaf of S; empty if there are none
std::vector<LeafMask> cavityVoxels(const Mesh& mesh, const SparseField& S,
                                   const Progress& progress);

/// Closes the cavities of a surface in the level set that it was offset from, which holds them.
/// @param[in]     cavities  one mask a leaf of S
/// @param[in]     S         leaves of the distance that the cavities were found in
/// @param[in,out] phi       the evolved level set [Å]
void fillInLevelSet(const std::vector<LeafMask>& cavities, const LeafTable& S, SparseField& phi,
                    const Progress& progress);

/// The same in the carrier of an interface, which is no distance.
/// @param[in,out] carrier  as of carryLevels() [Å]
void fillInCarrier(const std::vector<LeafMask>& cavities, const LeafTable& S, SparseField& carrier,
                   const Progress& progress);

/// Closes the cavities of a surface in its own distance, which changes only about them.
/// @param[in] cavities  one mask a leaf of S
void fillInDistance(const std::vector<LeafMask>& cavities, SparseField& S,
                    const Progress& progress);

} // namespace molsurf
