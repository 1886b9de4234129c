// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Files whose atoms carry their own radii: PQR, xyzr and xyzrn.

#include "molsurf/structure/structure.h"

#include <string>

namespace molsurf
{

/// Reads a PQR text: from the right radius, charge, z, y, x; from the left serial number, atom,
/// residue, an optional chain, residue number. HETATM records are hetero unless they are water.
/// @throws Error(ErrorKind::Input) naming the line, if it has too few columns, if a column is no
///         number, or if a radius is negative
Structure readPqr(const std::string& text, const std::string& path);

/// Reads an xyzr text; see readStructure() for its columns.
/// @throws Error(ErrorKind::Input) as readPqr()
Structure readXyzr(const std::string& text, const std::string& path);

/// Reads an xyzrn text; see readStructure() for its columns. Lines without a name are allowed.
/// @throws Error(ErrorKind::Input) as readPqr()
Structure readXyzrn(const std::string& text, const std::string& path);

} // namespace molsurf
