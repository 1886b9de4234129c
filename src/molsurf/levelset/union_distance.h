// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The exact signed distance to the boundary of a union of balls: van der Waals and
/// solvent-accessible surface, and by an inward offset the solvent-excluded one.

#include "molsurf/balls/ball_boundary.h"
#include "molsurf/grid/distance_band.h"

namespace molsurf
{

/// Computes the signed distance to the boundary of the union of the balls of radius r_i + probe,
/// negative inside, at all voxels nearer to it than the given widths; exact but for rounding
/// (float, 1e-6 of the size of a leaf).
///
/// Outside it is min_i (|x - x_i| - R_i). Inside the nearest boundary point is the foot of x on a
/// patch, on an arc, or a corner, whichever is nearest: any of them that is uncovered is a point of
/// the boundary and bounds the distance from above, and the nearest point is among them. Parts are
/// gathered by leaf, and cubes of 4^3 voxels leave out those that are too far for all of them.
///
/// @param[in] balls     that the boundary was made of
/// @param[in] probe     [Å]
/// @param[in] boundary  handed over, since it takes much memory
/// @param[in] voxel     voxel edge h [Å]
/// @param[in] inside,outside  depth and height of the result [Å]
/// @param[in] box       of whole leaves: no others are looked at
DistanceBand distanceToUnion(const std::vector<Ball>& balls, double probe, BallBoundary boundary,
                             double voxel, double inside, double outside, const Progress& progress,
                             const openvdb::CoordBBox& box = openvdb::CoordBBox::inf());

} // namespace molsurf
