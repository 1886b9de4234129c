// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rounds the ridges of an offset surface, where two sheets of the interface that it is offset from
/// are equally near.

#include "molsurf/grid/distance_band.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The radius that ridges are rounded to [Å].
constexpr double ridgeRadius = 0.5;

/// How many voxels about a voxel its value may depend on after roundRidges().
int ridgeReach(double voxelSize);

/// Moves S by its mean curvature less 1/(2 ridgeRadius), where that is positive, near kinks and
/// near the zero set: as many small steps as round a ridge to about ridgeRadius. On voxels
/// above 1.5 ridgeRadius nothing is done, since the spline rounds as much.
///
/// A ridge is a true crease of the offset surface, whose curvature is infinite; without rounding,
/// what a spline makes of it depends on the voxel.
void roundRidges(DistanceBand& S, const Progress& progress);

} // namespace molsurf
