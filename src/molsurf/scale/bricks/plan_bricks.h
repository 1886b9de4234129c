// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Cutting a molecule into bricks.

#include "molsurf/atoms.h"
#include "molsurf/bricks.h"
#include "molsurf/scale/bricks/run_brick.h"
#include "molsurf/show/io/check_vdb.h"

#include <functional>
#include <memory>

namespace molsurf
{

/// The plan of a run in one piece: one brick, whatever the options. Its box counts for nothing:
/// where leaves are many, larger ones are counted, and where these are many, a sample of them.
BrickPlan planWhole(const BallSet& atoms, const SurfaceOptions& options, const Progress& progress);

/// Returns the memory that a brick is given where there is a limit [byte]: more than its estimate,
/// which is neither the least nor the most.
std::size_t memoryFor(const PlannedBrick& brick);

/// Limits of a run.
struct RunLimits {
    std::size_t memory;                            ///< [byte]
    double hours;                                  ///< by the clock
    int threads;                                   ///< that it has
    const char* hint = " [hint: a larger `voxel`"; ///< what takes less; more may follow
    bool bricks = false;                           ///< whether `memory` makes bricks
    PlannedBrick besides = {};                     ///< what comes on top of a surface
};

/// Refuses what is estimated to take more than it may, with what comes on top of it.
/// @throws Error(ErrorKind::Input) with both numbers
void checkCost(const PlannedBrick& cost, const RunLimits& limits);

/// The same of a surface in one piece. It takes no time to speak of where the molecule is small.
/// @return the estimated time on one core, or more [s]
double checkCost(const BallSet& atoms, const SurfaceOptions& options, const RunLimits& limits,
                 const Progress& progress);

/// Cost of reading, meshing and measuring a stored surface.
PlannedBrick costOfStored(const VdbContent& content);

/// Cost of reading a mesh from a file of so many bytes.
/// @param[in] flat  whether it has each vertex once, as numbers: .ply
PlannedBrick costOfMesh(std::size_t bytes, bool flat);

/// Cost of comparing two surfaces, both in memory.
PlannedBrick costOfComparison(const PlannedBrick& a, const PlannedBrick& b);

/// Cost of drawing a surface, without that of making it.
/// @param[in] voxels     of the surface
/// @param[in] width      of the picture [pixel]
/// @param[in] isLayered  whether what is behind the nearest wall is seen, too
PlannedBrick costOfPicture(std::size_t voxels, int width, bool isLayered);

/// Cost of writing the level set on all points of its box, one by one.
PlannedBrick costOfMap(const BallSet& atoms, const SurfaceOptions& options);

/// The plan of a run without a grid: one brick without voxels.
BrickPlan planWithoutGrid(const BallSet& atoms, const SurfaceOptions& options);

/// Checks the numbers of a plan that was read from a file, which could prolong a run or lead it out
/// of space: its steps are those that the options say, and its bricks are boxes of whole leaves.
/// checkExtent() checks the lengths.
/// @throws Error(ErrorKind::Input) with what is wrong
void checkPlan(const BrickPlan& plan, const SurfaceOptions& options);

/// Refuses a plan of other balls. Machines may differ in the last digits.
/// @param[in] extent  of all balls
/// @throws Error(ErrorKind::Input) if it is not the plan's
void checkExtent(const BrickPlan& plan, const GaussianExtent& extent);

/// The extent that a plan keeps.
GaussianExtent extentOf(const BrickPlan& plan);

/// The part of space that brick k of a plan computes.
Scope scopeOf(const BrickPlan& plan, std::size_t k, const SurfaceOptions& options);

/// Gives the balls whose centres lie in a box of space [Å], as ballsIn() does.
using BallSource = std::function<BallSet(const openvdb::BBoxd& space)>;

/// Computes a brick of a plan and writes its file.
/// @param[in] balls   of the molecule, coloured if the options want colours
/// @param[in] number  of the brick, from 1
/// @param[in] id      name of the plan
/// @param[in] meshed  whether a mesh will be wanted
/// @param[in,out] coarse  what the flows of all bricks start from, if they do not start from psi;
///                        it is computed if it is null, and serves the next brick
void computeBrick(const BallSource& balls, const SurfaceOptions& options, const BrickPlan& plan,
                  std::size_t number, const std::string& id, const std::string& path, bool meshed,
                  std::shared_ptr<const SparseField>& coarse, Progress& progress);

} // namespace molsurf
