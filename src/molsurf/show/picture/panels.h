// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Several pictures in one.

#include "molsurf/show/picture/draw_mesh.h"

#include <string>
#include <vector>

namespace molsurf
{

/// A picture with its name, which is written below it.
struct PanelPicture {
    Picture picture;
    std::string name; ///< may be empty
};

/// How many panels lie side by side: up to four, then as many as rows or one more.
int panelColumns(std::size_t count);

/// Width of each panel [pixel].
/// @param[in] width  of them all
int panelWidth(std::size_t count, int width);

/// Puts pictures of one size in rows.
/// @param[in] whole  width of the picture with what is beside the panels, which decides the size of
///                   letters [pixel]
Picture joinPanels(const std::vector<PanelPicture>& panels, int width, int whole,
                   const Color& background);

} // namespace molsurf
