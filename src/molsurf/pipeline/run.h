// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages in their order: balls in, surface out.

#include "molsurf/core/progress.h"
#include "molsurf/core/report.h"
#include "molsurf/pipeline/options.h"
#include "molsurf/selection/ball.h"
#include "molsurf/surface/mesh.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// What a run leaves.
struct Result {
    openvdb::FloatGrid::Ptr surface; ///< signed distance to the molecular surface [Å]; null with
                                     ///< parts, whose surfaces are among the fields
    std::vector<openvdb::GridBase::Ptr> fields; ///< the grids that Options::fields asked for
    Mesh mesh;
    Report report; ///< program, command, input and the like are left to the caller
};

/// Builds the surface of a set of balls.
///
/// @param[in] balls    at least one, finite
/// @param[in] options  checked by checkOptions()
/// @throws Error(ErrorKind::Usage) for an option out of its range
/// @throws Error(ErrorKind::Numeric) if there is no surface at this resolution
/// @throws Cancelled if the progress object says so
Result run(const std::vector<Ball>& balls, const Options& options, Progress& progress);

/// The same with what else is known of the balls: resolutions, groups, colours.
Result run(const BallSelection& atoms, const Options& options, Progress& progress);

/// The largest tolerance that the Gaussians of the balls have [Å].
double largestTolerance(const BallSelection& atoms, const Options& options);

} // namespace molsurf
