// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Removes pieces of a mesh that the voxels cannot hold.

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

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
/// @return whether a vertex of before stays; nothing if all do
std::optional<std::vector<char>> dropSpecks(MeshPieces& pieces, openvdb::FloatGrid& surface,
                                            Mesh& mesh);

/// Tells, without a mesh, that dropSpecks() would find nothing to remove, and that the mesh has
/// more than a few triangles. Every connected set of voxels of one sign then has a voxel that lies
/// deeper than 0.6 voxels: a ball of that radius, of nine times the volume of `leastPiece`.
/// @param[in] S  signed distance, on all voxels within two of S = 0
/// @return false where that cannot be told
bool isClearOfSpecks(const SparseField& S, const Progress& progress);

/// Removes closed pieces from a mesh, with what its attributes, colours and parts say of them.
/// @param[in]     pieces  those of the mesh
/// @param[in]     gone    whether a piece goes
/// @return whether a vertex of before stays
std::vector<char> removePieces(const MeshPieces& pieces, const std::vector<char>& gone, Mesh& mesh);

/// Makes an array over vertices, which may be empty, one of those that stay.
template<typename T>
void keepVertices(const std::vector<char>& stays, std::vector<T>& values)
{
    parallelKeep(values, Progress(), [&](std::size_t v) { return stays[v]; });
}

} // namespace molsurf
