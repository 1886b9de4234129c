// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of a run.

#include "cli/call.h"

#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/surface.h"

#include <optional>
#include <vector>

namespace molsurf::tool
{

/// Everything that is needed to make a .vdb again.
openvdb::MetaMap vdbMetadata(const CommandLine& call, const Report& report);

/// Digest of all that a surface depends on but its atoms: 16 hexadecimal digits that change with
/// any option.
std::string optionsDigest(const CommandLine& call);

/// A table of areas.
/// @param[in] name  one of areaTables()
Table areaTable(const std::string& name, const CommandLine& call, const BallSet& atoms,
                const MolecularSurface& result);

/// Borders and levels that files show of a surface besides its mesh.
struct ShownMeshes {
    std::shared_ptr<const ColorOwners> borders{}; ///< between its colours; null: they have none
    std::optional<Mesh> crisp{};                  ///< the mesh, with these borders cut
    std::shared_ptr<const Mesh> bodies{};         ///< of pockets; null: none
    std::shared_ptr<const Bodies> drawnBodies{};  ///< that pages show, with tunnels; null: none
    std::vector<Mesh> coarser{};                  ///< the further levels of detail of --lod
    std::optional<Legend> legend{}; ///< of colours that no option names; none: by the options
    std::string about{};            ///< what a page shows; empty: kind and voxels of the surface
};

/// The meshes that the files of the call show, but for `coarser`: borders are found once for all of
/// them.
/// @param[in] mesh  of the surface, where the atoms are
ShownMeshes shownMeshes(const CommandLine& call, const BallSet& atoms, const Mesh& mesh,
                        const Progress& progress);

/// Writes one output. The report must be complete but for what is timed by writing.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeOutput(const CommandLine& call, const BallSet& atoms, const MolecularSurface& result,
                 const Output& output, const Progress& progress, OutputFile& file,
                 const ShownMeshes& shown = {});

} // namespace molsurf::tool
