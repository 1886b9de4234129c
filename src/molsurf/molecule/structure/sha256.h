// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// SHA-256 of files and texts, in 64 lower-case hexadecimal digits as sha256sum prints them.

#include <cstddef>
#include <string>

namespace molsurf
{

/// The SHA-256 of a file as it lies on the disk; empty for standard input, pipes and devices, which
/// can be read but once.
/// @throws Error(ErrorKind::Input) if the file cannot be read
std::string sha256OfFile(const std::string& path);

/// The same of a text.
std::string sha256OfText(const std::string& text);

/// The SHA-256 of the content of an input; empty for standard input, pipes, and what cannot be
/// read, as its reader will say.
/// @param[in] maxBytes  that a member of an archive may have; see loadText()
std::string sha256OfInput(const std::string& path, std::size_t maxBytes);

} // namespace molsurf
