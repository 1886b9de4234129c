// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From the options of a command line to what is meant, one function a verb. They throw
/// Error(ErrorKind::Usage) where that makes no sense.

#include "cli/call.h"

namespace molsurf::tool
{

void completeBuild(CommandLine& call);
void completeBatch(CommandLine& call);
void completeCompare(CommandLine& call);
void completeConvert(CommandLine& call);
void completePlan(CommandLine& call);
void completeBrick(CommandLine& call);
void completeMerge(CommandLine& call);
void completeInfo(CommandLine& call);

/// Completes the call of a verb that builds surfaces of structures, and one that a plan keeps.
void completeSurface(CommandLine& call);

} // namespace molsurf::tool
