// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Names and texts out of files, for a terminal, and lines that describe a file.

#include <algorithm>
#include <cstdio>
#include <string>

namespace molsurf
{

/// A text whose control characters, which terminals obey, are written as \x1b and the like; an end
/// of a line is a space.
inline std::string printable(const std::string& text)
{
    std::string out;
    const auto escape = [&](unsigned char c) {
        char code[8];
        std::snprintf(code, sizeof code, "\\x%02x", c);
        out += code;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        if (c == '\n') {
            out += ' ';
        } else if (c == 0xc2 && next >= 0x80 && next < 0xa0) { // U+0080 to U+009F
            escape(next);
            ++i;
        } else if (c < 0x20 || c == 0x7f) {
            escape(c);
        } else {
            out += text[i];
        }
    }
    return out;
}

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
