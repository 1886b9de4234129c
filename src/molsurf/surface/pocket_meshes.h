// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The bodies of pockets.

#include "molsurf/surface.h"

namespace molsurf
{

/// The space of each pocket as a closed part of a mesh, in the order of the report and named as in
/// legends, with normals out of it and the colours of pockets.
/// @param[in] result  with pockets, and the fields `pocket_id` and `pocket_room`
Mesh pocketBodies(const MolecularSurface& result, const Progress& progress);

} // namespace molsurf
