// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From the options of a command line to what is meant, one function a verb. They throw
/// Error(ErrorKind::Usage) where that makes no sense.

#include "cli/call.h"

namespace molsurf::tool
{

void completeBuild(Call& call);
void completeBatch(Call& call);
void completeCompare(Call& call);
void completeConvert(Call& call);
void completePlan(Call& call);
void completeBrick(Call& call);
void completeMerge(Call& call);
void completeInfo(Call& call);

/// Completes the call of a verb that builds surfaces of structures, and one that a plan keeps.
void completeSurface(Call& call);

} // namespace molsurf::tool
