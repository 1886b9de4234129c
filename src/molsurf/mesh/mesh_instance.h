// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Copies of the parts of a mesh.

#include "molsurf/atoms.h"

#include <array>
#include <cstdint>

namespace molsurf
{

/// A copy of a part of a mesh, see partRanges().
struct MeshInstance : Instance {
    std::array<std::uint8_t, 3> color; ///< red, green, blue (sRGB); multiplies those of vertices
};

} // namespace molsurf
