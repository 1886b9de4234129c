// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How well triangles on a smooth surface are made: how quads are split into them, and how vertices
/// of bad ones slide along the surface.

#include "molsurf/kernel/mesh/surface_vertices.h"
#include "molsurf/kernel/mesh/vertex_set.h"
#include "molsurf/progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The two triangles of a quad a b c d that splitQuads() takes.
inline std::array<std::array<std::uint32_t, 3>, 2> halvesOf(std::uint32_t a, std::uint32_t b,
                                                            std::uint32_t c, std::uint32_t d)
{
    return {{{a, b, c}, {a, c, d}}};
}

/// Splits quads into two triangles each: along the shorter diagonal, unless the triangles of the
/// other one agree clearly better with the normals at their corners.
/// @param[in]     first,end  the numbers of the triangles
/// @param[in,out] mesh       its triangles there, those of halvesOf() a quad
/// @param[out]    bad        the corners of needle-like and folded triangles are added to it
void splitQuads(std::size_t first, std::size_t end, Mesh& mesh, VertexSet& bad);

/// Slides the vertices of bad triangles along the surface to the centroid of their neighbours, a
/// few times. Blocks of 8 voxels take turns, and in each the vertices come as they are numbered.
/// @param[in] bad  the corners of the bad triangles
void relax(SurfaceVertices& vertices, const Spline& spline, double voxel, VertexSet bad,
           const Progress& progress);

} // namespace molsurf
