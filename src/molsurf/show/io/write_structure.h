// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Writes atoms as PDB or mmCIF, with a value of each in the place of its B factor.

#include "molsurf/atoms.h"
#include "molsurf/show/io/output_file.h"

#include <vector>

namespace molsurf
{

/// Writes atoms as a PDB file, in their order, copies of an assembly as chains of their own.
///
/// @param[in] atoms   with names
/// @param[in] values  one an atom, below 999.995; the file has two decimals
/// @param[in] origin  the point that is 0 in the file [Å]
/// @throws Error(ErrorKind::Output) if the format has no room for a name, a coordinate or a value,
///         if an atom has no names, or if the file cannot be written
void writePdb(const BallSet& atoms, const std::vector<double>& values, const openvdb::Vec3d& origin,
              OutputFile& file);

/// Writes atoms as an mmCIF file. Values have the digits of a float.
/// @throws Error(ErrorKind::Output) if an atom has no names, or if the file cannot be written
void writeMmcif(const BallSet& atoms, const std::vector<double>& values,
                const openvdb::Vec3d& origin, OutputFile& file);

} // namespace molsurf
