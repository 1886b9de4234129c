// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The keys of the report, with what they mean.

#include <string>
#include <vector>

namespace molsurf
{

/// A key of the report.
struct ReportKey {
    const char* path;    ///< "surface.area"; "[]" is for each item of a list
    const char* unit;    ///< "Å²"; empty: none
    const char* meaning; ///< a sentence without its full stop
};

/// All keys, in the order of the report.
const std::vector<ReportKey>& reportKeys();

/// The page of the documentation that lists them.
std::string reportPage();

} // namespace molsurf
