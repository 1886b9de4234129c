// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How deep atoms lie below a solvent-excluded surface.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// The distance of points from the nearest place that a probe reaches from outside: how far away
/// the centre of the nearest such probe is, less its radius. In the balls that is the distance to
/// the solvent-excluded surface without the walls of cavities.
///
/// @param[in] balls   at least one, every one finite
/// @param[in] probe   0: the van der Waals surface [Å]
/// @param[in] points  each in a ball [Å]
/// @return one a point, exact to 1e-5 Å
std::vector<double> depthsOf(const std::vector<Ball>& balls, double probe,
                             const std::vector<openvdb::Vec3d>& points, const Progress& progress);

} // namespace molsurf
