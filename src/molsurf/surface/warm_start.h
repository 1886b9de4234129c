// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The content of a WarmStart, how it is made and how it is used.

#include "molsurf/grid/sparse_field.h"
#include "molsurf/surface.h"

namespace molsurf
{

/// How far the surface at rest lies from the one that the flow began at, in the band.
struct WarmStart::State {
    SparseField correction; ///< phi at rest minus that of psi = 0 [Å]
};

/// Adds to the surface of psi = 0 what the flow of the frame before added to its own.
/// @param[in]     warm  empty: nothing is added
/// @param[in,out] phi   signed distance in the band of the flow [Å]
void addCorrection(const WarmStart& warm, SparseField& phi, const Progress& progress);

/// Keeps for the next frame how far the flow went, where both ends are known.
/// @param[in] cold  the level set of psi = 0 [Å]
/// @param[in] phi   the level set at rest [Å]
WarmStart correctionOf(const SparseField& cold, const SparseField& phi, const Progress& progress);

} // namespace molsurf
