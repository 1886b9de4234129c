// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Cutting a molecule into bricks.

#include "molsurf/bricks/brick_plan.h"
#include "molsurf/bricks/run_brick.h"

namespace molsurf
{

/// Steps of the flow where the plan has to fix them. At the default tolerance a run of a whole
/// molecule stops after 5 to 15.
constexpr int defaultBrickSteps = 12;

/// What the bricks have to keep to: one of the two is 0.
struct BrickLimits {
    std::size_t bricks = 0; ///< number wanted; there may be fewer where the molecule is small
    std::size_t memory = 0; ///< peak memory of a process [byte]
    /// Whether one process computes the bricks one after another. It may then keep memory for the
    /// next, which is faster than to ask for it again, if the bricks need not be much smaller.
    bool oneProcess = false;
};

/// Cuts space into boxes with about as much surface each, along planes between leaves, the longest
/// edge first.
///
/// With a limit of memory a box is cut until the process that computes it, which also holds all
/// balls, is expected to need less.
///
/// @param[in] options  as checkBrickOptions() lets them pass
/// @throws Error(ErrorKind::Input) if the smallest brick does not fit; says what would
BrickPlan planBricks(const BallSelection& atoms, const Options& options, const BrickLimits& limits,
                     const Progress& progress);

/// The plan of a run in one piece: one brick, whatever the options.
BrickPlan planWhole(const BallSelection& atoms, const Options& options, const Progress& progress);

/// The extent that a plan keeps.
GaussianExtent extentOf(const BrickPlan& plan);

/// What brick k of a plan computes.
Scope scopeOf(const BrickPlan& plan, std::size_t k, const Options& options);

} // namespace molsurf
