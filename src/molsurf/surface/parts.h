// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Groups of atoms with surfaces of their own, in one result.

#include "molsurf/surface.h"

namespace molsurf
{

/// Surfaces every group by itself (SurfaceOptions::split, or prototypes), or those of
/// SurfaceOptions::surfaceOf alone and the other atoms together.
///
/// The result has no grid `surface`, but a level set `surface_NAME` a part, all with one transform
/// and background, and the fields of each part likewise. The mesh has them one after the other;
/// each is closed, and they may pass through each other. Areas, volumes, pieces and groups are
/// sums; the evolution is that of the part which took the most steps, unless one did not converge.
///
/// Of a unit of a whole each part is made as runUnit() does, among the balls of its group around
/// the unit: measures are those of the whole, and there is no level set.
///
/// @param[in] atoms  with groups
/// @throws Error(ErrorKind::Input) if there is no such group
/// @throws Error as makeSurface(), with the part's name before the message
MolecularSurface runParts(const BallSet& atoms, const SurfaceOptions& options, Progress& progress);

} // namespace molsurf
