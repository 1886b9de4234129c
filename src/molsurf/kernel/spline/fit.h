// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A spline from a field on a grid as fine as it, or finer.

#include "molsurf/kernel/spline/spline.h"

namespace molsurf
{

/// Fits the spline that interpolates a field at every 2^level-th voxel: on the coarse grid G_0 of
/// the paper, if the field lives on its grid G_level.
///
/// @param[in] field  values to interpolate at its active voxels [Å]
/// @param[in] level  0, 1 or 2
Spline fitSpline(const SparseField& field, int level, const Progress& progress);

} // namespace molsurf
