// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A line of a description of a file.

#include "molsurf/core/printable.h"

#include <algorithm>
#include <string>

namespace molsurf
{

/// "    name            value\n", values below each other.
inline std::string infoLine(const std::string& name, const std::string& value)
{
    std::string text = "    " + printable(name);
    text.resize(std::max<std::size_t>(text.size() + 1, 20), ' ');
    return text + printable(value) + "\n";
}

/// The title above such lines.
inline std::string infoTitle(const std::string& title)
{
    return printable(title) + "\n";
}

} // namespace molsurf
