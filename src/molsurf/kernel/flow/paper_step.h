// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The flow of the paper, for comparison: an explicit step with one time for all voxels.

#include "molsurf/kernel/flow/front.h"
#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/progress.h"

namespace molsurf
{

/// The flow of the paper stops when no voxel is faster than this [1/Å].
constexpr double paperSpeed = 0.001;

/// Makes a step of  phi_t = |grad phi| (w kappa + n . grad w)  with everything taken at the voxels
/// themselves, cut off towards the rim of a shell, by explicit Euler with the time
/// min(h, h/max|v|). The curvature is that of a cubic B-spline of phi. It settles some half a voxel
/// too far out (docs/math.md, section 4).
///
/// @param[in]  level  the spline lies on voxels of edge 2^level h
/// @param[out] next   phi after the step, as many leaves as phi
/// @param[out] moved  mean size of the step next to the interface [voxel]
/// @return sums before the step; maxSpeed is that of the voxels that move
InterfaceSums paperStep(const NarrowBand& band, const Weights& weights, int level, LeafField& next,
                        double& moved, const Progress& progress);

} // namespace molsurf
