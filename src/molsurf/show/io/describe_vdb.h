// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A text on an OpenVDB file: its metadata and its grids.

#include <string>

namespace molsurf
{

/// Reads an OpenVDB file and describes it in lines of name and value; level sets also by area
/// and volume.
/// @throws Error(ErrorKind::Input) if the file cannot be read
std::string describeVdb(const std::string& path);

} // namespace molsurf
