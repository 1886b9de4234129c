// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Triangle meshes from files of other programs.

#include "molsurf/mesh/mesh.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace molsurf
{

/// Whether the name ends in .ply, .obj or .stl, in any case.
bool isMeshName(const std::string& path);

/// Reads positions and triangles of a .ply (text or binary, either byte order), .obj or .stl (text
/// or binary) file; the extension says which. Polygons are split into fans. Normals, colours and
/// other attributes, materials and groups are passed over.
///
/// Vertices at the same place become one in a .stl file, which shares none, and in the others if
/// the mesh is not closed without that. Triangles with two corners in one place are dropped,
/// and so are vertices of no triangle.
///
/// @return a mesh with at least one triangle, positions finite and below 1e6 Å, without normals
/// @throws Error(ErrorKind::Input) if the file cannot be read, is damaged or cut short, or has no
///         triangle; the message has the line, vertex or face
Mesh readMesh(const std::string& path);

/// The formats, each from the content of a file. A message begins with what is wrong; the caller
/// names the file.
/// @throws Error(ErrorKind::Input)
Mesh parsePly(std::string_view content);
Mesh parseObj(std::string_view content);
Mesh parseStl(std::string_view content);

/// Makes vertices of exactly the same place one, the first of them; drops triangles that lose a
/// corner by it, and vertices of no triangle. The order stays.
/// @return number of vertices dropped
std::size_t weld(Mesh& mesh);

} // namespace molsurf
