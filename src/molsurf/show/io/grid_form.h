// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Gives the grids of a .vdb the form that another program takes.

#include <openvdb/openvdb.h>

namespace molsurf
{

/// The type that labels of voxels have in a file.
enum class IdType {
    Int,  ///< int32
    Float ///< for readers without int32, as Debian's pyopenvdb: one such grid closes them the file
};

/// Their words: int, float.
const char* nameOf(IdType type);

/// What is done to grids before they are written.
struct GridForm {
    IdType ids = IdType::Int;
    bool oneBox = false; ///< all have the box of active voxels that is about those of all
    bool half = false;   ///< floats are written with 16 bits
    int mips = 0;        ///< coarser levels of fogs and colours, in [0, 10]

    bool changes() const { return ids == IdType::Float || oneBox || half || mips > 0; }
};

/// Returns grids in a form. They themselves stay as they are; those that do not change share their
/// voxels with the result. Levels replace a fog `density` by `density_level_0`, `density_level_1`,
/// ..., each with voxels twice as large, as openvdb::tools::MultiResGrid makes and names them.
///
/// @param[in] grids  of one lattice
/// @throws Error(ErrorKind::Usage) if a label is above 2^24, up to which floats hold all
openvdb::GridCPtrVec formed(const openvdb::GridCPtrVec& grids, const GridForm& form);

/// Returns grids as they were before IdType::Float: those named `atom_id`, `chain_id`,
/// `group_id` or `pocket_id` that are floats are int32.
openvdb::GridPtrVec withIntLabels(const openvdb::GridPtrVec& grids);

} // namespace molsurf
