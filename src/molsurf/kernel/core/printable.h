// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Names and texts out of files, for a terminal, and lines that describe a file.

#include <algorithm>
#include <cstdio>
#include <string>

namespace molsurf
{

/// The character of UTF-8 at a place.
struct Utf8 {
    unsigned code = 0;
    std::size_t bytes = 0; ///< 0: the byte there begins none

    /// Decodes the character that begins at a byte. Overlong forms, surrogates and codes above
    /// 0x10ffff are none.
    Utf8(const std::string& text, std::size_t at)
    {
        const auto byte = [&](std::size_t i) {
            return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
        };
        const unsigned first = byte(at);
        const std::size_t size = first < 0x80                    ? 1
                                 : first >= 0xc2 && first < 0xe0 ? 2
                                 : first >= 0xe0 && first < 0xf0 ? 3
                                 : first >= 0xf0 && first < 0xf5 ? 4
                                                                 : 0;
        code = size < 2 ? first : first & (0x7fu >> size);
        for (std::size_t i = 1; i < size; ++i) {
            if ((byte(at + i) & 0xc0) != 0x80) return;
            code = code << 6 | (byte(at + i) & 0x3f);
        }
        const bool longer = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
        const bool none = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
        if (!longer && !none) bytes = size;
    }

    /// Whether terminals obey it, or turn the way of the letters behind it.
    bool controls() const
    {
        return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e ||
               code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
               (code >= 0x2066 && code <= 0x2069);
    }
};

/// A text whose control characters, which terminals obey, and bytes that are no UTF-8 are written
/// as \x1b or \u202e and the like; an end of a line is a space.
inline std::string printable(const std::string& text)
{
    std::string out;
    const auto escape = [&](const char* form, unsigned code) {
        char escaped[16];
        std::snprintf(escaped, sizeof escaped, form, code);
        out += escaped;
    };
    for (std::size_t i = 0; i < text.size();) {
        const Utf8 letter(text, i);
        if (text[i] == '\n')
            out += ' ';
        else if (letter.bytes == 0 || (letter.controls() && letter.code < 0x100))
            escape("\\x%02x",
                   letter.bytes == 0 ? static_cast<unsigned char>(text[i]) : letter.code);
        else if (letter.controls())
            escape("\\u%04x", letter.code);
        else
            out.append(text, i, letter.bytes);
        i += letter.bytes == 0 ? 1 : letter.bytes;
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
