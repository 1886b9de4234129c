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

/// A quantity that has a value at every vertex.
template<typename T>
struct Attribute {
    std::string name;                    ///< name in mesh files, for example "mean_curvature"
    std::vector<T> values;               ///< one for each vertex of the mesh
    std::vector<std::string> names = {}; ///< of what labels number, if the mesh alone knows them
};

/// A named part of a mesh: the triangles from its first one to that of the next part.
struct MeshPart {
    std::string name;
    std::size_t firstTriangle = 0; ///< index into Mesh::triangles
};

/// A mesh of triangles. Their corners run counter-clockwise if seen from outside the molecule.
struct Mesh {
    std::vector<openvdb::Vec3f> positions;               ///< of the vertices [Å]
    std::vector<openvdb::Vec3f> normals;                 ///< unit, outward; one a vertex, or none
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into `positions`
    std::vector<Attribute<float>> scalars;       ///< curvatures [1/Å], [1/Å^2], distances [Å]
    std::vector<Attribute<std::int32_t>> labels; ///< atom, chain and group of a vertex
    std::vector<std::array<std::uint8_t, 3>>
        colors;                  ///< red, green, blue (sRGB) of each vertex, or empty
    std::vector<MeshPart> parts; ///< surfaces of their own; empty if there is only one
};

} // namespace molsurf
