// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Legends as SVG, to be placed and scaled in a figure.

#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Legends below each other, all of their names, in letters of 16 units: each a bar with its range
/// and unit, or names with their colours. Text is text, in DejaVu Sans, Arial or what there is.
/// @param[in] background  decides whether letters are black or white; it is not drawn
std::string legendSvg(const std::vector<Legend>& legends, const Color& background);

/// Writes legendSvg().
/// @throws Error(ErrorKind::Input) if there is none
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeLegendSvg(const std::vector<Legend>& legends, const Color& background, OutputFile& file);

} // namespace molsurf
