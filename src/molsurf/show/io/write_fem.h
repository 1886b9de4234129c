// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Meshes for programs that fill them with tetrahedra. Outer walls and each cavity have markers of
/// their own: 1 for the outer walls, 2 and on for the cavities, the largest first.

#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"

namespace molsurf
{

/// Writes a piecewise linear complex as tetgen reads it (.poly): vertices [Å], triangles with their
/// markers, and a point in the void of each cavity, so that tetgen leaves it empty.
/// @param[in] mesh  closed, with normals
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePoly(const Mesh& mesh, OutputFile& file);

/// Writes Gmsh's format 4.1 as text: a discrete surface, with the name "outer wall" or "cavity N"
/// as physical group, for each marker.
void writeMsh4(const Mesh& mesh, OutputFile& file);

/// Writes Gmsh's format 2.2 as text, with the same groups.
void writeMsh2(const Mesh& mesh, OutputFile& file);

} // namespace molsurf
