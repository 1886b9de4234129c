// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Takes a level set from voxels of edge 2 h to voxels of edge h.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Samples a level set in its band at voxels of half its size, through its spline, and makes it a
/// distance there.
///
/// @param[in] phi  in a band of bandWidthVox voxels [Å]
/// @param[in] box  of whole leaves of the finer grid: no others are made
/// @return phi in a band of as many finer voxels
SparseField refined(const SparseField& phi, const openvdb::CoordBBox& box,
                    const Progress& progress);

} // namespace molsurf
