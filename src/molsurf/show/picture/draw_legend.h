// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Explanations outside of a picture: a legend beside it, a bar of lengths below it.

#include "molsurf/show/color/legend.h"
#include "molsurf/show/picture/draw_mesh.h"

#include <optional>
#include <vector>

namespace molsurf
{

/// Legends of the surface and the atoms of a picture: chains and elements of atoms join the
/// legend that has others of them, or have one of their own.
/// @param[in] model  null: no atoms are shown
std::vector<Legend> legendsOf(const std::optional<Legend>& surface, const AtomModel* model);

/// Width of the column that legends take [pixel].
/// @param[in] width  of the whole picture, which decides the size of the letters
int legendWidth(const std::vector<Legend>& legends, int width);

/// The picture with legends in a column on its right, each a bar with its range and unit and what
/// has no value, or names and their colours; of more names than have room, the first ones and "+"
/// how many more there are. TextCursor are black on a light background and white on a dark one.
///
/// @param[in] width  of the whole: picture.width + legendWidth()
Picture withLegends(const Picture& picture, const std::vector<Legend>& legends, int width,
                    const Color& background);

/// The picture with a bar below its left end that shows a length: the largest of 1, 2 and 5 times a
/// power of ten Å that is a quarter of the width at most.
/// @param[in] picture  to scale
/// @param[in] width    as of legendWidth()
Picture withScaleBar(const Picture& picture, int width, const Color& background);

/// Width of a picture that has legends beside it, half of the whole at least [pixel].
int widthBeside(const std::vector<Legend>& legends, int width);

/// The picture with a scale bar, if it is to scale and wanted, and with legends.
/// @param[in] width  of the whole
Picture explained(Picture picture, const std::vector<Legend>& legends, bool scaleBar, int width,
                  const Color& background);

/// The numbers of a scale, the highest first, with two digits that matter.
std::vector<std::string> tickTexts(const ColorScale& scale);

/// The unit of a scale as it is written: "[1/Å]".
std::string unitText(const Legend& legend);

/// The colour of letters on a background.
Color inkOn(const Color& background);

/// Draws a mesh with what explains it.
/// @param[in] options   of the whole: what is beside the mesh takes of its width, half at most
/// @param[in] legends   none: it has no column for them
/// @param[in] scaleBar  whether a picture that is to scale gets a bar
Picture drawExplained(const Mesh& mesh, DrawOptions options, const std::vector<Legend>& legends,
                      bool scaleBar, const Progress& progress);

} // namespace molsurf
