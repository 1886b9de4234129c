// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How area and volume of a smooth surface change when balls move, by the shape derivative.

#include "molsurf/atoms.h"
#include "molsurf/kernel/balls/ball_forces.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The derivatives of area and volume of the patches over a mesh, whose nodes move as the surface
/// does. A node lies at the offset inside of a point y of the interface F = psi - v = 0 and moves
/// along its normal as y does, by (dF/dx_i)/|grad F|; with it goes the tangential part of the
/// atoms' own motion, which changes no surface and lets a translation be one. psi is that of the
/// Gaussians themselves, and v the level at rest (kernel/flow/equilibrium.h). docs/math.md,
/// section 10.
///
/// @param[in] atoms  as they were meshed, with the rates of their resolutions
/// @param[in] spec   of a surface at rest in closed form
/// @param[in] mesh   of that surface, with normals
/// @return in the order of the balls
BallGradients smoothGradients(const BallSet& atoms, const SurfaceSpec& spec, const Mesh& mesh,
                              const Progress& progress);

} // namespace molsurf
