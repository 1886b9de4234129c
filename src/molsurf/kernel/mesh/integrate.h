// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Integrals over the surface S = 0 of a spline. Formulas: docs/adr/0003-interpolating-spline.md.

#include "molsurf/kernel/spline/spline.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// Result of integrateSurface().
struct IntegratedSurface {
    SurfaceIntegrals sums; ///< over the whole surface
    /// Of each vertex the integrals of H [Å] and of K [sr] over its cell: those of the triangles
    /// about it, times the barycentric coordinate that is 1 at the vertex. They add up to `sums`.
    std::vector<double> meanCurvature, gaussianCurvature;
};

/// Integrates area, volume and curvatures over S = 0 by quadrature on the surface itself.
///
/// The mesh only cuts the surface into patches: over each triangle the surface is the graph along
/// the interpolated normals of the corners, found by Newton's method on S, with the exact element
/// of area. A triangle is first split at edges whose ends have normals more than 40 degrees apart,
/// the new points being moved onto S = 0, and then refined in its parameters until two rules for
/// the integral of K agree. Neighbours share their edges whatever their refinement, so patches
/// leave no gaps. Converges to the integrals over S = 0, in which cusps that lie between the
/// vertices count in full.
///
/// @param[in] mesh       closed, its vertices on S = 0, with the normals of S
/// @param[in] tolerance  what the differences of the two rules may add up to over the surface [sr],
///                       > 0; the integral of K was 20 to 1000 times more accurate on proteins
/// @return IntegratedSurface::sums has an unresolvedArea > 0 where a triangle is no graph over the
///         surface, as in crevices that the voxels do not resolve; such a triangle is taken flat,
///         with the spherical image of its three normals for the integral of K and 0 for those of
///         H and H^2
IntegratedSurface integrateSurface(const Mesh& mesh, const Spline& spline, double tolerance,
                                   const Progress& progress);

} // namespace molsurf
