// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Points spread evenly over a solvent-excluded surface.

#include "molsurf/kernel/balls/ball_boundary.h"

#include <openvdb/Types.h>

#include <functional>
#include <vector>

namespace molsurf
{

/// A point of a solvent-excluded surface. The probe that touches it has its centre at
/// position + probe normal.
struct ExcludedPoint {
    openvdb::Vec3d position; ///< on the surface [Å]
    openvdb::Vec3d normal;   ///< of the surface, unit, outward
    double area;             ///< that it represents [Å^2]
};

using ExcludedPoints = std::vector<ExcludedPoint>;

/// Spreads points over the faces of a solvent-excluded surface: by golden spirals over contact and
/// concave faces, by rings over toric ones. The areas add up to that of the surface but for what
/// the borders of faces cut of a point's share.
///
/// @param[in] boundary  of the balls of radius r_i + probe
/// @param[in] probe     > 0 [Å]
/// @param[in] density   of the points [1/Å^2]
/// @param[in] counts    whether a face that lies in a ball of a centre and radius may have points
///                      that are wanted; others are left out. Empty: all are wanted.
/// @return in an order that depends on the boundary alone
ExcludedPoints
excludedPoints(const BallBoundary& boundary, double probe, double density, const Progress& progress,
               const std::function<bool(const openvdb::Vec3d&, double)>& counts = {});

} // namespace molsurf
