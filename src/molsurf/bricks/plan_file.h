// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The manifest of a plan: plan.json.

#include "molsurf/bricks/brick_plan.h"
#include "molsurf/io/output_file.h"

namespace molsurf
{

/// The content of plan.json.
std::string manifestText(const PlanManifest& manifest);

void writeManifest(const PlanManifest& manifest, OutputFile& file);

/// @throws Error(ErrorKind::Input) if the file cannot be read or is no plan
PlanManifest readManifest(const std::string& path);

} // namespace molsurf
