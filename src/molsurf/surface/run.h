// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages in their order: balls in, surface out.

#include "molsurf/balls/ball.h"
#include "molsurf/core/progress.h"
#include "molsurf/grid/leaf_table.h"
#include "molsurf/mesh/mesh.h"
#include "molsurf/surface/options.h"
#include "molsurf/surface/report.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// What the flow of one frame leaves for the next: how far the surface at rest lies from the one
/// that it began at, in the band.
struct WarmStart {
    LeafTable table;
    LeafField correction; ///< phi at rest minus that of psi = 0 [Å]
};

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
///
/// @param[in,out] warm  null, or what a run with nearly the same balls and the same options left,
///                      or empty: the flow begins nearer to its rest. Afterwards that of this run;
///                      left alone by surfaces of parts and those that do not flow.
Result run(const BallSelection& atoms, const Options& options, Progress& progress,
           WarmStart* warm = nullptr);

/// How far a point of the surface, or of its grid's band, may lie from its ball [Å].
double labelReach(const BallSelection& atoms, const Options& options);

} // namespace molsurf
