// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Molecules of CIF files without _atom_site of mmCIF: components of dictionaries, and crystals of
/// small molecules.

#include "molsurf/molecule/structure/structure.h"

#include <gemmi/cifdoc.hpp>

#include <string>

namespace molsurf
{

/// True if a block has the atoms of a component or of a crystal.
bool hasSmallMolecule(const gemmi::cif::Block& block);

/// Reads a component of the Chemical Component Dictionary or of a library of monomers, with its
/// ideal coordinates or else those of a model, or the asymmetric unit of a crystal.
/// @throws Error(ErrorKind::Input) if the atoms have no coordinates
Structure readSmallMolecule(gemmi::cif::Block& block, const std::string& path);

} // namespace molsurf
