// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The cells of the power diagram of balls within their union, in closed form.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The facet between the parts of two balls, in the plane of equal power distance.
struct PowerFacet {
    std::int32_t balls[2]; ///< indices in the caller's vector, ascending
    double area;           ///< [Å^2], > 0
    double distance;       ///< of the two centres [Å]
};

/// The parts of balls: the part of one has the points of the union whose power distance |x - c|^2 -
/// r^2 to it is the least (its cell of the power diagram, Aurenhammer, SIAM J. Comput. 16:78-96,
/// 1987, cut off at the ball). The parts fill the union without overlap.
struct PowerCells {
    std::vector<double> volumes; ///< one a ball [Å^3]; they add up to that of the union
    std::vector<double> areas;   ///< of the sphere that no other ball covers [Å^2], one a ball
    std::vector<PowerFacet> facets;
};

/// Shares out a union of balls. Of equal balls the first has the part, balls within another one
/// have none. Exact but for rounding; a volume is a third of the flux of x - c through the sphere's
/// part and the facets.
PowerCells powerCells(const std::vector<Ball>& balls, const Progress& progress);

/// The facets alone, in ascending order of their balls.
std::vector<PowerFacet> powerFacets(const std::vector<Ball>& balls, const Progress& progress);

} // namespace molsurf
