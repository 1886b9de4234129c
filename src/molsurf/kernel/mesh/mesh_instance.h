// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Copies of the parts of a mesh.

#include "molsurf/ball.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace molsurf
{

/// A copy of a part of a mesh, see partRanges().
struct MeshInstance : Motion {
    std::size_t part = 0; ///< index of it
    std::string name;
    std::array<std::uint8_t, 3> color; ///< red, green, blue (sRGB); multiplies those of vertices
};

} // namespace molsurf
