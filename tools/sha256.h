// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <string>

namespace molsurf::tool
{

/// The SHA-256 of a file as it lies on the disk, in 64 lower-case hexadecimal digits, as sha256sum
/// prints it; empty for standard input, pipes and devices, which can be read but once.
/// @throws Error(ErrorKind::Input) if the file cannot be read
std::string sha256OfFile(const std::string& path);

/// The same of a text.
std::string sha256OfText(const std::string& text);

} // namespace molsurf::tool
