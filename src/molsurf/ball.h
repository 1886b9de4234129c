// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The only thing the numerical stages know of a molecule.

#include <openvdb/Types.h>

#include <cstdint>

namespace molsurf
{

/// An atom, or a bead that stands for several, as a ball.
struct Ball {
    openvdb::Vec3f center; ///< [Å]
    float radius;          ///< van der Waals radius [Å], > 0
    std::int32_t atom;     ///< index of the atom in the structure it came from
};

/// How the Gaussian of a ball falls off: its term is exp(level - rate (|x - x_i|^2 - R_i^2)).
struct Decay {
    float rate = 0.0f;  ///< C [1/Å^2]; 0: by the tolerance of the run
    float level = 0.0f; ///< > 0 swells the ball, < 0 shrinks it
};

} // namespace molsurf
