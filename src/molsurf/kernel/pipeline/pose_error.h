// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far the area of a surface depends on its place on the grid, where fronts and not psi decide
/// which gaps are open.

#include "molsurf/kernel.h"

namespace molsurf
{

/// Tells whether a surface depends on its place on the grid: one at rest at a lambda above 0.04.
bool dependsOnPose(const SurfaceSpec& spec);

/// Makes the surface of dependsOnPose() options two times more, turned and on voxels of twice the
/// edge. Raises EvolutionReport::areaError to 1.5 times the share by which the area of the farther
/// one differs, and adds a warning.
/// @param[in,out] report  of the surface
void estimatePoseError(const BallModel& model, const SurfaceSpec& spec, Progress& progress,
                       Report& report);

} // namespace molsurf
