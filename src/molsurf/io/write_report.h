// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report of a run as JSON.

#include "molsurf/io/output_file.h"
#include "molsurf/report.h"

#include <string>

namespace molsurf
{

/// The version of the keys: it grows when one changes its meaning or goes. docs/report.md.
constexpr int reportSchema = 1;

/// The report as JSON text, indented, with a final line feed. Numbers that are not finite are null;
/// bytes that are no UTF-8 become U+FFFD. `evolution` is null if the report has none.
std::string reportText(const Report& report);

/// Writes reportText().
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeReport(const Report& report, OutputFile& file);

} // namespace molsurf
