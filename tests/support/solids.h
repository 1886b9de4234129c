// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Meshes of few triangles.

#include "molsurf/mesh.h"

namespace molsurf::test
{

/// A closed box with its corners shared, oriented outward.
inline Mesh box(const openvdb::Vec3f& low, const openvdb::Vec3f& high)
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 4 ? high[0] : low[0], i & 2 ? high[1] : low[1],
                                    i & 1 ? high[2] : low[2]);
    const std::uint32_t quads[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                       {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

} // namespace molsurf::test
