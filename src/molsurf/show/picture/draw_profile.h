// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The profile of a pore: its radius against the distance along it, as a chart.

#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/draw_mesh.h"

namespace molsurf
{

/// Draws the chart.
/// @param[in] width  of the picture [pixel]; it is half as high
Picture drawProfile(const Report::Pore& pore, int width);

/// Writes the same chart as SVG.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeProfileSvg(const Report::Pore& pore, OutputFile& file);

} // namespace molsurf
