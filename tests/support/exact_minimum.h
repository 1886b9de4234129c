// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Surfaces of least energy, computed without a level set: the ball about one atom, and the
/// surface of revolution about atoms on a line.

#include "molsurf/options.h"

#include <openvdb/Types.h>

#include <functional>
#include <vector>

namespace molsurf::test
{

/// What the energy of a molecule depends on.
struct Energy {
    double epsilon = 0.5; ///< [Å]
    double lambda = 0.01;
    Regularizer regularizer = Regularizer::Gradient;
};

/// The radius at which r^2 w(r) has its local minimum near R, one atom with R = radius + probe, by
/// root finding on the derivative.
double minimalRadius(double R, const Energy& energy);

/// An atom on the axis of revolution.
struct AxisBall {
    double z; ///< [Å]
    double R; ///< radius plus probe [Å]
};

/// A curve rho(theta) in the half plane about the origin, theta from the axis, at equidistant
/// nodes from 0 to pi.
struct PolarCurve {
    std::vector<double> rho;
    bool stationary = false; ///< the method met its tolerance

    double at(double theta) const;
};

/// The curve whose surface of revolution makes the energy stationary, by Newton's method
/// (Levenberg's form) on the integral of 2 pi rho sin(theta) w sqrt(rho^2 + rho'^2), midpoint rule:
/// second order in the step. It starts from psi = 0, which must be star-shaped about the origin.
PolarCurve minimalCurve(const std::vector<AxisBall>& balls, const Energy& energy, int elements);

} // namespace molsurf::test
