// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A line of a description of a file.

#include <algorithm>
#include <string>

namespace molsurf
{

/// "    name            value\n", values below each other.
inline std::string infoLine(const std::string& name, const std::string& value)
{
    std::string text = "    " + name;
    text.resize(std::max<std::size_t>(text.size() + 1, 20), ' ');
    return text + value + "\n";
}

} // namespace molsurf
