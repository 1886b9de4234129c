// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the ball that a point of a surface belongs to.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// For each point the index of the ball whose surface is nearest: the smallest |x - x_i| - r_i; of
/// equals the first.
/// @param[in] points  [Å]; fast if consecutive points are near each other
/// @param[in] reach   no point is farther than this from the surface of its ball [Å]
/// @return -1 for points that are
std::vector<std::int32_t> nearestBalls(const std::vector<Ball>& balls,
                                       const std::vector<openvdb::Vec3f>& points, double reach,
                                       const Progress& progress);

} // namespace molsurf
