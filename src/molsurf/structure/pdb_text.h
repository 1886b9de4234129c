// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Prepares the text of a PDB file for gemmi's reader, which believes what the columns hold.

#include "molsurf/structure/structure.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The content of the records that preparePdb() takes out.
struct PdbRecords {
    std::vector<int> models; ///< numbers of the models that have atoms, in order
    std::vector<Assembly> assemblies;
    std::vector<std::string> warnings;
};

/// Checks and simplifies the text of a PDB file in place; its length does not change.
///
/// - Columns 31-54 of every atom must hold three numbers.
/// - What stands behind column 80 is blanked.
/// - Columns 73-80 that hold no segment, element and charge are blanked (entry name and line
///   number before 1992, "4AT1  83").
/// - MODEL becomes ENDMDL, so that any model number is allowed, also twice.
/// - Every other record but TER, ENDMDL and END is blanked: nothing in it is needed.
///
/// @throws Error(ErrorKind::Input) if an atom's line is too short or its coordinates are no numbers
PdbRecords preparePdb(std::string& text, const std::string& path);

} // namespace molsurf
