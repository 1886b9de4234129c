// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The mesh of a whole from that of a symmetric unit.

#include "molsurf/atoms.h"
#include "molsurf/surface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Puts the units of a whole together, in the order of Placement::instances.
///
/// @param[in] atoms    with a unit
/// @param[in] surface  of it
/// @param[in] unit     its mesh, or one with further vertices behind those of its mesh
/// @param[in] weld     whether vertices that units share become one: then the mesh is closed if the
///                     report says so; else each unit is a part of its own
/// @param[in] colors   one a unit; empty: the vertices keep theirs
/// @throws Error(ErrorKind::Check) if the welded mesh is not closed although the report says so
Mesh wholeMesh(const BallSet& atoms, const MolecularSurface& surface, const Mesh& unit, bool weld,
               const std::vector<std::array<std::uint8_t, 3>>& colors, const Progress& progress);

/// The parts of a mesh that a copy of an assembly repeats: of several prototypes its own, else all.
std::vector<std::size_t> partsOfCopy(const Placement& placement, const Mesh& mesh,
                                     const Instance& copy);

/// The mesh of a whole: that of a unit's rotations, welded, or of all copies of prototypes, each of
/// them a part.
/// @param[in] atoms    that are not the whole themselves
/// @param[in] surface  of the unit or the prototypes
Mesh meshOfWhole(const BallSet& atoms, const MolecularSurface& surface, const Progress& progress);

} // namespace molsurf
