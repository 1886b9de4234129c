// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surface in one brick of space.

#include "molsurf/atoms.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/options.h"
#include "molsurf/scale/bricks/brick.h"
#include "molsurf/surface/product_table.h"

namespace molsurf
{

/// Makes halos so wide that a brick owns what a run of the whole molecule has there.
/// @param[in] region  the brick
/// @param[in] extent  of all balls
Scope brickScope(const SurfaceOptions& options, const Region& region, const GaussianExtent& extent);

/// The box in which balls change what a brick computes [Å].
openvdb::BBoxd spaceNear(const SurfaceOptions& options, const Scope& scope);

/// A box that holds the balls of any molecule [Å].
inline openvdb::BBoxd everywhere()
{
    constexpr double far = 1e7;
    return {openvdb::Vec3d(-far), openvdb::Vec3d(far)};
}

/// The balls in a box, with all that is known of them; groups and rules still count those of the
/// whole.
BallSet ballsIn(const BallSet& atoms, const openvdb::BBoxd& space);

/// Computes what a brick owns of a surface.
/// @param[in] atoms    those in spaceNear(), in spatial order, coloured if colours are wanted
/// @param[in] options  as checkWay() lets them pass, with a number of steps
Brick runBrick(const BallSet& atoms, const SurfaceOptions& options, const Scope& scope,
               Progress& progress);

} // namespace molsurf
