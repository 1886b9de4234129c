// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The areas that groups of atoms bury between them.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

namespace molsurf
{

/// Surfaces every group by itself, and with every other one that is near enough to change its
/// surface. Reports the buried areas (A_a + A_b - A_ab) / 2 from 0.005 Å^2 on, and sets the groups'
/// aloneArea. Of a unit it reports the pairs of a group with another one or with an image, each as
/// often as the whole has it. An image is there as far as the unit feels it, and what is missing
/// changes both areas alike.
///
/// Areas of the solvent-accessible and van der Waals surfaces are in closed form.
///
/// @param[in]     atoms    with groups
/// @param[in]     ofBalls  whether the balls that are buried are listed
/// @param[in,out] report   with the groups
void measureInterfaces(const BallSet& atoms, const SurfaceSpec& spec, bool ofBalls,
                       Progress& progress, Report& report);

} // namespace molsurf
