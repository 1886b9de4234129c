// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Shapes that rays meet, without Embree.

#include "molsurf/mesh.h"

#include <openvdb/openvdb.h>

#include <array>
#include <vector>

namespace molsurf
{

/// Shapes that copies repeat together. Balls and sticks are round, not of triangles.
struct RayUnit {
    enum Kind : unsigned { Triangles, Balls, Sticks }; ///< the numbers that a hit has

    std::vector<openvdb::Vec4f> balls;                 ///< x, y, z and radius [Å]
    std::vector<std::array<openvdb::Vec4f, 2>> sticks; ///< the same of both ends
    Mesh mesh;

    /// Whether there is nothing in it.
    bool empty() const { return balls.empty() && sticks.empty() && mesh.triangles.empty(); }
};

} // namespace molsurf
