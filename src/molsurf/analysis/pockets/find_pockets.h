// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the pockets of balls.

#include "molsurf/analysis/pockets/void_field.h"
#include "molsurf/ball.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

using PocketReport = Report::Pockets::Pocket;

/// Pockets with less volume are left out [Å^3], as pyKVFinder does.
constexpr double leastPocket = 5.0;

/// The pockets of balls, and voxels of them.
struct Pockets {
    std::vector<PocketReport> list; ///< the largest first
    openvdb::Int32Grid::Ptr ids;    ///< `pocket_id`: of voxels in pockets their places in the list,
                                    ///< from 1
    openvdb::FloatGrid::Ptr rooms;  ///< `pocket_room` there and about it: distance to the wall or
                                    ///< to the cut, negative outside [Å]
    openvdb::FloatGrid::Ptr depths; ///< `pocket_depth` there: below the surface of the large probe
                                    ///< [Å]
};

/// Finds the space that a small probe reaches and a large one, from outside, does not, deeper than
/// a cut below the surface of that one, and splits it at necks.
/// @param[in] balls  at least one, every one finite
/// @param[in] at     if there are any: only the pocket that most of these places are near to,
///                   within 4 Å, which may be none [Å]
Pockets findPockets(const std::vector<Ball>& balls, const PocketOptions& options, double voxelSize,
                    const std::vector<openvdb::Vec3d>& at, const Progress& progress);

} // namespace molsurf
