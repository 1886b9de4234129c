// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Grids as a .vdb file.

#include "molsurf/io/output_file.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// Writes grids and the file's metadata, compressed (Blosc, active values only). To standard output
/// the file goes without the offsets that let a reader load a part of it.
///
/// @param[in] grids     with their names, classes and transforms, in the order of the file
/// @param[in] metadata  of the file as a whole
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeVdb(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata,
              OutputFile& file);

} // namespace molsurf
