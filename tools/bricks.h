// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Functions of the verbs plan, brick and merge, and of a build in bricks.

#include "cli/call.h"
#include "outputs.h"
#include "terminal.h"

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/report.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/scale/bricks/plan_file.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf::tool
{

/// "about 5e+04 voxels, 0.2 GiB of memory at most, 0.5 s on one core".
std::string costText(const PlannedBrick& cost);

/// A plan in words, a line each.
std::vector<std::string> describePlan(const BrickPlan& plan);

/// The file of brick `number` (from 1) of a plan.
std::string brickPath(const std::string& planPath, std::size_t number);

/// The file of the atoms of a plan.
std::string atomsPath(const std::string& planPath);

/// How the files that a plan was made of are held against it.
enum class PlanFiles {
    Sizes, ///< those that are there, by their sizes: a brick needs none of them
    Hashes ///< all, by their contents
};

/// The call that a plan was made with, as a build.
/// @param[in] path  of the plan, from whose folder its files are found
/// @throws Error(ErrorKind::Input) if a file has changed since the plan was made
CommandLine callOf(PlanManifest manifest, const std::string& path, PlanFiles files);

/// Joins bricks and writes the outputs of a call.
/// @param[in]     paths   of all bricks, in their order
/// @param[in]     id      of their plan
/// @param[in]     meshed  whether they have to hold the mesh
/// @param[in,out] report  completed
void mergeBricks(const CommandLine& call, const BrickPlan& plan,
                 const std::vector<std::string>& paths, const std::string& id, bool meshed,
                 Terminal& terminal, Clock::time_point start, Report& report);

/// Whether a build can be made in bricks, as far as its options decide that.
bool goesInBricks(const CommandLine& call);

/// Limits of a surface by a call and on this machine.
RunLimits limitsOf(const CommandLine& call);

/// The same of a surface of atoms, with the bodies that pictures show.
RunLimits limitsOf(const CommandLine& call, const BallSet& atoms);

/// Whether a run measures a solvent-excluded surface in closed form: for what it writes, or for a
/// table of many.
bool needsClosedForm(const CommandLine& call);

/// Whether pictures show what is behind the nearest wall, too.
bool seesBehind(const CommandLine& call);

/// The last line of a run.
std::string summary(const Report& report);

/// Prints the time of every stage, threads and memory.
void sayTimes(const Report& report);

/// The option that lets the flow of a call make more steps.
std::string moreSteps(const CommandLine& call);

/// Says so if the flow did not converge.
/// @param[in] more  option that lets it make more steps
/// @return the exit status
int endOf(const Report& report, const std::string& more);

} // namespace molsurf::tool
