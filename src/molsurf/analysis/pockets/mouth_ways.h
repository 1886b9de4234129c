// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How large a ball gets out of a pocket.

#include "molsurf/analysis/pockets/basins.h"
#include "molsurf/analysis/pockets/measure_basins.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// The narrowest place of a way.
struct MouthWay {
    double radius = -1.0;      ///< of the largest ball that takes it [Å]; negative: there is none
    openvdb::Vec3d place{0.0}; ///< where that just passes [Å]
    bool isNarrower = false;   ///< whether it is narrower than the place where the way begins
};

/// Finds, of each mouth of each basin, the widest way to it from the widest place of the basin,
/// along the edges of the graph of the void (VoidGraph): voxels only name the basin of a node and
/// the mouth of a place where an edge leaves the basin.
std::vector<std::vector<MouthWay>> mouthWays(const VoidField& space, const RoomBasins& split,
                                             const std::vector<BasinMeasure>& measures);

} // namespace molsurf
