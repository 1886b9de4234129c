// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Copies of the parts of a mesh.

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace molsurf
{

/// A copy of a part of a mesh: x -> rotation x + translation.
struct MeshInstance {
    std::size_t part = 0; ///< index of its range, see partRanges()
    std::string name;
    std::array<std::array<double, 3>, 3> rotation; ///< rows
    openvdb::Vec3d translation;                    ///< [Å]
    std::array<std::uint8_t, 3> color; ///< red, green, blue (sRGB); multiplies those of vertices

    openvdb::Vec3d turned(const openvdb::Vec3d& x) const
    {
        const auto& r = rotation;
        return {r[0][0] * x[0] + r[0][1] * x[1] + r[0][2] * x[2],
                r[1][0] * x[0] + r[1][1] * x[1] + r[1][2] * x[2],
                r[2][0] * x[0] + r[2][1] * x[1] + r[2][2] * x[2]};
    }
    openvdb::Vec3d placed(const openvdb::Vec3d& x) const { return turned(x) + translation; }
};

} // namespace molsurf
