// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Two surfaces side by side, whatever they were made from.

#include "molsurf/analysis/proximity/deviation.h"
#include "molsurf/analysis/proximity/distance.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/surface.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// One of the two, ready to be compared.
struct Operand {
    std::string kind; ///< "structure", "level set" or "mesh"
    Surface surface;
    openvdb::FloatGrid::Ptr levelSet; ///< null for a mesh
    double voxel = 0.0;               ///< of the level set [Å]; 0 for a mesh
    std::size_t atoms = 0;            ///< 0 unless it is a structure
    Size size;
    std::vector<std::string> warnings; ///< one line each
};

/// A stored surface: the zero set of its grid `spline` if it has one, else of the spline through
/// its level set, which is the grid `surface` or the only one. Any position and rotation of the
/// grid will do; voxels must be cubes.
///
/// The spline takes the level set's own values in its band. Voxels that the band lacks up to 4.5
/// voxels on either side, which the spline needs, get the distance from the zero set.
///
/// A grid `spline` whose signs are not those of the level set is left out, with a warning.
///
/// @throws Error(ErrorKind::Input) if there is no such grid or more than one of its name, if it is
///         empty, not in world units of cubes or beyond 1e6 Å, or has no zero
Operand operandOf(const openvdb::GridPtrVec& grids, const Progress& progress);

/// The same with the mesh in the frame of the grid, where its places have all their digits.
Operand storedOperand(const openvdb::GridPtrVec& grids, const Progress& progress);

/// Puts a mesh from the frame of a grid into the world.
void place(const Motion& pose, Mesh& mesh);

/// The spline through the band of a level set, whose values it takes; what it lacks is added as
/// above. Without coefficients if there is no zero.
Spline splineThrough(const openvdb::FloatGrid& levelSet, const Progress& progress);

/// The surface that makeSurface() made; its options must ask for the field "spline".
Operand operandOf(MolecularSurface&& result);

/// A mesh as it is. One whose volume is negative is turned inside out, with a warning; so is one
/// that is open mentioned, whose volume and inside are not defined.
/// @param[in] mesh  with at least one triangle; normals are made if there are none
Operand operandOf(Mesh mesh, const Progress& progress);

/// The level set of a closed mesh, for a grid to show distances on: by OpenVDB, band of 3 voxels.
/// @throws Error(ErrorKind::Input) if the mesh is not closed
openvdb::FloatGrid::Ptr levelSetOf(const Surface& surface, double voxel);

/// @param[in] progress  gets the stage "distance"
Comparison compare(const Operand& a, const DistanceTo& toA, const Operand& b, const DistanceTo& toB,
                   Progress& progress);

} // namespace molsurf
