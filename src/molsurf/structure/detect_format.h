// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Detects the format of a text.

#include <string>

namespace molsurf
{

/// The formats of readStructure().
enum class StructureFormat { Pdb, Mmcif, Pqr, Xyzr, Xyzrn };

/// "PDB", "mmCIF", "PQR", "xyzr" or "xyzrn".
const char* formatName(StructureFormat format);

/// Finds the format of a text from its first lines; the extension of `path` (a ".gz" left out)
/// decides where they leave a choice.
///
/// @throws Error(ErrorKind::Input) if the text is none of them: it says what the text looks like
StructureFormat detectFormat(const std::string& path, const std::string& text);

} // namespace molsurf
