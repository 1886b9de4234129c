// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A triangle mesh with named attributes at its vertices.

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// One value a vertex, under the name that mesh files use for it.
template<typename T>
struct Attribute {
    std::string name;      ///< for example "mean_curvature"
    std::vector<T> values; ///< as many as the mesh has vertices
};

/// Consecutive triangles with a name.
struct MeshPart {
    std::string name;
    std::size_t firstTriangle = 0;
};

/// Triangles, counter-clockwise seen from outside the molecule.
struct Mesh {
    std::vector<openvdb::Vec3f> positions;               ///< [Å]
    std::vector<openvdb::Vec3f> normals;                 ///< unit, outward; as many as positions
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into positions
    std::vector<Attribute<float>> scalars;       ///< curvatures [1/Å], [1/Å^2], distances [Å]
    std::vector<Attribute<std::int32_t>> labels; ///< atom, chain and group of a vertex
    std::vector<std::array<std::uint8_t, 3>>
        colors;                  ///< red, green, blue of a vertex (sRGB); empty if there are none
    std::vector<MeshPart> parts; ///< surfaces of their own; empty if there is one only
};

} // namespace molsurf
