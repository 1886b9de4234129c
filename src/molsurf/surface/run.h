// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Runs of a molecule that motions repeat.

#include "molsurf/surface.h"

namespace molsurf
{

/// Makes the surface of what motions repeat: the mesh of a unit, which is open, or that of each
/// prototype once, as a part. Otherwise as makeSurface(), which is the same of a molecule that is
/// whole, and puts the copies of others together.
MolecularSurface makeUnitSurface(const BallSet& atoms, const SurfaceOptions& options,
                                 Progress* progress = nullptr);

} // namespace molsurf
