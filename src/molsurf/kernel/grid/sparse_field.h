// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A field on a leaf table that knows the size of its voxels, and its way from and to OpenVDB.

#include "molsurf/kernel/grid/leaf_table.h"

namespace molsurf
{

/// Numbers at the voxels of a sparse table. It can be moved, but copied by copied() only.
struct SparseField {
    LeafTable table;        ///< active voxels: where the field is known
    LeafField values;       ///< 512 a leaf of the table
    double voxelSize = 0.0; ///< edge of a voxel [Å]

    /// The values of the leaf with this index in the table.
    float* leaf(std::size_t n) { return values.leaf(n); }
    const float* leaf(std::size_t n) const { return values.leaf(n); }
};

/// Makes a second field with the same leaves, active voxels and values.
SparseField copied(const SparseField& field);

/// Drops the leaves of a field that lie outside a box of whole leaves.
SparseField clipped(SparseField field, const openvdb::CoordBBox& box, const Progress& progress);

/// Makes a level set grid of a field. Active values are copied; inactive ones become plus or minus
/// background, by the sign of the field in leaves and by flood fill elsewhere.
///
/// @param[in] halfWidth  background of the grid [Å], > 0; values are clamped to it
openvdb::FloatGrid::Ptr toLevelSet(const SparseField& field, double halfWidth,
                                   const Progress& progress);

/// Reads all leaves of a grid whose voxels are cubes: their values, active or not, and which of
/// them are active. Tiles of the tree are left out.
SparseField fromGrid(const openvdb::FloatGrid& grid);

} // namespace molsurf
