// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Pictures of a result: how it is seen, its panels and its legends.

#include "cli/call.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/color/crisp_borders.h"
#include "molsurf/color/legend.h"
#include "molsurf/surface.h"

#include <array>
#include <memory>
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

/// What decides the surface of a panel, whose kind may be another one.
SurfaceOptions panelOptions(SurfaceOptions options, const Panel& panel);

/// The name of the first surface among its panels.
std::string firstName(const Call& call);

/// The point that is 0 in meshes.
openvdb::Vec3d originOf(const Call& call);

/// The balls where they lie to the mesh.
std::vector<Ball> placedBalls(const Call& call, const BallSet& atoms);

/// The borders between the colours of a mesh; null: they have none.
std::shared_ptr<const ColorOwners> bordersOf(const Call& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress);

/// The copies of an assembly as nodes.
/// @param[in] colored  copies that are near have different colours
std::vector<MeshInstance> instancesOf(const Call& call, const BallSet& atoms, const Mesh& mesh,
                                      bool colored, const Progress& progress);

/// Shows bodies among the atoms of a picture.
void showBodies(const Mesh& bodies, DrawOptions& picture);

/// The options of a picture of a surface, whose automatic view comes from the atoms: it is the same
/// for every voxel.
DrawOptions pictureOf(const Call& call, const BallSet& atoms, const Mesh& mesh, bool coloredCopies,
                      const Progress& progress);

/// The values at the ends of the colours; none: they are no values.
std::optional<std::array<double, 2>> rangeOf(const Call& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress);

/// Gives atoms the range of others.
void takeRange(const std::optional<std::array<double, 2>>& range, BallSet& atoms);

/// Fills Call::panelSurfaces, in their order, with the colours of the first structure's values.
/// @throws Error as the first structure does, with the name of the panel
void makePanels(const Call& call, const BallSet& first, const Mesh& mesh, Terminal& terminal);

/// The exit status for panels; says which of them are not at rest.
int endOf(const std::vector<PanelSurface>& panels);

/// Source of a picture.
struct Drawn {
    const Call& call;
    const BallSet& atoms;
    const Mesh& mesh;
    const std::shared_ptr<const ColorOwners>& borders;
    const std::optional<Legend>& legend; ///< of colours that no option names; none: by the options
    const Progress& progress;
};

/// The legends of a picture and its panels, each name once.
std::vector<Legend> legendsOf(const Drawn& drawn);

/// Draws it, with its panels.
/// @param[in] turn   beside that of the call [degree]
/// @param[in] quick  as DrawOptions::quick
Picture drawResult(const Drawn& drawn, double turn, bool quick);

} // namespace molsurf::tool
