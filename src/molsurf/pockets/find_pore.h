// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the pore of balls.

#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// Sections of a pore are so far apart [Å].
constexpr double stationSpacing = 0.25;

/// Finds the way through balls that has the largest clearance at its narrowest place, and the
/// largest ball in each section of it: at right angles to the axis, or to the way if that turns
/// away from the axis anywhere but near its ends.
///
/// The way is found on a lattice; each section is then searched as a whole, and its ball and those
/// of bottlenecks are exact but for rounding.
/// @param[in] balls  at least one, every one finite
/// @param[in] way    ends, if it has any, are apart
/// @throws Error(ErrorKind::Input) if an end lies in a ball, or there is no way
Report::Pore findPore(const std::vector<Ball>& balls, const BallSet::PoreWay& way,
                      const Progress& progress);

} // namespace molsurf
