// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The manual page and the completion of shells, out of the table of options.

#include <string>

namespace molsurf::tool
{

/// The manual page vdb_molsurf(1), for man.
std::string manPage();

/// A script for bash that completes verbs, options and those values that are words.
std::string bashCompletion();

} // namespace molsurf::tool
