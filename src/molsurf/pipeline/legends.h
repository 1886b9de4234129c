// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Legends of the colours that a run gives.

#include "molsurf/core/progress.h"
#include "molsurf/pipeline/options.h"
#include "molsurf/surface/legend.h"
#include "molsurf/surface/mesh.h"

#include <optional>

namespace molsurf
{

/// The legend of one kind of colours, or nothing: the mesh cannot have them. Chains and groups have
/// an entry each, in their order, and if some vertices have none of them one more, "other";
/// elements and kinds of residues those that occur.
///
/// @param[in] mesh  of the run
std::optional<Legend> legendOf(ColorBy by, const BallSelection& atoms, const Mesh& mesh,
                               const Progress& progress);

} // namespace molsurf
