// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The level set that the flow starts from: the zero set of the smooth field psi.

#include "molsurf/kernel/flow/metric.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// Makes a signed distance to the zero set of a field.
///
/// Near it that is the distance of the zero of psi's second-order Taylor polynomial along its
/// gradient; from there reinitialize() carries it outward.
///
/// @param[in] psi      > 0 inside, smooth near its zero set; active voxels: the band
/// @param[in] width    half width of the band [Å]
/// @param[in] weights  of the metric; with any the surface is moved from psi = 0 towards where it
///                     will rest, to first order
/// @return phi [Å] on the same leaves, < 0 inside, within [-width, width]
SparseField initialSurface(const SparseField& psi, double width, const Weights& weights,
                           const Progress& progress);

} // namespace molsurf
