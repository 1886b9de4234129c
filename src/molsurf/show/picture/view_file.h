// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Views that are kept in files, for pictures that are seen alike.

#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/draw_mesh.h"

#include <string>

namespace molsurf
{

/// Whether a file's name says that it is a view: "NAME.view".
bool isViewName(const std::string& path);

/// Looks from somewhere. Up is y, or z for who looks along x or y.
/// @param[in] toEye  not 0
void lookFrom(const openvdb::Vec3d& toEye, DrawOptions& options);

/// Writes how drawMesh() sees a mesh: JSON with `to_eye`, `up`, `center`, `width`, `height` [Å].
void writeView(const Mesh& mesh, const DrawOptions& options, OutputFile& file);

/// Takes over a view from a file.
/// @throws Error(ErrorKind::Input) if it cannot be read, or is none
void readView(const std::string& path, DrawOptions& options);

} // namespace molsurf
