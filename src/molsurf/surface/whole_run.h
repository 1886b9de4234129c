// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surface of all balls at once.

#include "molsurf/surface.h"

namespace molsurf
{

/// Makes the surface of all balls, which are computed in spatial order. It leaves aside what the
/// options ask for of parts, interfaces and contacts.
/// @return with areas of the balls where they are known, asked for or not
/// @throws Error as makeSurface()
MolecularSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress);

/// Gives what is known of the surface of all balls in closed form, without voxels.
/// @return as runWhole()
/// @throws Error as makeSurface()
MolecularSurface runWithoutGrid(const BallSet& atoms, const SurfaceOptions& options,
                                Progress& progress);

/// Nothing but the level set, the mesh and their measures.
Products measuresOfWhole();

} // namespace molsurf
