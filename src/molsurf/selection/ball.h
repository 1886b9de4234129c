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

} // namespace molsurf
