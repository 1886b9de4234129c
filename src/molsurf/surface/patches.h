// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Patches of a surface as a product of a run.

#include "molsurf/surface.h"

namespace molsurf
{

/// Puts the patches of the mesh in a report, and if colours are by patch, the label `patch` and
/// colours at its vertices.
/// @param[in] options  that want them
void addPatches(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result);

} // namespace molsurf
