// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// PDB, mmCIF and BinaryCIF by way of gemmi.

#include "molsurf/progress.h"
#include "molsurf/structure/structure.h"

#include <string>

namespace molsurf
{

/// Reads the text of a PDB file; see readStructure() for what is accepted.
/// @param[in] text  consumed, to save memory
/// @param[in] progress  may end the reading between its stages
/// @throws Error(ErrorKind::Input) if it cannot be read; a text without atoms gives none
/// @throws Cancelled if the progress object says so
Structure readPdb(std::string text, const std::string& path, const Progress& progress);

/// Reads the text of an mmCIF file: the first data block that has atoms, or spheres of an
/// integrative model.
/// @param[in] text  consumed, to save memory
/// @throws Error(ErrorKind::Input) if it cannot be read, or if no data block has atoms
Structure readMmcif(std::string text, const std::string& path, const Progress& progress);

/// The same of a BinaryCIF file.
Structure readBinaryCif(std::string bytes, const std::string& path, const Progress& progress);

} // namespace molsurf
