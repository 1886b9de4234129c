// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The parts of a mesh as ranges of its vertices and triangles.

#include "molsurf/mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// Vertices and triangles of one part.
struct PartRange {
    std::string name;
    std::size_t firstVertex, vertexEnd, firstTriangle, triangleEnd;
};

/// The parts that have triangles, of which each one's vertices are neighbours in the list; the
/// whole mesh under the name if it has no parts.
std::vector<PartRange> partRanges(const Mesh& mesh, const std::string& name);

/// Appends a part of a mesh as a part of another, with the values and labels that the other has.
void appendPart(const Mesh& mesh, const PartRange& range, Mesh& out);

/// What a mesh has at its vertices: one of its scalars, or a vector, of three in turn that are
/// named NAME_x, NAME_y and NAME_z.
struct VertexField {
    std::string name;
    const Attribute<float>* components; ///< the first of them
    std::size_t count;                  ///< 1 or 3
};

/// All of them, in the order of Mesh::scalars.
std::vector<VertexField> vertexFields(const Mesh& mesh);

} // namespace molsurf
