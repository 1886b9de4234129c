// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Picture files.

#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/draw_mesh.h"

namespace molsurf
{

/// Writes a picture as PNG, 8 bits a channel.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePng(const Picture& picture, OutputFile& file);

} // namespace molsurf
