// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The critical points of psi about the level that matters for gaps: where grad psi = 0.
/// The search starts at voxels whose Newton step to grad psi = 0, by differences, is shorter than
/// max(1.6 voxels, 0.8 Å). Of those whose steps end in the same cube of half a voxel it takes the
/// nearest. docs/math.md, section 2.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/topology/gaps.h"
#include "molsurf/progress.h"

#include <functional>
#include <vector>

namespace molsurf
{

/// Finds the critical points with psi between -farthestGap and highestUncovered; those above
/// farthestGap only if no ball covers them.
/// @param[in] psi      on voxels
/// @param[in] jet      psi at points
/// @param[in] covered  whether a ball reaches a point, and a length [Å] beyond it
/// @return distinct, by place
std::vector<Gap>
findCriticalPoints(const SparseField& psi, const PsiJetAt& jet,
                   const std::function<bool(const openvdb::Vec3d&, double)>& covered,
                   const Progress& progress);

} // namespace molsurf
