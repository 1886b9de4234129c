// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Area, volume and topology of the smooth surface behind a mesh.

#include "molsurf/core/progress.h"
#include "molsurf/core/report.h"
#include "molsurf/surface/mesh.h"

namespace molsurf
{

/// Measures the smooth surface that a mesh samples, and checks the mesh.
///
/// Each triangle is replaced by the quadratic patch through its corners and through the midpoints
/// of the arcs that its normals imply: for an edge e from p with normal m to q with normal n the
/// midpoint is (p + q)/2 + ((e.n) n - (e.m) m)/8 (the cubic Hermite arc, as in Vlachos et al.,
/// Curved PN triangles, Symposium on Interactive 3D Graphics 2001). Area by a rule of degree 4,
/// volume exactly, by the divergence theorem: fourth order in the length of the edges if vertices
/// and normals are exact.
///
/// A closed piece with negative volume is a cavity wall.
///
/// @param[in] mesh  with normals
/// @return everything but maxResidual, gradientShare, kinkShare
SurfaceReport measure(const Mesh& mesh, const Progress& progress);

} // namespace molsurf
