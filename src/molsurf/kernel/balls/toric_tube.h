// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a torus that a probe makes as it rolls along an arc, about two balls.

#include "molsurf/kernel/balls/ball_boundary.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

/// The part of a torus along an arc, between angles from the plane of the arc to its second ball.
/// At the angle f its points are centre + (rho - p cos f) e + p sin f axis, e being a direction
/// from the arc's centre to it.
struct Tube {
    double low, high; ///< from the first ball to the second
    double cusp;      ///< angles nearer to 0 are beyond the axis; 0: none are
    double middle;    ///< where the two balls meet

    bool isCut() const { return cusp > 0.0; }
};

/// @param[in] probe  p [Å]
inline Tube tubeOf(const BallBoundary& boundary, const Arc& arc, double probe)
{
    const PlacedBall& first = boundary.balls[std::size_t(arc.balls[0])];
    const PlacedBall& second = boundary.balls[std::size_t(arc.balls[1])];
    const double d = offset(first, second).length(), r = first.radius, R = second.radius;
    const double height = (d * d + (r - R) * (r + R)) / (2.0 * d);
    Tube tube{};
    tube.low = std::atan2(-height, arc.radius);
    tube.high = std::atan2(d - height, arc.radius);
    if (arc.radius < probe && tube.low < 0.0 && tube.high > 0.0)
        tube.cusp = std::acos(arc.radius / probe);
    tube.middle = std::asin(std::clamp((R - r) / d, -1.0, 1.0));
    return tube;
}

/// The area along an arc between two angles [Å^2].
inline double areaOf(const Arc& arc, double probe, double from, double to)
{
    return 2.0 * arc.half * probe *
           (arc.radius * (to - from) - probe * (std::sin(to) - std::sin(from)));
}

} // namespace molsurf
