// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The bodies of pockets.

#include "molsurf/analysis/pockets/find_pockets.h"
#include "molsurf/mesh.h"

namespace molsurf
{

/// Makes MolecularSurface::pocketBodies.
Mesh pocketBodies(const Pockets& pockets, const Progress& progress);

} // namespace molsurf
