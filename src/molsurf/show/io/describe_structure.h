// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A text on a structure file: models, chains, atoms, assemblies and their symmetry.

#include <cstddef>
#include <string>

namespace molsurf
{

/// Reads a structure file and describes it in lines of name and value. Of every assembly it tells
/// the point group, the axes and the copies about them.
/// @param[in] maxInput  that the file may have; see ReadLimits::maxInput [byte]
/// @throws Error(ErrorKind::Input) if the file cannot be read
std::string describeStructure(const std::string& path, std::size_t maxInput = 0);

} // namespace molsurf
