// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Grids as a file of NanoVDB, which GPUs read as it lies in memory.

#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

namespace molsurf
{

/// Writes grids with their names, classes, transforms and values, uncompressed, a segment each, in
/// the order given. A .nvdb has no metadata beside these.
/// @throws Error(ErrorKind::Output) if the file cannot be written, or if NanoVDB has no grids of a
///         type
void writeNvdb(const openvdb::GridCPtrVec& grids, OutputFile& file);

} // namespace molsurf
