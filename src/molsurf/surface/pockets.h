// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The pockets of a molecule as a product of a run.

#include "molsurf/surface.h"

namespace molsurf
{

/// Puts the pockets of the balls in a report, and the grids of them that are asked for in its
/// fields.
/// @param[in] options  with SurfaceOptions::pockets
void addPockets(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result);

} // namespace molsurf
