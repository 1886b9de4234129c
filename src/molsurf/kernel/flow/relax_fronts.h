// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Steps of the flow where the interface still moves, and nowhere else.

#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/kernel/flow/newton_step.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <vector>

namespace molsurf
{

/// How the steps of settle() went.
struct Settling {
    int steps = 0;         ///< number of steps that the longest front made
    std::size_t awake = 0; ///< leaves that still moved at the end
};

/// Moves to rest what a flow of the whole has left: where a gap closes from its end, a front goes
/// on long after everything else rests. A leaf is awake where a voxel of the interface moves by
/// more than a limit, first in the flow's last step, then in all of a round of four steps: voxels
/// that go to and fro in a gap do not. The leaves that are awake and their neighbours make the
/// steps, with those about them as they stand, for 60 steps at most.
///
/// @param[in,out] band     of a whole surface
/// @param[in]     largest  the largest displacements in the leaves of the band [voxel]
/// @param[in]     limit    at rest [voxel]
Settling settle(NarrowBand& band, const PsiSource& source, const NewtonOptions& options,
                std::vector<float> largest, float limit, Progress& progress);

} // namespace molsurf
