// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rounds the ridges of an offset surface, where two sheets of the interface that it is offset from
/// are equally near, and places that bend as much.

#include "molsurf/kernel/grid/distance_band.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The radius that ridges are rounded to [Å].
constexpr double ridgeRadius = 0.5;

/// How many voxels about a voxel its value may depend on after roundRidges().
int ridgeReach(double voxelSize);

/// Moves S by what its mean curvature H exceeds 1/(2 ridgeRadius) by, either way, near S = 0 about
/// kinks and where |H| is larger: for a time that rounds a ridge to about ridgeRadius whatever the
/// voxel is. On voxels above 1.5 ridgeRadius nothing is done, since the spline rounds as much.
///
/// A ridge is a true crease of the offset surface, whose curvature is infinite; without rounding,
/// what a spline makes of it depends on the voxel. H of a surface that lies `offset` inside another
/// is nowhere below -1/offset, and S stays where it is not below that.
/// @param[in] offset  of the surface from the interface [Å]; nothing is done if it is 0
void roundRidges(DistanceBand& S, double offset, const Progress& progress);

} // namespace molsurf
