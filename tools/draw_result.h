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

/// A structure or kind of --panel, with its surface.
struct PanelSurface {
    std::string name;
    BallSet atoms;
    Mesh mesh;
    ShownMeshes shown;
    DrawOptions picture; ///< with the atoms that it shows
    bool inPlace;        ///< whether it is of the first structure
    std::string unrest;  ///< that it is not at rest; empty: it is
};

/// The options of the surface of a panel, whose kind may be another one.
SurfaceOptions panelOptions(SurfaceOptions options, const Panel& panel);

/// The name of the first surface among its panels.
std::string firstName(const CommandLine& call);

/// The point that is 0 in meshes.
openvdb::Vec3d originOf(const CommandLine& call);

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

/// The surface of a call as pictures show it.
/// @param[in] turn   beside that of the call [degree]
/// @param[in] quick  as DrawOptions::quick
DrawnSurface drawnSurface(const CommandLine& call, const BallSet& atoms, const Mesh& mesh,
                          const ShownMeshes& shown, double turn = 0.0, bool quick = false);

/// The same with the panels of the call behind it.
std::vector<DrawnSurface> drawnPanels(const CommandLine& call, const DrawnSurface& first);

} // namespace molsurf::tool
