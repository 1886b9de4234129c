// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Coarse resolutions that keep the volume of the fine surface.

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Coarse Gaussians overlap far outside the atoms, so their surface swells. This sets the level of
/// the balls of each resolution rule, one number a rule, so that the surface of these balls alone
/// encloses the volume that it has with the tolerance of the options instead.
///
/// By bisection and the secant rule on whole runs, at the voxel of the options or 1 Å, whichever is
/// coarser.
///
/// @param[in,out] atoms  decays and resolutions are set
/// @throws Error(ErrorKind::Numeric) if no level is found
void matchVolumes(BallSet& atoms, const SurfaceSpec& spec, const Progress& progress);

} // namespace molsurf
