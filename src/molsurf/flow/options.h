// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Options of the variational flow.

namespace molsurf
{

/// The term that lambda weighs in the energy density  w = g^2 + lambda h  (the paper's
/// equations 2.6 and 2.7): h = |grad g|^2 or h = 1.
enum class Regularizer { Gradient, Area };

/// How the speed is scaled: by the paper's own time step, or by an approximate second derivative of
/// the energy (docs/math.md, section 4).
enum class Flow { Preconditioned, Plain };

/// Options of evolve().
struct EvolveOptions {
    double lambda = 0.01; ///< weight of the regulariser; [Å^2] for Gradient, no unit for Area; >= 0
    Regularizer regularizer = Regularizer::Gradient;
    Flow flow = Flow::Preconditioned;
    int maxSteps = -1; ///< < 0: 50 for the preconditioned flow, fewer where it stalls; 2000 for the
                       ///< plain one
    int steps = -1;    ///< >= 0: so many, whether it has converged or not
    int splineLevel =
        0; ///< curvature by the spline on voxels of edge 2^level h; 0: on h, by differences
    double energyTolerance = 1e-4;       ///< relative change of the energy in a step
    double displacementTolerance = 0.01; ///< area-weighted mean displacement in a step [voxel]
};

} // namespace molsurf
