// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Pictures of a result: how it is seen, its panels and its legends.

#include "cli/call.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/surface.h"
#include "molsurf/surface/drawn_surface.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// The options of the surface of a panel, whose kind may be another one.
SurfaceOptions panelOptions(SurfaceOptions options, const Panel& panel);

/// The name of the first surface among its panels.
std::string firstName(const CommandLine& call);

/// The bodies of the largest pockets, as many as the call shows, in colours that neither the
/// surface nor the atoms have, and the tubes of tunnels. Says how many pockets are left out.
/// @param[in] pockets  bodies of all, the largest first
Bodies drawnBodies(const CommandLine& call, const BallSet& atoms, const Mesh& pockets,
                   const MolecularSurface& surface, Terminal& terminal);

/// Shows bodies among the atoms of a picture.
void showBodies(const Bodies& bodies, DrawOptions& picture);

/// The values at the ends of the colours; none: they are no values.
std::optional<std::array<double, 2>> rangeOf(const CommandLine& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress);

/// Gives atoms the range of others.
void takeRange(const std::optional<std::array<double, 2>>& range, BallSet& atoms);

/// Fills CommandLine::panelSurfaces, in their order, with the colours of the first structure's
/// values.
/// @throws Error as the first structure does, with the name of the panel
void makePanels(const CommandLine& call, const BallSet& first, const Mesh& mesh,
                Terminal& terminal);

/// The exit status for panels; says which of them are not at rest.
int endOf(const std::vector<PanelSurface>& panels);

} // namespace molsurf::tool
