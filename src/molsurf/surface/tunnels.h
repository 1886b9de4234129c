// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The tunnels of a molecule as a product of a run.

#include "molsurf/mesh.h"
#include "molsurf/surface.h"

namespace molsurf
{

/// Puts the tunnels that atoms were read with in a report.
/// @param[in] atoms  with BallSet::tunnelsFrom
void addTunnels(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                Report& report);

/// The tunnels as closed tubes, a part each, coloured by poreColor() of their radii, which the
/// scalar "radius" has.
Mesh tunnelTubes(const Report::Tunnels& tunnels);

/// The balls of tunnels as atoms, whose B factors are to be their radii: a residue TUN for each
/// tunnel, with its number.
BallSet tunnelBalls(const Report::Tunnels& tunnels);

} // namespace molsurf
