// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Values at the interface that every step of the flow needs: its speed at the foot of each voxel,
/// and sums over it. docs/math.md, section 4.

#include "molsurf/kernel/flow/metric.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/kernel/levelset/curvature.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/progress.h"

#include <cstddef>

namespace molsurf
{

/// Sums over the voxels of the interface that one step of the flow accumulates.
struct InterfaceSums {
    double energy = 0.0;            ///< integral of w over the interface [Å^2]
    double area = 0.0;              ///< of the interface [Å^2]
    double volume = 0.0;            ///< integral of x.n/3 over the interface [Å^3]
    float maxSpeed = 0.0f;          ///< largest |F| within a voxel of the interface [1/Å]
    std::size_t unresolvedGaps = 0; ///< voxels there at gaps that the grid does not resolve: two
                                    ///< pieces of the interface meet within the stencil

    InterfaceSums& operator+=(const InterfaceSums& other);
};

/// The voxel that positions in these sums are taken from: near the molecule, so that volumes do not
/// cancel far from the origin.
openvdb::Coord sumOrigin(const LeafTable& table, const Region& region);

/// The sums of a leaf by their place in the row.
struct InterfaceRows {
    alignas(64) float area[8] = {};      // delta(phi) |grad phi| h^3: the weight [Å^2]
    alignas(64) float energy[8] = {};    // weighted metric
    alignas(64) float normal[3][8] = {}; // weighted normal
    alignas(64) float along[8] = {};     // weighted n.(x - phi n), x from the leaf's first voxel
    alignas(64) float speed[8] = {};     // largest F [1/Å]
    alignas(64) float unresolvedGaps[8] = {};

    /// @param[in] corner  position of the leaf's first voxel [Å]
    InterfaceSums total(const openvdb::Vec3d& corner) const;
};

/// The metric and the shape of the interface at the foot of a voxel.
struct Front {
    Metric metric;
    float kappa;  ///< k1 + k2 [1/Å]
    float gauss;  ///< k1 k2 [1/Å^2]
    float energy; ///< w, without values that none has at rest: they come from feet in gaps
    float speed;  ///< F = w kappa + n . grad w: the interface moves by -F n [1/Å]
};

/// @param[in] psi    the voxel in a LeafBlock<float, 1>
/// @param[in] shape  curvature() of phi; v: the voxel in it
/// @param[in] phi    distance of the voxel from the interface [Å]
/// @param[in] inverse  1/h
MOLSURF_INLINE Front frontAt(const float* psi, const LeafCurvature& shape, int v, float phi,
                             float inverse, const Weights& weights)
{
    Front front;
    front.metric = metricAtFoot(*psi, derivatives<1>(psi, inverse), shape.normal[0][v],
                                shape.normal[1][v], shape.normal[2][v], phi, weights);
    // Principal curvatures k at the voxel are k/(1 - k phi) at the foot. The denominator is kept
    // positive where the level set is not resolved.
    const float k = clamped(shape.mean[v], -2.0f * inverse, 2.0f * inverse);
    const float K = clamped(shape.gauss[v], -inverse * inverse, 0.25f * k * k);
    const float denominator = larger(1.0f - k * phi + K * phi * phi, 0.2f);
    front.kappa = (k - 2.0f * K * phi) / denominator;
    front.gauss = K / denominator;
    front.speed = front.metric.w * front.kappa + front.metric.normal;
    front.energy = smaller(front.metric.w, 10.0f * (1.0f + weights.area));
    return front;
}

/// Takes the curvatures of a leaf's voxels from a spline.
void takeCurvature(const Spline& spline, const openvdb::Coord& origin, double voxelSize,
                   const LeafMask& active, LeafCurvature& shape);

/// The spline of a level set on voxels of edge 2^level h, on a band wide enough for it.
Spline splineOf(const SparseField& phi, int level, const Progress& progress);

/// cos(pi t) for |t| <= 1, error below 2e-5: 1 - 2 sin^2(pi t/2) by Taylor.
MOLSURF_INLINE float cosPi(float t)
{
    const float x = 1.57079633f * t, x2 = x * x;
    const float s =
        x * (1.0f + x2 * (-1.0f / 6.0f +
                          x2 * (1.0f / 120.0f + x2 * (-1.0f / 5040.0f + x2 * (1.0f / 362880.0f)))));
    return 1.0f - 2.0f * s * s;
}

/// Adds a voxel to the sums, by a delta of half width 1.5 h.
/// @param[in] row       the voxel's row of the leaf; z: its place there
/// @param[in] phi       the level set there [Å]
/// @param[in] distance  of the voxel from the interface [Å]
/// @param[in] on        1, or 0 for a voxel that does not count
MOLSURF_INLINE void addVoxel(const Front& front, const LeafCurvature& shape, int row, int z,
                             float phi, float distance, float h, float on, InterfaceRows& sums)
{
    const int v = 8 * row + z;
    const float inverse = 1.0f / h, off = std::abs(phi) * inverse;
    const float nx = shape.normal[0][v], ny = shape.normal[1][v], nz = shape.normal[2][v];
    const float u = smaller(off / 1.5f, 1.0f);
    const float delta = (1.0f + cosPi(u)) * (inverse / 3.0f) * shape.slope[v];
    const float near = u < 1.0f ? on : 0.0f, close = off < 1.0f ? on : 0.0f;
    const float weight = near * h * h * h * delta;
    const float along = h * (float(row / 8) * nx + float(row % 8) * ny + float(z) * nz) - distance;
    sums.area[z] += weight;
    sums.energy[z] += weight * front.energy;
    sums.normal[0][z] += weight * nx;
    sums.normal[1][z] += weight * ny;
    sums.normal[2][z] += weight * nz;
    sums.along[z] += weight * along;
    sums.speed[z] = larger(sums.speed[z], close * std::abs(front.speed));
    sums.unresolvedGaps[z] += shape.slope[v] < 0.5f ? close : 0.0f;
}

} // namespace molsurf
