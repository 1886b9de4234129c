// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surface of a symmetric assembly from one unit of it.

#include "molsurf/surface.h"

namespace molsurf
{

/// Makes the surface of a unit (Placement::unit) among the balls around it, and measures the whole
/// that its rotations make: areas, volumes and pieces are those of the whole, the mesh and its
/// statistics those of the unit, without a grid.
///
/// A point of the surface belongs to the unit of the ball whose power distance is the least, of
/// balls grown by the probe for the surfaces of a union. Area, volume and curvature of the whole
/// are those of the unit times the order of the group; its pieces follow from which pieces of the
/// unit meet at the borders; its Euler characteristic counts corners where m units meet as 1/m.
///
/// @throws Error as checkWay() and makeSurface()
MolecularSurface runUnit(const BallSet& atoms, const SurfaceOptions& options, Progress& progress);

} // namespace molsurf
