// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How area and volume of a mesh of curved patches change with the points that span them.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <vector>

namespace molsurf
{

/// The points that span the quadratic patches of measure(): the vertices of the mesh, then the
/// midpoint of the arc over each edge.
struct PatchNodes {
    std::vector<openvdb::Vec3d> points;  ///< [Å]
    std::vector<openvdb::Vec3d> normals; ///< unit, outward
    std::vector<openvdb::Vec3d> volume;  ///< derivatives of the volume by the points [Å^2]
    std::vector<openvdb::Vec3d> area;    ///< those of the area [Å]
};

/// Finds the points and the derivatives by them.
/// @param[in] mesh  with normals, and corners that are vertices
/// @throws Error(ErrorKind::Input) if it is no closed, oriented manifold
PatchNodes patchNodes(const Mesh& mesh, const Progress& progress = Progress());

} // namespace molsurf
