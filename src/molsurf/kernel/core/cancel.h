// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "molsurf/progress.h"

namespace molsurf
{

/// Ends a run here if its progress object wants it to stop.
/// @throws Cancelled
inline void stopIfCancelled(const Progress& progress)
{
    if (progress.cancelled()) throw Cancelled();
}

} // namespace molsurf
