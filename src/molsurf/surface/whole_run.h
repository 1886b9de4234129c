// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surface of all balls at once.

#include "molsurf/surface.h"

#include <vector>

namespace molsurf
{

/// A surface, and the areas of the balls that it was made of.
struct WholeSurface {
    MolecularSurface surface;  ///< without MolecularSurface::ballAreas
    std::vector<double> areas; ///< of the balls in their order [Å^2]; empty: they are not known
};

/// Makes the surface of all balls, which are computed in spatial order. It leaves aside what the
/// options ask for of parts, interfaces and contacts.
/// @throws Error as makeSurface()
WholeSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress);

/// Gives what is known of the surface of all balls in closed form, without voxels.
/// @throws Error as makeSurface()
WholeSurface runWithoutGrid(const BallSet& atoms, const SurfaceOptions& options,
                            Progress& progress);

} // namespace molsurf
