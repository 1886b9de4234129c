// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How well the triangles of a mesh are made, in numbers.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

using MeshShape = SurfaceReport::Shape;

/// Measures the angles and the edges of all triangles, and the Euler numbers of the closed pieces.
MeshShape shapeOf(const Mesh& mesh, const Progress& progress);

/// The Euler number of each connected piece.
/// @param[in] pieces  of the vertices, less than count
std::vector<int> eulerNumbers(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                              std::size_t count);

/// Adds another mesh to a shape.
void add(const MeshShape& part, MeshShape& sum);

} // namespace molsurf
