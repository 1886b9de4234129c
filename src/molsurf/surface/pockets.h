// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The pockets of a molecule as a product of a run.

#include "molsurf/show/color/color_map.h"
#include "molsurf/surface.h"

#include <cstddef>
#include <string>

namespace molsurf
{

/// The name of a pocket in legends.
/// @param[in] number  from 1
std::string pocketName(std::size_t number, double volume);

/// Its colour. The largest have colours of their own, and the others those again.
Color pocketColor(std::size_t number);

/// Whether pockets are asked for, or colours by them.
bool wantsPockets(const SurfaceOptions& options);

/// Puts the pockets of the balls in a report, the grids of them that are asked for in its fields
/// (all, where it has no other grid), and, if colours are by pocket, the label `pocket` and colours
/// at the vertices of the mesh.
/// @param[in] options  that want them
void addPockets(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result);

} // namespace molsurf
