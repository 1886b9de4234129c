// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The signed distance of a surface in a band about it.

#include "molsurf/grid/leaf_table.h"

#include <vector>

namespace molsurf
{

/// A signed distance in a band that need not be symmetric.
struct DistanceBand {
    LeafTable table; ///< active: -inside < phi < outside
    LeafField phi;   ///< [Å]; at inactive voxels -inside or outside
    std::vector<LeafMask>
        kinks; ///< active voxels beside which the gradient turns by more than 20 degrees
};

} // namespace molsurf
