// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Closest points of a surface to voxels ("feet" of the normals through them), side by side
/// so that loops over them vectorise. Lengths in voxels.

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/spline/spline.h"

#include <cstdint>

namespace molsurf
{

constexpr int lanes = 16; ///< points side by side

/// Points of a surface with the shape of the surface there, a lane each.
struct FootPoints {
    using Lanes = float[lanes];

    alignas(64) Lanes y[3];
    alignas(64) Lanes n[3];  ///< unit normal, outward
    alignas(64) Lanes A[6];  ///< shape operator: xx yy zz xy yz xz
    alignas(64) Lanes kappa; ///< trace of A
    alignas(64) Lanes gauss; ///< determinant of A on the tangent plane
};

/// Values, gradients and Hessians (xx yy zz xy yz xz) of a level set.
struct JetLanes {
    alignas(64) FootPoints::Lanes value;
    alignas(64) FootPoints::Lanes gradient[3];
    alignas(64) FootPoints::Lanes hessian[6];

    Jet at(int lane) const;
};

/// Shape of the level set through each point from its derivatives: the normal, and the Hessian over
/// the gradient's length projected to the tangent plane, with principal curvatures limited to one a
/// voxel, which is all a grid can hold.
/// @param[in] largest  that limit [1/voxel]
void shapeFrom(const JetLanes& jets, FootPoints& feet, float largest = 1.0f);

/// Newton steps along the surface that bring points y of it closest to voxels x: d solves
/// (I + s A) d = t on the tangent plane, s and t being the normal and the tangential part of x - y.
void stepsAlong(const FootPoints& feet, const FootPoints::Lanes* x, FootPoints::Lanes* d);

/// One Newton step toward the zero set, and along it toward x.
void newtonSteps(const JetLanes& jets, const FootPoints& feet, const FootPoints::Lanes* x,
                 FootPoints::Lanes* d);

/// Distances of voxels x, without sign, by the expansion of the distance function about their feet:
/// s + (t.A t + s K t.t) / (2 (1 + s kappa + s^2 K)), times the sign of their side.
///
/// They are kept to what is possible: a foot is a point of the surface, and no point of the surface
/// is farther than some 0.87 voxel from one of those known, so that with curvatures up to one a
/// voxel the distance d and r = |x - y| satisfy  r^2 - (1 + r) 0.87^2 <= d^2 <= r^2.
/// @param[in]  sign    -1 for voxels inside, else 1
/// @param[out] aside2  |t|^2: squared distances of the voxels from the normals through their feet
void distances(const FootPoints& feet, const FootPoints::Lanes* x, const float* sign, float* d,
               float* aside2);

} // namespace molsurf
