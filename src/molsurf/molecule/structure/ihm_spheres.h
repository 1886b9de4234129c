// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The spheres of integrative models: _ihm_sphere_obj_site of mmCIF, which stand for residues or
/// stretches of a chain.

#include "molsurf/molecule/structure/structure.h"

#include <gemmi/cifdoc.hpp>

#include <string>

namespace molsurf
{

/// True if a block has spheres.
bool hasSpheres(const gemmi::cif::Block& block);

/// Adds the spheres of a block to the atoms that it has: to the model of the same number, behind
/// its atoms. A sphere has its own radius, the name "5-14" of its stretch, and belongs to a residue
/// with the number of its first one, whose name it has if it stands for that alone.
///
/// @throws Error(ErrorKind::Input) if a column is missing or a radius is none
void addSpheres(gemmi::cif::Block& block, const std::string& path, Structure& structure);

} // namespace molsurf
