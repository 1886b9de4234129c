// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The exact signed distance to the boundary of a union of balls: van der Waals and
/// solvent-accessible surface, and by an inward offset the solvent-excluded one.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/grid/distance_band.h"

namespace molsurf
{

/// A union of the balls of radius r_i + probe.
struct BallUnion {
    const std::vector<Ball>& balls;
    double probe;          ///< that the radii are grown by [Å]
    BallBoundary boundary; ///< of the union
};

/// Makes the boundary of a union of balls.
/// @param[in] balls  have to outlive the union
/// @param[in] probe  [Å], >= 0
BallUnion unionOf(const std::vector<Ball>& balls, double probe, const Progress& progress);

/// Whether DistanceBand::kinks are found; else no voxel has one.
enum class Kinks { Found, None };

/// Computes the signed distance to the boundary of a union of balls, negative inside, at all voxels
/// nearer to it than the given widths; exact but for rounding (float, 1e-6 of the size of a leaf).
///
/// Outside it is min_i (|x - x_i| - R_i). Inside the nearest boundary point is the foot of x on a
/// patch, on an arc, or a corner, whichever is nearest: any of them that is uncovered is a point of
/// the boundary and bounds the distance from above, and the nearest point is among them. Parts are
/// gathered by leaf, and cubes of 4^3 voxels leave out those that are too far for all of them.
///
/// @param[in] set        handed over, since its boundary takes much memory
/// @param[in] voxelSize  edge h of a voxel [Å]
/// @param[in] width      how deep and how high the result reaches
/// @param[in] box        a box of whole leaves: no others are looked at
DistanceBand distanceToUnion(BallUnion set, double voxelSize, const BandWidths& width,
                             const Progress& progress,
                             const openvdb::CoordBBox& box = openvdb::CoordBBox::inf(),
                             Kinks kinks = Kinks::Found);

} // namespace molsurf
