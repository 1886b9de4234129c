// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The content of a WarmStart.

#include "molsurf/grid/sparse_field.h"
#include "molsurf/surface.h"

namespace molsurf
{

/// How far the surface at rest lies from the one that the flow began at, in the band.
struct WarmStart::State {
    SparseField correction; ///< phi at rest minus that of psi = 0 [Å]
};

} // namespace molsurf
