// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Copies of the parts of a mesh as a scene of OpenUSD.

#include "molsurf/io/output_file.h"
#include "molsurf/mesh.h"
#include "molsurf/mesh/mesh_instance.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The copies and their scale in the scene of the file.
struct UsdInstances {
    std::string name = "surface"; ///< of the prim; letters that USD does not take become _
    double scale = 1.0;           ///< scene units per Å, in the prim; metersPerUnit follows
    std::vector<MeshInstance> instances;
    /// The same parts at larger voxels, one mesh for each further level of detail.
    std::vector<const Mesh*> coarser{};
};

/// Writes USD as text: a PointInstancer whose prototypes are the parts of the mesh, each about the
/// middle of its own box, so that what an orientation is off by is seen at a prototype's size and
/// not at that of the assembly. Orientations stand twice: `orientations` in half precision, which
/// every USD knows, and `orientationsf`, which newer ones take instead. Up is z.
///
/// A prototype is a mesh for each pair of a part and a colour; they refer to the vertices of the
/// part, which are in the file once. Its colour is displayColor in linear light, and a
/// UsdPreviewSurface says the same. Levels of detail are variants lod0 (the finest, selected),
/// lod1, ... of the set "lod". docs/artists.md has the rules that the file keeps.
///
/// @param[in] mesh  with normals; positions below 1e6 Å
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeUsdaInstances(const Mesh& mesh, const UsdInstances& copies, OutputFile& file);

} // namespace molsurf
