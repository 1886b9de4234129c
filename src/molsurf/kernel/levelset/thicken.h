// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Thickens walls that are thinner than a minimum, for 3D printing.

#include "molsurf/kernel/grid/distance_band.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Thickens what is thinner than a wall, and nothing else: the result is the union of the solid and
/// of balls of that diameter, about every voxel in the middle of a part that is thinner. The middle
/// is where the distance has no slope (less than 0.7 where it is 1 elsewhere), that is, where the
/// nearest points of the surface lie on opposite sides. Necks, threads and sheets come to the
/// thickness of the wall; gaps narrower than what is added to both sides close. No voxel near the
/// balls is left on the surface.
///
/// @param[in,out] S   signed distance, at least wall/2 deep and wall/2 + width high; on return the
///                    active voxels are those with |S| < width
/// @param[in] wall    least thickness [Å], > 0
/// @param[in] width   half width of the band that is left [Å], > 0
void thickenWalls(DistanceBand& S, double wall, double width, const Progress& progress);

} // namespace molsurf
