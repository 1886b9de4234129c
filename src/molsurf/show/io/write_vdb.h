// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Grids as a .vdb file.

#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <cstdint>

namespace molsurf
{

/// How the values of a file's grids are stored, as OpenVDB's flags: the active ones only, and if
/// there are labels or colours among the grids, by Blosc. That makes those 3 to 18 times smaller,
/// but floats near a surface only by 6 %, and takes as long as all other writing.
/// @param[in] floatsAlone  whether all grids are of floats
std::uint32_t vdbCompression(bool floatsAlone);

/// Writes grids and the file's metadata. To standard output the file goes without the offsets that
/// let a reader load a part of it.
///
/// @param[in] grids     with their names, classes and transforms, in the order of the file
/// @param[in] metadata  of the file as a whole
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeVdb(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata,
              OutputFile& file);

} // namespace molsurf
