// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of small molecules: .sdf and .mol, and .mol2.

#include "molsurf/structure/structure.h"

#include <string>

namespace molsurf
{

/// Reads the molecules of an .sdf or .mol file, V2000 or V3000; each is a model. Atoms are named by
/// their elements, "C1", "C2", "O1".
/// @throws Error(ErrorKind::Input) with the line, if it is not as described, or if a molecule is
///         drawn in two dimensions
Structure readSdf(const std::string& text, const std::string& path);

/// Reads the molecules of a .mol2 file; each is a model. Residues are its substructures, with
/// numbers and chains if they are given; atoms have charges if all lines have one. Types ("C.3")
/// tell the elements; lone pairs are left out.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readMol2(const std::string& text, const std::string& path);

} // namespace molsurf
