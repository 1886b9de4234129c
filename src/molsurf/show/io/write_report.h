// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report of a run as JSON.

#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"

namespace molsurf
{

/// The version of the keys: it grows when one changes its meaning or goes. docs/report.md.
constexpr int reportSchema = 1;

/// Writes reportText().
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeReport(const Report& report, OutputFile& file);

} // namespace molsurf
