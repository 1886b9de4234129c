// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Names and texts out of files, for HTML, XML and scripts in HTML.

#include <string>

namespace molsurf
{

/// Text of HTML or XML, without the control characters, which XML cannot have.
inline std::string markupText(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (static_cast<unsigned char>(c) >= ' ')
            out += c;
    }
    return out;
}

/// JSON that cannot end the script of HTML which it is in: the escape means the same letter.
inline std::string scriptText(const std::string& json)
{
    std::string out;
    for (const char c : json)
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    return out;
}

} // namespace molsurf
