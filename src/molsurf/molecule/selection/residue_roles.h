// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Tells the molecule in a file from what lies beside it: free ions, buffers, lipids of a box.

#include "molsurf/molecule/structure/structure.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Role of a residue in the molecule.
enum class Role : std::uint8_t {
    Molecule, ///< a part of it: a polymer, or a ligand or an ion that touches one
    FreeIon,  ///< an ion that belongs to the solution
    Buffer,   ///< a buffer, salt, solvent or cryoprotectant
    Lipid,    ///< a lipid or detergent
    Apart     ///< a ligand or sugar that touches no polymer, nor a ligand that does
};

/// The role of each residue of a model. A ligand is a part of the molecule if one of its atoms lies
/// within 4 Å of a polymer, or of such a ligand; so is an ion within 3 Å, but for those of Li, Na,
/// K, Rb, Cs, F, Cl, Br and I. Water is not looked at, nor are particles that are no atoms.
///
/// With an assembly all of its copies are looked at, and not the coordinates of the file: a ligand
/// that touches in one copy is a part of the molecule in all. What the assembly does not list is
/// `Molecule`.
///
/// Where there is no polymer, and in files of beads or with radii of their own, which somebody has
/// prepared, all is the molecule.
/// @param[in] assembly  nullptr: none
/// @return one a residue of the structure; those of other models are `Molecule`
std::vector<Role> rolesIn(const Structure& structure, const Model& model,
                          const Assembly* assembly = nullptr);

} // namespace molsurf
