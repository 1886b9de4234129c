// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Topology of a mesh: neighbours, connected pieces, and whether it is closed.

#include "molsurf/kernel/mesh/vertex_set.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The triangles that meet at each vertex. Those of vertex v are
/// triangles[begins[v]], ..., triangles[begins[v + 1] - 1], in ascending order.
struct VertexTriangles {
    std::vector<std::uint32_t> begins;
    std::vector<std::uint32_t> triangles;
};

VertexTriangles vertexTriangles(const Mesh& mesh);

/// The same of some vertices alone: those of vertex v begin at begins[some.place(v)].
VertexTriangles vertexTriangles(const Mesh& mesh, const VertexSet& some, const Progress& progress);

/// The corners of all triangles at some vertices: these and their neighbours.
VertexSet withNeighbours(const Mesh& mesh, const VertexSet& some, const Progress& progress);

/// The properties of a mesh as a surface.
struct Topology {
    bool closed = true;   ///< every edge belongs to exactly two triangles
    bool oriented = true; ///< and these run through it in opposite directions
    bool manifold = true; ///< and the triangles about each vertex form one fan
};

/// Checks every edge and every vertex.
Topology checkTopology(const Mesh& mesh, const Progress& progress);

/// The same of some vertices and the edges at them.
/// @param[in] wanted  of each vertex, whether to check it
Topology checkTopology(const Mesh& mesh, const std::vector<char>& wanted, const Progress& progress);

/// The connected piece of each vertex: numbers from 0 in the order of the pieces' first vertices.
/// @param[out] count  number of pieces
std::vector<std::uint32_t> connectedPieces(const Mesh& mesh, std::size_t& count,
                                           const Progress& progress);

/// The volume inside the triangles of each piece [Å^3]; < 0 for the wall of a cavity.
std::vector<double> pieceVolumes(const Mesh& mesh, const std::vector<std::uint32_t>& pieces,
                                 std::size_t count);

/// Gives every fan of triangles about a vertex a vertex of its own, after pairing the triangles at
/// edges that more than two share. Makes any closed, oriented mesh 2-manifold without moving a
/// point. What happens at a vertex depends on the triangles about it and their order alone.
/// @return for each vertex added, in order, the one that it was split from
std::vector<std::uint32_t> splitNonManifold(Mesh& mesh);

} // namespace molsurf
