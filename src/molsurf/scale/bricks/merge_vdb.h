// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The .vdb of the whole from the bricks' leaves, without holding their values.

#include "molsurf/progress.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// Active voxels of the grid `surface`, and the memory it takes when loaded [byte].
struct MergedSize {
    std::size_t activeVoxels = 0, bytes = 0;
};

/// Writes grids with the bricks' leaves: what writeVdb() writes of the grids of the whole. The
/// trees are held without values, some 200 bytes a leaf.
///
/// @param[in] bricks    all of a plan
/// @param[in] voxel     voxel edge [Å]
/// @param[in] creator   META_CREATOR of the grids
/// @param[in] metadata  of the file as a whole
void writeMergedVdb(const std::vector<BrickFile>& bricks, double voxel, const std::string& creator,
                    const openvdb::MetaMap& metadata, OutputFile& file, const Progress& progress);

/// The grid's part of the report.
MergedSize sizeOfMerged(const std::vector<BrickFile>& bricks);

} // namespace molsurf
