// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Copies of the parts of a mesh as a scene of OpenUSD.

#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"

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
    std::vector<std::string> fields{}; ///< scalars of vertices that are wanted, by name
};

/// Writes USD as text. The file keeps these rules, which tests/cli/usda.py checks:
///
/// - defaultPrim is an Xform of kind component; upAxis is Z; metersPerUnit is 1e-10 over the scale,
///   which is then the xformOp:scale of the prim. Every extent is present; that of the copies is as
///   USD computes it, around the turned boxes.
/// - The copies are one PointInstancer with ids, protoIndices, positions, and orientations with the
///   real part first, in half precision, which every USD knows, and as `orientationsf`, which newer
///   ones take instead. A prototype is centred on its own box, so that the error of an orientation
///   shows at a prototype's size and not at that of the assembly.
/// - A prototype is a mesh (subdivisionScheme none, normals by vertex) for each pair of a part and
///   a colour; they refer to the vertices of the part, which are in a class once.
/// - A colour is the prototype's displayColor in linear light, and a UsdPreviewSurface bound by the
///   applied MaterialBindingAPI. Colours of vertices are displayColor by vertex, which the material
///   reads. (Not every program shows a colour for each point of the instancer.)
/// - Levels of detail are the variants lod0 (the finest, selected), lod1, ... of the set "lod";
///   they choose prototypes and extent.
///
/// @param[in] mesh  with normals; positions below 1e6 Å
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeUsdaInstances(const Mesh& mesh, const UsdInstances& copies, OutputFile& file);

} // namespace molsurf
