// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of MSMS and what it prints.

#include "msms/call.h"
#include "msms/surface.h"

#include "molsurf/molecule/structure/structure.h"
#include "molsurf/show/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf::msms
{

/// The name of a file of a component, as MSMS makes it: base.vert for the first, base_1.vert for
/// the next.
/// @param[in] ending  ".vert" or ".face"
std::string componentName(const std::string& base, std::size_t component, const char* ending);

/// The spheres in the files.
struct Spheres {
    const Structure& structure;     ///< as the file has them
    const std::vector<Ball>& balls; ///< those that are used; Ball::atom is an index in `structure`
};

/// Writes the vertices: position, normal, face, sphere (from 1), kind, and its name if it has one.
void writeVertices(const MsmsCall& call, const Spheres& spheres, const Component& component,
                   OutputFile& file);

/// Writes the triangles: three vertices (from 1), kind, face.
void writeFaces(const MsmsCall& call, const Spheres& spheres, const Component& component,
                OutputFile& file);

/// Writes a line for every sphere of the file: number (from 0), areas, and its name if it has one.
void writeAreas(const Spheres& spheres, const MsmsSurface& surface, OutputFile& file);

/// Text before the work, and after it.
std::string titleText(const MsmsCall& call, const Spheres& spheres);
std::string resultText(const MsmsCall& call, const MsmsSurface& surface);

} // namespace molsurf::msms
