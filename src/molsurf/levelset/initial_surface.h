// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The level set that the flow starts from: the zero set of the smooth field psi.

#include "molsurf/grid/leaf_table.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// A signed distance to the zero set of a field.
///
/// Near it the distance of the zero of psi's second-order Taylor polynomial along its gradient;
/// from there outward by reinitialize().
///
/// @param[in] table  active voxels: the band
/// @param[in] psi    > 0 inside; smooth near its zero set
/// @param[in] voxel  voxel edge h [Å]
/// @param[in] width  half width of the band [Å]
/// @return phi [Å], < 0 inside, within [-width, width]
LeafField initialSurface(const LeafTable& table, const LeafField& psi, double voxel, double width,
                         const Progress& progress);

} // namespace molsurf
