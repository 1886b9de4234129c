// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Statistics of a quantity over a surface.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// Statistics of values with weights; those without weight do not count.
///
/// The q-th percentile is the smallest value that, with all values up to it, has at least q % of
/// the weight.
///
/// @param[in] values   finite
/// @param[in] weights  >= 0, as many
/// @return all zero if there is no weight
Statistics statistics(const std::vector<float>& values, const std::vector<float>& weights);

/// The part of the mesh's area that belongs to each vertex: a third of each triangle at it [Å^2].
std::vector<float> vertexAreas(const Mesh& mesh, const Progress& progress);

} // namespace molsurf
