// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Triangle meshes from files of other programs.

#include "molsurf/mesh.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace molsurf
{

/// Whether the name ends in .ply, .obj or .stl, in any case.
bool isMeshName(const std::string& path);

/// See molsurf/files.h.
Mesh readMesh(const std::string& path);

/// The same of a file with at most so many bytes; 0: as many as it has, or 4 GiB of one without a
/// size.
Mesh readMesh(const std::string& path, std::size_t maxBytes);

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
