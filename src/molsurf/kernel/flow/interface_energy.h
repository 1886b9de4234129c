// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The energy of an interface by a quadrature that hardly depends on the voxels.

#include "molsurf/kernel/flow/metric.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The integral of the metric w over the zero set of a level set [Å^2], by the places where it
/// crosses edges between voxels: an edge along axis a that is crossed counts for h^2 |n_a| of the
/// area, since a piece dA of it crosses |n_a| dA/h^2 of them. Places and normals come from cubic
/// interpolation along the edge, psi there from the Gaussians themselves.
///
/// @param[in] region  whose own leaves count
double interfaceEnergy(const SparseField& phi, const GaussianSum& sum, const Weights& weights,
                       const Region& region, const Progress& progress);

} // namespace molsurf
