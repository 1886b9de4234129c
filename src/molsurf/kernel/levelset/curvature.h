// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Curvature of a level set at the voxels of a leaf, by central differences: second order in h.

#include "molsurf/kernel/grid/leaf_block.h"

namespace molsurf
{

/// Derivatives of the level set at the 512 voxels of a leaf.
struct LeafCurvature {
    alignas(64) float normal[3][leafSize]; ///< grad phi / |grad phi|
    alignas(64) float slope[leafSize];     ///< |grad phi|
    alignas(64) float mean[leafSize]; ///< kappa = k1 + k2 = div(grad phi/|grad phi|) [1/Å]; > 0 on
                                      ///< a ball
    alignas(64) float gauss[leafSize]; ///< K = k1 k2 [1/Å^2]
};

/// Fills in all members in the rows of a leaf (8 voxels along z) that have an active voxel.
///
/// With H the Hessian and n the normal: kappa = (tr H - n.H n)/|grad phi|,
/// K = n.adj(H) n/|grad phi|^2 (Goldman, Curvature formulas for implicit curves and surfaces,
/// Computer Aided Geometric Design 22(7):632-658, 2005; opposite sign of kappa). Where the gradient
/// vanishes all members are finite but mean nothing.
///
/// @param[in] phi    [Å]
/// @param[in] voxel  voxel edge h [Å]
void curvature(const LeafBlock<float, 1>& phi, const LeafMask& active, float voxel,
               LeafCurvature& out);

} // namespace molsurf
