// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Surfaces that are too large for one piece: space is cut into bricks, which are computed one by
/// one, in this process or in others, and merged.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// One brick: a box of whole leaves.
struct PlannedBrick {
    openvdb::CoordBBox box;
    std::size_t atoms = 0;  ///< balls whose centres lie in it
    std::size_t voxels = 0; ///< expected active voxels of the grid `surface` in it
    std::size_t bytes = 0;  ///< expected peak memory of the process that computes it
    double seconds = 0.0;   ///< expected time on one core
};

/// The bricks, and what all of them have to agree on.
struct BrickPlan {
    std::vector<PlannedBrick> bricks; ///< they do not overlap, and hold the whole surface
    int steps = 0;                    ///< of the flow
    openvdb::Coord anchor;            ///< positions in sums are taken from this voxel
    double maxRadius = 0.0;           ///< largest radius of all balls [Å]
    double maxGrownRadius = 0.0; ///< the same with the probe, and with what a resolution adds [Å]
    double maxTolerance = 0.0;   ///< largest tolerance of their Gaussians [Å]
    std::size_t atoms = 0;       ///< balls
    bool keepsMemory = false;    ///< freed pages stay in the process for the next brick
};

/// Steps of the flow where the plan has to fix them. At the default tolerance a run of a whole
/// molecule stops after 5 to 15.
constexpr int defaultBrickSteps = 12;

/// Limits for planBricks(): a number of bricks or a memory limit; exactly one is set.
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
/// @param[in] options  of one surface in one piece, see the errors
/// @throws Error(ErrorKind::Usage) for options that need the whole molecule at once
/// @throws Error(ErrorKind::Input) if the smallest brick does not fit; says what would
BrickPlan planBricks(const BallSet& atoms, const SurfaceOptions& options, const BrickLimits& limits,
                     const Progress& progress = Progress());

/// Computes a brick of a plan and writes its file.
///
/// @param[in] balls   all of the molecule, not those of the brick alone
/// @param[in] number  of the brick, from 1
/// @throws Error(ErrorKind::Usage) for options that need the whole molecule at once
/// @throws Error(ErrorKind::Output) if the file cannot be written
void makeBrick(const BallSet& balls, const SurfaceOptions& options, const BrickPlan& plan,
               std::size_t number, const std::string& path, Progress* progress = nullptr);

/// Joins all bricks of a plan to one level set and one closed mesh, neither of which is ever held
/// in memory.
///
/// @param[in] bricks  files of makeBrick(), in the order of the plan
/// @param[in] vdb     OpenVDB file to write; empty: none
/// @param[in] ply     mesh to write, as .ply; empty: none
/// @return what is known of the surface
/// @throws Error(ErrorKind::Input) if a brick is missing or belongs to another plan
/// @throws Error(ErrorKind::Output) if a file cannot be written
Report mergeBricks(const std::vector<std::string>& bricks, const BrickPlan& plan,
                   const SurfaceOptions& options, const std::string& vdb, const std::string& ply,
                   Progress* progress = nullptr);

} // namespace molsurf
