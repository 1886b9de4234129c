// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Lists of structure files.

#include <string>
#include <vector>

namespace molsurf
{

/// Reads the names of structure files.
///
/// @param[in] path  a file with a name a line, where empty lines and those that begin with # do not
///                  count; or "-" for standard input; or a folder, for all structures in it,
///                  sorted; or an archive, for its members in their order (archive.h)
/// @throws Error(ErrorKind::Input) if it cannot be read, has no names, or is a structure itself
std::vector<std::string> readStructureList(const std::string& path, std::size_t maxBytes = 0);

} // namespace molsurf
