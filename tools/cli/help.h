// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The texts that tell of verbs and options, all made of their tables.

#include "cli/call.h"

#include <string>

namespace molsurf::tool
{

/// All verbs, a line each.
std::string overview();

/// What --help prints for a verb.
std::string helpText(Verb verb);

/// The manual page, for man.
std::string manPage();

/// The completion of bash.
std::string bashCompletion();

/// The options of all verbs as Markdown: docs/options.md.
std::string optionsPage();

} // namespace molsurf::tool
