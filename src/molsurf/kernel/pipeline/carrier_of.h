// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The interface of a smooth surface, as the function that closest points are found on.

#include "molsurf/kernel.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/levelset/slope_field.h"

#include <optional>
#include <vector>

namespace molsurf
{

/// |grad psi| on the surface of each ball by itself [1/Å].
/// @param[in] decays  one a ball, or none
std::vector<double> slopesOf(const std::vector<Ball>& balls, const GaussianOptions& options,
                             const std::vector<Decay>& decays);

/// psi on the leaves of a table.
struct PsiOnLeaves {
    const LeafTable& table;
    const LeafField& values;
};

/// The slope of psi.
/// @param[in] extent  of all balls, if these are some of them
/// @param[in] psi     of the balls, with bumps
SlopeField slopeField(const BallModel& model, const SurfaceSpec& spec,
                      const std::optional<GaussianExtent>& extent, const PsiOnLeaves& psi,
                      const Bumps& bumps, const Progress& progress);

/// Makes the smooth carrier of an interface: see smoothCarrier().
/// @param[in] extent  of all balls, if these are some of them
/// @param[in] band    the interface, and psi
SparseField carrierOf(const BallModel& model, const SurfaceSpec& spec,
                      const std::optional<GaussianExtent>& extent, const NarrowBand& band,
                      const Bumps& bumps, const Progress& progress);

} // namespace molsurf
