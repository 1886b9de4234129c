// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Values of a surface, smoothed along it.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <vector>

namespace molsurf
{

/// Puts in the place of each vertex's value the mean over the vertices of its connected piece of
/// the mesh that are no farther than a radius, weighted by the area at them: a third of that of
/// their triangles, at the radius as much of a square of this area as is within. Vertices without a
/// value, which is not a number, have no weight, and keep none.
/// @param[in]     radius  [Å]
/// @param[in,out] values  one a vertex
void smoothValues(const Mesh& mesh, double radius, const Progress& progress,
                  std::vector<float>& values);

} // namespace molsurf
