// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What a person may have meant: words of other programs, and values to show as examples.

#include "cli/option_table.h"

#include <string>

namespace molsurf::tool
{

/// An option with a value that it takes, as it is typed: "--pore auto".
std::string exampleOf(const Option& option);

/// What to type in the place of an option of another program: "--probe" for "probe-radius".
/// @return empty: the word is not known
std::string meantByOption(const std::string& typed);

} // namespace molsurf::tool
