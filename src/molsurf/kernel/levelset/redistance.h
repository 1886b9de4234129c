// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The signed distance to the zero set of a level set, deep into the molecule, by closest points.

#include "molsurf/kernel/grid/distance_band.h"
#include "molsurf/kernel/levelset/nearest_seeds.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Computes the signed distance to the zero set of the cubic B-spline through phi.
///
/// 1. For every voxel next to the interface, for the inner ones alone if the level is more than two
///    voxels inside, the closest point y on the spline's zero set is found
///    by Newton's method (Chopp, Some improvements of the fast marching method, SIAM J. Sci.
///    Comput. 23(1):230-244, 2001), with the normal n and the shape operator A there.
/// 2. Every voxel takes the nearest of these points.
/// 3. For voxels x within two voxels of `level` the point is moved along the spline by one more
///    Newton step.
/// 4. The distance follows from the second-order expansion of the distance function about the
///    normal through y: with s = n.(x - y) and t = x - y - s n,
///    phi = s + (t.A t + s K t.t) / (2 (1 + s kappa + s^2 K)),
///    kappa = tr A, K = det A on the tangent plane.
///
/// @param[in] phi    near its zero set a smooth signed distance [Å], active in a band of at least
///                   three voxels on each side of it; its values are freed when they have been read
/// @param[in] band   how deep and how high the result reaches
/// @param[in] level  the level set of the result that is wanted, which gets the best distances [Å]
/// @param[in] box    a box of whole leaves, outside of which no result is wanted
DistanceBand redistance(SparseField phi, const BandWidths& band, double level,
                        const Progress& progress,
                        const openvdb::CoordBBox& box = openvdb::CoordBBox::inf());

/// Steps 3 and 4 of redistance(), for callers that use the points of step 2 themselves.
/// @param[in] near   by nearestSeeds() with the same band and level
/// @param[in] kinks  of the distance, by kinksOf()
DistanceBand distancesBy(NearestSeeds near, LeafTable kinks, const BandWidths& band, double level,
                         const Progress& progress);

} // namespace molsurf
