// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The result of a brick: its part of the grids and of the mesh, and what adds up over bricks.

#include "molsurf/kernel/flow/displacement.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Identifies a vertex across bricks: the cell in which the mesher had put it, and its number among
/// those of the cell. Bricks from machines that round differently fit all the same.
using VertexKey = std::array<std::int32_t, 4>;

/// A vertex at the border of a brick.
struct BorderVertex {
    VertexKey key;
    std::uint32_t vertex; ///< index in the brick's mesh
    std::uint32_t piece;  ///< connected piece of the brick's triangles
};

/// An edge that has more triangles on one side than on the other, within the brick.
struct OpenEdge {
    std::uint32_t from, to; ///< border vertices
    std::int32_t surplus;   ///< triangles that run from `from` to `to` less those back
};

/// The triangles that a brick owns, with their vertices.
struct BrickMesh {
    Mesh mesh;                ///< the owned vertices first, then those of other bricks
    std::size_t owned = 0;    ///< number of owned vertices
    std::vector<float> areas; ///< of the owned vertices: a third of all triangles about them [Å^2]
    std::vector<BorderVertex> border;
    std::vector<OpenEdge> openEdges;
    std::vector<PieceMeasure> pieces;    ///< of the owned triangles
    std::size_t flat = 0;                ///< owned triangles without area
    bool closed = true, manifold = true; ///< at the owned vertices
};

/// Sums over bricks.
struct BrickSums {
    std::optional<EvolutionReport> evolution; ///< sums over the owned voxels, step by step
    Displacements displacements;              ///< of the last step, at the owned voxels
    double maxResidual = 0.0;                 ///< largest |S| at a vertex [Å]
    std::size_t kinkVertices = 0; ///< owned vertices within two voxels of a kink of the distance
    std::size_t unitVertices = 0; ///< the others with | |grad S| - 1 | < 0.03
    std::vector<Report::Group> groups; ///< areas of the owned triangles, at last those of no group
    std::vector<std::pair<std::string, double>> seconds; ///< stage, wall seconds
};

/// The result of a brick. Without any surface in it, grids have no leaves and the mesh no
/// triangles.
struct Brick : BrickSums {
    BrickMesh mesh;
    std::vector<openvdb::GridBase::Ptr> grids; ///< the owned leaves; `surface` first
};

/// Cuts a mesh that reaches beyond a brick. A vertex belongs to the brick of the cell in which the
/// mesher had put it, a triangle to the brick of the voxel whose edge it was made for. Pinched
/// vertices are split first, as in a mesh of the whole.
///
/// @param[in]  mesh    with normals
/// @param[in]  cells   in which the mesher had put the vertices
/// @param[in]  box     the voxels that the brick owns
/// @param[in]  anchor  origin of the volumes [Å]
/// @param[out] sources for each vertex of the result its index in `mesh`
BrickMesh cutBrick(Mesh mesh, std::vector<openvdb::Coord> cells, const openvdb::CoordBBox& box,
                   const openvdb::Vec3d& anchor, std::vector<std::uint32_t>& sources,
                   const Progress& progress);

/// The edges between border vertices whose triangles are not paired.
/// @param[in] isBorder  of each vertex
std::vector<OpenEdge> openEdges(const Mesh& mesh, const std::vector<char>& isBorder,
                                const Progress& progress);

} // namespace molsurf
