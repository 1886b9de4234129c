// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Surfaces to files and meshes from files. A file is whole or not there: it is written beside its
/// place and moved into it at the end.

#include "molsurf/mesh.h"
#include "molsurf/report.h"
#include "molsurf/surface.h"

#include <string>

namespace molsurf
{

/// Writes a mesh. The end of the name tells the format: .ply (binary, with all attributes), .obj,
/// .stl, .off, .glb or .3mf.
/// @param[in] replace  whether a file that exists may be replaced
/// @throws Error(ErrorKind::Usage) if the name has another end
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeMesh(const Mesh& mesh, const std::string& path, bool replace = true);

/// Writes the grids of a surface, the level set first, as OpenVDB file.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeVdb(const MolecularSurface& surface, const std::string& path, bool replace = true);

/// Writes a report as JSON.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeReport(const Report& report, const std::string& path, bool replace = true);

/// Draws a mesh and writes the picture as PNG.
/// @param[in] width  of the picture [pixel]; the height follows the shape
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePicture(const Mesh& mesh, const std::string& path, int width = 1200, bool replace = true);

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

} // namespace molsurf
