// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The tunnels of a molecule as a product of a run.

#include "molsurf/mesh.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/surface.h"

#include <vector>

namespace molsurf
{

/// Puts the tunnels in a report.
/// @param[in] options  with SearchPlaces::tunnelsFrom
void addTunnels(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                Report& report);

/// The tunnels as closed tubes, a part each, coloured by poreColor() of their radii, which the
/// scalar "radius" has.
Mesh tunnelTubes(const Report::Tunnels& tunnels);

/// What the colours of such tubes mean, of those that they have.
std::vector<LegendEntry> tubeLegend(const Mesh& tubes);

/// The balls of tunnels as atoms, whose B factors are to be their radii: a residue TUN for each
/// tunnel, with its number.
BallSet tunnelBalls(const Report::Tunnels& tunnels);

} // namespace molsurf
