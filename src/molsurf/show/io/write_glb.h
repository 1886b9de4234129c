// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Binary glTF 2.0.

#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The name, scale and colour of the mesh in the scene of the file.
struct GlbOptions {
    std::string name = "surface";  ///< of the node
    double scale = 1.0;            ///< scene units per Å, in the node
    Color plain = {140, 181, 222}; ///< of a mesh without colours
    /// The copies of parts; empty: each part is there once, where it lies.
    std::vector<MeshInstance> instances{};
    /// With copies: the same parts at larger voxels, one mesh for each further level of detail.
    std::vector<const Mesh*> coarser{};
};

/// Writes a .glb: a node that turns z up into glTF's y up and scales, below it one with a mesh for
/// each of the mesh's parts, or one for each copy of them, which share its mesh. Copies of another
/// colour have a mesh of their own with the same numbers. The vertices themselves stay as they are
/// [Å]. Each level of detail is a scene of its own, whose names end in lod0 (the finest, which is
/// the scene to show), lod1, ...
///
/// Attributes: POSITION, NORMAL, COLOR_0 (linear light, 16 bits) if there are colours, and each of
/// Mesh::scalars and Mesh::labels as a float under its name in capitals after an underscore
/// (_MEAN_CURVATURE, _ATOM_ID); glTF has no 32-bit integers at vertices.
///
/// @throws Error(ErrorKind::Output) if the file cannot be written, or if it had 4 GiB or more
void writeGlb(const Mesh& mesh, const GlbOptions& options, OutputFile& file);

} // namespace molsurf
