// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the verbs plan, brick and merge share, and a build in bricks with them.

#include "cli.h"
#include "outputs.h"
#include "terminal.h"

#include "molsurf/bricks/brick_plan.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/surface/report.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf::tool
{

/// What a plan comes to, a line each.
std::vector<std::string> describePlan(const BrickPlan& plan);

/// The file of brick `number` (from 1) of a plan.
std::string brickPath(const std::string& planPath, std::size_t number);

/// Computes a brick and writes its file.
/// @param[in] atoms   of the whole molecule, coloured if the options want colours
/// @param[in] meshed  whether a mesh will be wanted
void computeBrick(const BallSelection& atoms, const Options& options, const BrickPlan& plan,
                  std::size_t number, const std::string& id, const std::string& path, bool meshed,
                  Terminal& terminal);

/// The call that a plan was made with, as a build.
Call callOf(const PlanManifest& manifest);

/// Joins bricks and writes the outputs of a call.
/// @param[in]     paths   of all bricks, in their order
/// @param[in]     id      of their plan
/// @param[in,out] report  completed
void mergeBricks(const Call& call, const BrickPlan& plan, const std::vector<std::string>& paths,
                 const std::string& id, Terminal& terminal, Clock::time_point start,
                 Report& report);

/// The last line of a run.
std::string summary(const Report& report);

/// Says so if the flow did not converge.
/// @return the exit status
int endOf(const Report& report);

} // namespace molsurf::tool
