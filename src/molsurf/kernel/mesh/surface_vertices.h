// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Vertices of a mesh on the zero set of a spline.

#include "molsurf/kernel/spline/spline.h"
#include "molsurf/mesh.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// Values at the vertices of a mesh on S = 0.
struct SurfaceVertices {
    Mesh& mesh;                 ///< its scalars are the mean and the Gaussian curvature
    std::vector<float>& slopes; ///< |grad S|

    /// Puts vertex v to x.
    /// @param[in] mean,gauss  curvatures [1/Å], [1/Å^2]
    void set(std::size_t v, const openvdb::Vec3f& x, const openvdb::Vec3f& normal, float slope,
             float mean, float gauss);

    /// The same with what follows from S at x.
    void set(std::size_t v, const openvdb::Vec3d& x, const Jet& jet);
};

/// Moves vertices onto S = 0 along the gradient by Newton's method, or, where the gradient fails,
/// by bisection between two corners of their cells that lie on opposite sides.
///
/// It is fast if vertices of one leaf follow each other. What becomes of a vertex does not depend
/// on the others.
///
/// @param[in]     voxel      of the mesher: no vertex moves farther [Å]
/// @param[in]     first,end  the numbers of the vertices
/// @param[in,out] vertices   their positions, and what follows from S there
/// @param[out]    residuals  |S| at each of them [Å], at most 1e-5 voxels but where it was bisected
void moveToSurface(const Spline& spline, double voxel, std::size_t first, std::size_t end,
                   SurfaceVertices& vertices, float* residuals);

} // namespace molsurf
