// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Triangles of the size that the options ask for, in the place of those of the voxels.

#include "molsurf/kernel.h"
#include "molsurf/kernel/mesh/remesh.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Makes the triangles of a mesh anew, as the options say. Measures of the surface in the report
/// stay those of the finer mesh before; what it says of the triangles becomes true of the new ones.
///
/// Closed pieces that are less than five edges across stay as they are, and one warning names them.
///
/// @param[in,out] mesh  closed, a manifold, without labels and colours; its scalars are the mean
///                      and the Gaussian curvature
/// @throws Error(ErrorKind::Check) if the pieces do not keep their Euler numbers
void remeshSurface(const KernelOptions& options, const Spline& spline, const Progress& progress,
                   Mesh& mesh, Report& report);

} // namespace molsurf
