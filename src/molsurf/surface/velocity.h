// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How a surface moves from frame to frame, for motion blur.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// The grid `v`: at each active voxel of a surface the displacement of the ball that it belongs to,
/// as in labelSurface(); 0 elsewhere. Vectors that are relative and turn with the grid
/// (openvdb::VEC_CONTRAVARIANT_RELATIVE).
///
/// @param[in] displacement  one a ball [Å per frame, or in the units of the scene]
openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const BallSet& atoms,
                                     const std::vector<openvdb::Vec3f>& displacement,
                                     const SurfaceOptions& options, const Progress& progress);

} // namespace molsurf
