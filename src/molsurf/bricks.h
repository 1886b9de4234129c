// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Makes surfaces that are too large for one piece. Space is cut into bricks, which are computed
/// one by one, in this process or in others, and merged.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// A brick: a box of whole leaves of the grid, each of 8^3 voxels.
struct PlannedBrick {
    openvdb::CoordBBox box; ///< its voxels
    std::size_t atoms = 0;  ///< number of balls whose centres lie in the box
    std::size_t voxels = 0; ///< expected number of active voxels of the grid `surface` in the box
    std::size_t bytes = 0;  ///< expected peak memory of the process that computes it [byte]
    double seconds = 0.0;   ///< expected time on one core [s]
};

/// A list of bricks, and the numbers that all of them use.
struct BrickPlan {
    std::vector<PlannedBrick> bricks; ///< boxes that do not overlap and hold the whole surface
    int steps = 0;                    ///< number of steps of the flow
    openvdb::Coord anchor;            ///< voxel that positions in sums are relative to
    /// Of all balls: the largest radius, the largest one with probe and level (see Decay), and the
    /// largest tolerance of a Gaussian [Å].
    double maxRadius = 0.0, maxGrownRadius = 0.0, maxTolerance = 0.0;
    std::size_t atoms = 0;    ///< number of balls
    bool keepsMemory = false; ///< whether a process keeps the memory of one brick for the next
                              ///< instead of returning it to the system

    /// The number of steps of the flow if the options do not fix it, and that where lambda is
    /// large: bricks have to make the same number. A run of a whole molecule stops after 2 or 3
    /// steps at the default lambda.
    static constexpr int defaultSteps = 5, defaultFrontSteps = 15;
};

/// Limits for planBricks(): a number of bricks or a memory limit. Exactly one of both is set.
struct BrickLimits {
    std::size_t bricks =
        0; ///< number of bricks, of which a small molecule may give fewer; 0: not set
    std::size_t memory = 0; ///< peak memory of a process [byte]; 0: not set
    /// Whether one process computes all bricks, one after another. It may then keep freed memory
    /// for the next brick, which is faster, if bricks need not become much smaller for that.
    bool oneProcess = false;
    /// Whether the process that computes a brick reads the atoms near it from a file, and does not
    /// hold all of them.
    bool atomsOnDisk = false;
};

/// Refuses a surface in one piece that is estimated to take more memory than there is, before
/// makeSurface() takes it.
///
/// @param[in] memory    [byte]; 0: what the machine, its control group and the process may have
/// @param[in] progress  may end the estimate
/// @throws Error(ErrorKind::Input) with both numbers
/// @throws Cancelled if the progress object says so
void checkMemory(const BallSet& atoms, const SurfaceOptions& options, std::size_t memory = 0,
                 const Progress& progress = Progress());

/// Plans bricks: cuts space along planes between leaves into boxes with about the same area of
/// surface, across the longest edge first.
///
/// With a limit of memory a box is cut until the process that computes it is expected to need less.
///
/// @param[in] atoms     the balls of the whole molecule
/// @param[in] options   the options of the surface
/// @param[in] progress  may end the planning
/// @throws Error(ErrorKind::Usage) if an option needs the whole molecule at once
/// @throws Error(ErrorKind::Input) if even the smallest brick needs more memory, which the
///         message tells
/// @throws Cancelled if the progress object says so
BrickPlan planBricks(const BallSet& atoms, const SurfaceOptions& options, const BrickLimits& limits,
                     const Progress& progress = Progress());

/// Computes a brick of a plan and writes its file.
///
/// @param[in] balls     the balls of the whole molecule, as for planBricks()
/// @param[in] options   the options that the plan was made with
/// @param[in] number    the number of the brick in the plan, from 1
/// @param[in] path      the file to write, for mergeBricks()
/// @param[in] progress  follows the run and may end it; null: nobody does
/// @throws Error(ErrorKind::Usage) if an option needs the whole molecule at once
/// @throws Error(ErrorKind::Output) if the file cannot be written
/// @throws Cancelled if the progress object says so
void makeBrick(const BallSet& balls, const SurfaceOptions& options, const BrickPlan& plan,
               std::size_t number, const std::string& path, Progress* progress = nullptr);

/// Joins all bricks of a plan to one level set and one closed mesh, neither of which is ever in
/// memory as a whole.
///
/// @param[in] bricks    the files that makeBrick() wrote, in the order of the plan
/// @param[in] options   the options that the plan was made with
/// @param[in] vdb       the OpenVDB file to write; empty: none
/// @param[in] ply       the mesh to write, a .ply file; empty: none
/// @param[in] progress  follows the run and may end it; null: nobody does
/// @return measures of the surface
/// @throws Error(ErrorKind::Input) if a brick is missing or belongs to another plan
/// @throws Error(ErrorKind::Output) if a file cannot be written
/// @throws Cancelled if the progress object says so
Report mergeBricks(const std::vector<std::string>& bricks, const BrickPlan& plan,
                   const SurfaceOptions& options, const std::string& vdb, const std::string& ply,
                   Progress* progress = nullptr);

} // namespace molsurf
