// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Labels of places and rulers between them, on top of a picture.

#include "molsurf/show/picture/view.h"

namespace molsurf
{

/// Draws notes: a text above its point, or a line between two points with their distance.
/// TextCursor are as large as those of legends, with a rim of the other colour.
/// @param[in] width  of the whole picture, with what is beside the mesh [pixel]
void drawNotes(const std::vector<PictureNote>& notes, const View& view, int width,
               Picture& picture);

} // namespace molsurf
