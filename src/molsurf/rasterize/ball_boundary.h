// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The boundary of a union of balls: patches of spheres, arcs where two spheres meet, vertices
/// where three do (the contact, re-entrant and saddle parts of Connolly, Analytical molecular
/// surface calculation, J. Appl. Cryst. 16:548-558, 1983, are the points at a probe radius from
/// them).

#include "molsurf/core/progress.h"
#include "molsurf/selection/ball.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// A part of a sphere that lies in another ball: the directions u with u.axis > cosine.
struct Cap {
    openvdb::Vec3d axis; ///< unit vector to the other ball
    double cosine;       ///< in (-1, 1)
    std::int32_t other;  ///< index of the other ball
};

/// A sphere with a part that no other ball covers.
struct Patch {
    openvdb::Vec3d centre;
    double radius;
    std::int32_t ball;                      ///< index in the caller's vector
    std::uint32_t capsBegin, capsEnd;       ///< what is covered, none within another
    std::uint32_t arcsBegin, arcsEnd;       ///< with balls of higher index
    std::uint32_t cornersBegin, cornersEnd; ///< with two balls of higher index
};

/// A part of the circle of two spheres that no third ball covers: the points centre + radius u with
/// u a unit vector, u.axis = 0 and the angle between u and middle at most half.
struct Arc {
    openvdb::Vec3d centre;
    double radius;
    openvdb::Vec3d axis;   ///< unit vector from the first ball to the second
    openvdb::Vec3d middle; ///< unit vector to the middle of the arc
    double half;           ///< half its angle, in (0, pi]
    std::int32_t balls[2]; ///< indices in the caller's vector, ascending
    std::int32_t ends[2];  ///< balls that cover the circle before and after it; -1: a whole circle

    /// The direction of an end from the centre: 0 the first, 1 the last about the axis.
    openvdb::Vec3d end(int which) const;
};

/// A point of three spheres that no fourth ball covers.
struct Corner {
    openvdb::Vec3d position;
    std::int32_t balls[3];
};

/// Everything that a point of the boundary can lie on. Lengths in Å.
struct BallBoundary {
    std::vector<Patch> patches; ///< in ascending order of the balls
    std::vector<Cap> caps;
    std::vector<Arc> arcs;
    std::vector<Corner> corners;
};

/// Finds the boundary of the union of the balls of radius r_i + probe. Balls within another one,
/// and all but the first of equal ones, have no part in it. Exact but for rounding; balls that
/// touch in a point, or four spheres through one point, leave at most parts of zero size out.
///
/// @param[in] probe  added to every radius [Å]
BallBoundary ballBoundary(const std::vector<Ball>& balls, double probe, const Progress& progress);

} // namespace molsurf
