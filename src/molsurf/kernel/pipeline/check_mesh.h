// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Checks of every mesh before it is handed out.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

namespace molsurf
{

/// The largest |S| that a vertex may have [voxel].
constexpr double largestResidual = 1e-3;

/// Checks that a mesh is closed and a manifold, that its Euler number is one of closed surfaces,
/// that its vertices lie on the surface, and that two formulas give its volume: that of the flat
/// triangles, and that of the patches through their normals.
/// @param[in] report  measures of the mesh, none of a closed form
/// @param[in] voxel   edge of a voxel [Å]
/// @throws Error(ErrorKind::Check) that names what is wrong, and a place
/// @throws Error(ErrorKind::Numeric) if the two volumes differ, which large voxels bring about
void checkMesh(const Mesh& mesh, const SurfaceReport& report, double voxel,
               const Progress& progress);

/// Adds a warning where the mesh of a surface in closed form has other pieces, or an area too far
/// from that.
/// @param[in] surface  measures of both
void warnOfMesh(const SurfaceReport& surface, double voxel, std::vector<std::string>& warnings);

} // namespace molsurf
