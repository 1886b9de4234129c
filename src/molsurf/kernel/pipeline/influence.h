// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far a ball is felt.

#include "molsurf/kernel.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"

namespace molsurf
{

/// How far a ball is felt, for every purpose of a run. All distances are in Å.
class Influence
{
public:
    /// @param[in] model    all balls of the molecule
    /// @param[in] spec   of one surface
    Influence(const BallModel& model, const SurfaceSpec& spec);

    /// @param[in] extent  of the Gaussians of all balls of the molecule
    Influence(const GaussianExtent& extent, const SurfaceSpec& spec);

    const GaussianExtent& extent() const { return extent_; }

    /// How far the surface may lie outside of the balls themselves, where they are not crowded.
    double ofSurface() const;

    /// How far a point of the surface, or of its grid's band, may lie from the ball that it belongs
    /// to: outside of the ball itself.
    double ofLabel() const;

    /// How wide a gap between two balls may be across which they change each other's surface.
    double acrossGap() const;

    /// How far from its centre a ball may change any voxel of any stage.
    double onVoxels() const;

private:
    SurfaceSpec spec_;
    GaussianExtent extent_;
};

} // namespace molsurf
