// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Pictures of a result: how it is seen, its panels and its legends.

#include "cli/call.h"
#include "terminal.h"

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

/// A structure of --panel, with its surface.
struct PanelSurface {
    std::string name;
    BallSet atoms;
    Mesh mesh;
    std::shared_ptr<const ColorOwners> borders; ///< between its colours; null: they have none
    DrawOptions picture;                        ///< with the atoms that it shows
};

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

/// The options of a picture of a surface, whose automatic view comes from the atoms: it is the same
/// for every voxel.
DrawOptions pictureOf(const Call& call, const BallSet& atoms, const Mesh& mesh, bool coloredCopies,
                      const Progress& progress);

/// The values at the ends of the colours; none: they are no values.
std::optional<std::array<double, 2>> rangeOf(const Call& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress);

/// Gives atoms the range of others.
void takeRange(const std::optional<std::array<double, 2>>& range, BallSet& atoms);

/// Makes the surfaces of --panel, in their order, with the colours of the first structure's values.
/// @throws Error as the first structure does, with the name of the file
std::shared_ptr<const std::vector<PanelSurface>> makePanels(const Call& call, const BallSet& first,
                                                            const Mesh& mesh, Terminal& terminal);

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
