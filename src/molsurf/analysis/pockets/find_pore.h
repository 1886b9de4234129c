// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the pore of balls.

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <string>
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
Report::Pore findPore(const std::vector<Ball>& balls, const SearchPlaces::PoreWay& way,
                      const Progress& progress);

/// Balls line a way, or a room, within this of the ball there [Å].
constexpr double liningReach = 1.0;

/// A station at a ball, without its distance.
Report::Pore::Station stationOf(const FittedBall& ball, const openvdb::Vec3d& normal);

openvdb::Vec3d placeOf(const Report::Pore::Station& station);

/// "(1.00, 2.00, 3.00)".
std::string placeText(const openvdb::Vec3d& x);

/// The stations that are narrower than the way on both sides of them, by 0.1 Å at least, and the
/// narrowest of all.
std::vector<std::size_t> necksOf(const std::vector<Report::Pore::Station>& stations);

/// Adds the balls that line it to a station.
void addLining(const Clearance& clearance, Report::Pore::Station& station);

} // namespace molsurf
