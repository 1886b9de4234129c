// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Flood fill on leaf masks.

#include "molsurf/grid/leaf_table.h"

#include <vector>

namespace molsurf
{

/// Finds the voxels that can be reached from seeds by steps to face neighbours within a set of
/// voxels.
///
/// @param[in] allowed  the set, one mask a leaf of the table
/// @param[in] seeds    one mask a leaf; those outside the set count for nothing
/// @return one mask a leaf
std::vector<LeafMask> connectedTo(const LeafTable& table, const std::vector<LeafMask>& allowed,
                                  const std::vector<LeafMask>& seeds);

} // namespace molsurf
