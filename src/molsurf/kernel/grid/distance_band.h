// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The signed distance of a surface in a band about it.

#include "molsurf/kernel/grid/sparse_field.h"

namespace molsurf
{

/// How far a band reaches on either side of its surface [Å]; both are positive.
struct BandWidths {
    double inside, outside;
};

/// A signed distance in a band that need not be symmetric.
struct DistanceBand {
    SparseField phi; ///< [Å]; active: -inside < phi < outside, elsewhere -inside or outside
    LeafTable kinks; ///< the same leaves; active: active voxels of phi with a kink between them and
                     ///< the next voxel along an axis (docs/math.md, section 7)
};

} // namespace molsurf
