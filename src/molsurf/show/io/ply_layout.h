// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The records of a binary PLY file.

#include "molsurf/mesh.h"
#include "molsurf/show/io/output_buffer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// The fields of a vertex record behind position and normal, in this order.
struct PlyLayout {
    std::vector<std::string> scalars; ///< floats
    std::vector<std::string> labels;  ///< 32-bit integers
    bool colors = false;              ///< three bytes

    std::size_t vertexSize() const
    {
        return 24 + 4 * (scalars.size() + labels.size()) + (colors ? 3 : 0);
    }
};

PlyLayout layoutOf(const Mesh& mesh);

/// @throws Error(ErrorKind::Output) if its indices cannot count the vertices
std::string plyHeader(const PlyLayout& layout, std::size_t vertices, std::size_t triangles,
                      const std::vector<std::string>& comments = {});

/// Writes the record of vertex n, vertexSize() bytes.
void encodeVertex(const Mesh& mesh, std::size_t n, char* to);

/// Writes the record of a triangle, 13 bytes.
void encodeTriangle(const std::array<std::uint32_t, 3>& triangle, char* to);

} // namespace molsurf
