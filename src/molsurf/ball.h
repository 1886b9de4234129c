// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Balls: all that the kernel knows of a molecule.

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// A ball that stands for an atom, or for a bead of several atoms.
struct Ball {
    openvdb::Vec3d center; ///< position of the centre [Å]
    double radius;         ///< van der Waals radius [Å], > 0
    std::int32_t atom;     ///< index of the atom in the structure it came from
};

/// The fall-off of a ball's Gaussian, whose term in the sum is
/// exp(level - rate (|x - x_i|^2 - R_i^2)) with the ball's centre x_i and R_i, its radius plus that
/// of the probe. docs/math.md, section 2.
struct Decay {
    float rate = 0.0f;  ///< C [1/Å^2], >= 0; 0: the rate that the options of the run give
    float level = 0.0f; ///< no unit; above 0 swells the ball, below 0 shrinks it
};

/// The balls of a molecule: all that the kernel knows of it.
struct BallModel {
    std::vector<Ball> balls;
    std::vector<Decay> decays; ///< one a ball; empty: the options give one for all
};

} // namespace molsurf
