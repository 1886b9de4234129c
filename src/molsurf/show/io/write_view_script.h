// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Scripts that open a mesh with its colours and its legend in ChimeraX and PyMOL.

#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/output_file.h"

#include <optional>
#include <string>

namespace molsurf
{

/// Writes commands of ChimeraX that open a .glb, put it where the atoms are, and show the legend.
///
/// @param[in] mesh    the file's name, in the folder of the script
/// @param[in] legend  of the colours; none: there is none to show
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeChimeraXScript(const std::string& mesh, const std::optional<Legend>& legend,
                         OutputFile& file);

/// Writes commands of PyMOL that read a binary .ply into an object of compiled graphics, and show
/// the legend: a scale as a ramp, names in the log.
void writePymolScript(const std::string& mesh, const std::optional<Legend>& legend,
                      OutputFile& file);

} // namespace molsurf
