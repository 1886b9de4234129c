// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "molsurf/mesh.h"
#include "molsurf/show/color/color_map.h"

#include <cmath>

namespace molsurf::test
{

/// Adds a ball of triangles to a mesh.
inline void addBall(Mesh& mesh, const openvdb::Vec3f& center, float radius, const Color& color)
{
    constexpr int rings = 40, sides = 80;
    const auto first = std::uint32_t(mesh.positions.size());
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j < sides; ++j) {
            const double a = M_PI * i / rings, b = 2.0 * M_PI * j / sides;
            const openvdb::Vec3f n(float(std::sin(a) * std::cos(b)),
                                   float(std::sin(a) * std::sin(b)), float(std::cos(a)));
            mesh.positions.push_back(center + radius * n);
            mesh.normals.push_back(n);
            mesh.colors.push_back(color);
        }
    }
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sides; ++j) {
            const auto at = [&](int ring, int side) {
                return first + std::uint32_t(ring * sides + side % sides);
            };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
}

} // namespace molsurf::test
