// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Triangles of even size and shape on the zero set of a spline.

#include "molsurf/kernel/mesh/size_field.h"
#include "molsurf/kernel/mesh/surface_vertices.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/progress.h"

#include <vector>

namespace molsurf
{

/// Makes triangles anew: it splits long edges, collapses short ones, turns edges for six neighbours
/// a vertex, and slides vertices along the surface to the centroid of their triangles; then mends
/// the worst angles one by one (Botsch and Kobbelt, A remeshing approach to multiresolution
/// modeling, Symposium on Geometry Processing 2004). Every vertex ends on S = 0, and pieces keep
/// their Euler numbers. The vertices are numbered by the blocks of the spline that they lie in.
///
/// @param[in]     voxel     of the mesher: no vertex moves farther from where it is projected [Å]
/// @param[in]     kept      of each vertex, whether its piece stays as it is
/// @param[in,out] vertices  a closed, oriented manifold mesh without labels and colours
/// @return the largest |S| at a vertex that is new [Å]
double remesh(const Spline& spline, double voxel, const EdgeTarget& target,
              const std::vector<char>& kept, SurfaceVertices& vertices, const Progress& progress);

} // namespace molsurf
