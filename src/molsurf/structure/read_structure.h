// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads .pdb .ent .cif .mmcif .pqr .xyzr, each also .gz, and standard input.

#include "molsurf/structure/structure.h"

#include <string>

namespace molsurf {

/// Reads a structure.
///
/// The format follows the extension; for standard input ("-") it is found from the content.
/// Columns 73-80 of pre-1992 PDB files, which hold the entry name and a line number, are ignored.
///
/// @throws Error(ErrorKind::Input) if the file does not exist, is a folder, is empty or is cut short,
///         is not a structure, has no model or no atom, or has a coordinate that is not finite or
///         lies beyond 1e6 Å
Structure readStructure(const std::string& path);

} // namespace molsurf
