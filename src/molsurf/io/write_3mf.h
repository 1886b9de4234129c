// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// 3MF, the 3D Manufacturing Format.

#include "molsurf/io/output_file.h"
#include "molsurf/mesh.h"

#include <string>

namespace molsurf
{

/// Finds out before any work is done whether write3mf() will have what it needs.
/// @throws Error(ErrorKind::Output) if lib3mf is not installed
void load3mf();

/// Writes a .3mf: an object and a build item for each of the mesh's parts, in millimetres with six
/// decimals, and, if there are colours, the three of each triangle's corners (sRGB). The format has
/// no place for normals and other attributes. One mesh gives the same bytes; the identifiers (UUID)
/// that the format wants are made of the mesh.
///
/// The work is lib3mf's, which is loaded here and not with the program, since it would delay every
/// start of it.
///
/// @param[in] name    of the object, if the mesh has no parts
/// @param[in] perAngstrom  millimetres per Å
/// @throws Error(ErrorKind::Output) if lib3mf is not installed or refuses the mesh, or if the file
///         cannot be written
void write3mf(const Mesh& mesh, const std::string& name, double perAngstrom, OutputFile& file);

} // namespace molsurf
