// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Removes pieces of a mesh that the voxels cannot hold.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace molsurf
{

/// The volume that a closed piece has at least [voxel]. A piece with less is no larger than the
/// error of the level set: it comes and goes with the place of the grid.
constexpr double leastPiece = 0.1;

/// Removes the closed pieces that enclose less than `leastPiece` voxels from a mesh, and from the
/// level set that it was made of, where the voxels that they enclose change their signs.
/// @param[in,out] pieces   those of the mesh
/// @param[in,out] surface  the level set
/// @return the vertices that stay, as indices of before, ascending; nothing if all do
std::optional<std::vector<std::uint32_t>> dropSpecks(MeshPieces& pieces,
                                                     openvdb::FloatGrid& surface, Mesh& mesh);

/// Tells, without a mesh, that dropSpecks() would find nothing to remove, and that the mesh has
/// more than a few triangles. Every connected set of voxels of one sign then has a voxel that lies
/// deeper than 0.6 voxels: a ball of that radius, of nine times the volume of `leastPiece`.
/// @param[in] S  signed distance, on all voxels within two of S = 0
/// @return false where that cannot be told
bool isClearOfSpecks(const SparseField& S, const Progress& progress);

/// Removes closed pieces from a mesh, with what its attributes, colours and parts say of them.
/// @param[in]     pieces  those of the mesh
/// @param[in]     gone    whether a piece goes
/// @return the vertices that stay, as indices of before, ascending
std::vector<std::uint32_t> removePieces(const MeshPieces& pieces, const std::vector<char>& gone,
                                        Mesh& mesh);

/// Makes an array over vertices one of those that stay.
template<typename T>
void keepVertices(const std::vector<std::uint32_t>& kept, std::vector<T>& values)
{
    std::size_t count = 0;
    for (const std::uint32_t v : kept)
        if (v < values.size()) values[count++] = values[v];
    values.resize(count);
}

} // namespace molsurf
