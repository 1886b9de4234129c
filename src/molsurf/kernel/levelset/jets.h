// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Jets of a spline at points in and beside a leaf. Lengths in voxels, from the leaf's first voxel.

#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/levelset/foot_points.h"

#include <openvdb/math/Vec3.h>

#include <cstdint>

namespace molsurf
{

/// Evaluates the spline with the coefficients of a block at some points, side by side.
/// @param[in]  c      coefficients of phi/h
/// @param[in]  y      the points, in [-2, 9]^3
/// @param[in]  which  the lanes to evaluate
/// @param[out] jets   in units of voxels; the other lanes stay
void jetsIn(const LeafBlock<float, 3>& c, const FootPoints::Lanes* y, const bool* which,
            JetLanes& jets);

/// The same spline at one point up to 6 voxels beside a leaf; absent coefficients are 0, and so is
/// all of it farther away.
/// @param[in]  coefficients  of phi [Å]
/// @param[in]  lane          of `jets`, that is written
void jetBeside(const SparseField& coefficients, std::int32_t leaf, const openvdb::Vec3f& y,
               int lane, JetLanes& jets);

} // namespace molsurf
