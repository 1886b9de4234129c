// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report of a comparison, as JSON and as lines to read.

#include "molsurf/io/output_file.h"
#include "molsurf/surface/comparison_report.h"

#include <string>

namespace molsurf
{

/// The report as JSON text, indented, with a final line feed. What is not defined is null.
std::string comparisonText(const ComparisonReport& report);

/// Writes comparisonText().
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeComparison(const ComparisonReport& report, OutputFile& file);

/// A table of the numbers, some ten lines.
std::string comparisonTable(const ComparisonReport& report);

} // namespace molsurf
