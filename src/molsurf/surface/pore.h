// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The pore of a molecule as a product of a run.

#include "molsurf/mesh.h"
#include "molsurf/surface.h"

namespace molsurf
{

/// Puts the pore in a report.
/// @param[in] options  with SearchPlaces::pore
void addPore(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
             Report& report);

/// Adds a closed tube about stations to a mesh that has the scalar "radius", coloured by
/// poreColor().
void addTube(const std::vector<Report::Pore::Station>& stations, Mesh& mesh);

/// The pore as a closed tube, coloured by poreColor() of its radius, which the scalar "radius" has.
Mesh poreTube(const Report::Pore& pore);

} // namespace molsurf
