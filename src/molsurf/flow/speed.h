// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// One step of the flow at the voxels of a leaf.

#include "molsurf/flow/metric.h"
#include "molsurf/levelset/curvature.h"

namespace molsurf
{

/// The flow acts at voxels that are less than this from the interface [voxel].
constexpr double flowWidthVox = 2.25;

/// Sums over the voxels of the interface that one step of the flow accumulates.
struct StepSums {
    double energy = 0.0;       ///< integral of w over the interface [Å^2]
    double area = 0.0;         ///< of the interface [Å^2]
    double volume = 0.0;       ///< integral of x.n/3 over the interface [Å^3]
    double displacement = 0.0; ///< integral of |displacement| over the interface [Å^3]
    float maxSpeed = 0.0f;     ///< largest |F| within a voxel of the interface [1/Å]
    float maxSecond = 0.0f; ///< largest stiffness P there [1/Å^2], without the cap of the movement
    std::size_t unresolvedGaps = 0; ///< voxels there at gaps that the grid does not resolve: two
                                    ///< pieces of the interface meet within the stencil

    StepSums& operator+=(const StepSums& other);
};

/// How far a step goes: the preconditioned flow divides the speed by the stiffness of each voxel,
/// the plain one multiplies it by the same time step everywhere.
struct StepSize {
    bool preconditioned = true;
    float time = 0.0f; ///< of the plain flow [Å^2]
};

/// New values of the 512 voxels of a leaf, and the sums before the step.
///
/// @param[in]  phi, psi   the leaf and its rim
/// @param[in]  shape      curvature() of phi at the active voxels
/// @param[in]  active     where the flow acts: voxels of the band within flowWidthVox
/// @param[in]  corner     position of the leaf's first voxel [Å]
/// @param[in]  voxel      voxel edge h [Å]
/// @param[out] next       phi after the step [Å]
StepSums flowStep(const LeafBlock<float, 1>& phi, const LeafBlock<float, 1>& psi,
                  const LeafCurvature& shape, const LeafMask& active, const openvdb::Vec3d& corner,
                  float voxel, const Weights& weights, const StepSize& size, float* next);

} // namespace molsurf
