// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the tunnels of balls.

#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// The probes of tunnels: the small one fits everywhere in them, and they end where the large one
/// gets from outside [Å].
struct TunnelOptions {
    double probe, probeOut;
};

/// Finds the ways from a place among balls to the outside, one for each mouth: those along which
/// the narrowest place is as wide as can be, exact but for rounding.
///
/// They begin in a room, where the clearance is largest nearby: the one that the way up from a
/// point leads to, or the one of a site, whose atoms may fill their middle x. That is, of those
/// with a way out, the room with the largest R^2 / (|x - c|^2 + P^2): c is its centre, R its
/// radius, at most that of the large probe, P. They end at the surface of the large probe.
/// @param[in] balls  at least one, every one finite
/// @throws Error(ErrorKind::Input) if the small probe does not fit at a point, if the large probe
///         gets to the place from outside, or if there is no way out
Report::Tunnels findTunnels(const std::vector<Ball>& balls, const SearchPlaces::End& from,
                            const TunnelOptions& options, const Progress& progress);

} // namespace molsurf
