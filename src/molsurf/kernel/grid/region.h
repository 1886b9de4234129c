// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of space that a run is restricted to: a brick and the halo about it.

#include <openvdb/Types.h>

namespace molsurf
{

/// Voxels that a run owns, as a box of whole leaves, and how far beyond them it computes. The
/// default owns everything.
struct Region {
    /// The voxels that count: of sums, and of what is kept. Its corners lie on leaves' borders.
    openvdb::CoordBBox owned = openvdb::CoordBBox::inf();
    /// Positions in sums over all regions are taken from this voxel.
    openvdb::Coord anchor;

    bool whole() const { return owned == openvdb::CoordBBox::inf(); }

    /// The owned voxels and those within a number of leaves of them.
    openvdb::CoordBBox grown(int leaves) const
    {
        openvdb::CoordBBox box = owned;
        if (!whole()) box.expand(8 * leaves);
        return box;
    }
};

} // namespace molsurf
