// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A surface read back from a .vdb: its mesh, identities and colours without the atoms.

#include "molsurf/options.h"
#include "molsurf/surface.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// A surface that was read back, and how it relates to its file.
struct StoredSurface {
    /// Mesh with curvatures, labels and colours; the grid Cd if colours were asked for, the only
    /// field, placed as the surface of the file; the level set in Å; a report of the mesh.
    MolecularSurface result;
    BallSet names;          ///< chains and groups with their colours, for legends; no balls
    SurfaceOptions options; ///< color: what the colours show, if they show what the program knows
    double scale = 1.0;     ///< scene units per Å of the file
    std::vector<std::string> warnings; ///< one line each
};

/// The names and colours of chains and groups as metadata of a file, "label.chain_id" and
/// "label.group_id": lines of colour and name, one a value.
/// @param[in] fields  stored; without the grid of a label its names are left out
void addLabelMetadata(const BallSet& atoms, const std::vector<std::string>& fields,
                      const Progress& progress, openvdb::MetaMap& metadata);

/// The surface that a .vdb of this program holds, or any level set: see operandOf(). Scene
/// conventions that the metadata name are undone, but the place of the origin.
///
/// A vertex has the identities and stored colours of the nearest voxel.
///
/// @param[in] options  color: Nothing takes the colours of the file, if it has any; fields:
///                     curvatures for the mesh
/// @param[in] coloring  of curvatures
/// @throws Error(ErrorKind::Input) if there is no such surface, or if the file cannot give the
///         colours; says which fields they need
StoredSurface storedSurface(const openvdb::GridPtrVec& grids, const openvdb::MetaMap& metadata,
                            const SurfaceOptions& options, const Coloring& coloring,
                            Progress& progress);

} // namespace molsurf
