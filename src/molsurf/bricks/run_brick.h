// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surface in one brick of space.

#include "molsurf/atoms.h"
#include "molsurf/bricks/brick.h"
#include "molsurf/options.h"
#include "molsurf/surface/surface_run.h"

namespace molsurf
{

/// Halos wide enough that what a brick owns is what a run of the whole molecule has there.
/// @param[in] region  the brick
/// @param[in] extent  of all balls
Scope brickScope(const SurfaceOptions& options, const Region& region, const GaussianExtent& extent);

/// The balls near a brick, in their order, with all that is known of them.
BallSet ballsNear(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope);

/// @throws Error(ErrorKind::Usage) for options that need the whole molecule at once; names them as
///         the command line does
void checkBrickOptions(const SurfaceOptions& options);

/// Computes what a brick owns of a surface.
/// @param[in] atoms    those that ballsNear() gives, or more; coloured if colours are wanted
/// @param[in] options  as checkBrickOptions() lets them pass, with a number of steps
Brick runBrick(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
               Progress& progress);

} // namespace molsurf
