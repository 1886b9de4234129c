// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The elements of atoms in files that do not name them.

#include "molsurf/molecule/structure/structure.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace molsurf
{

/// Evidence for the element of an atom.
struct ElementEvidence {
    std::string_view atom, residue; ///< names
    double mass = -1.0;             ///< [u]; < 0: unknown
    bool inFirstColumn = false;     ///< whether the name begins in column 13 of a PDB file whose
                                    ///< other names are placed by their elements
};

/// Finds the atomic number of an atom; of a name without letters by its mass. It asks, in order:
/// 1. names of ions, amino acids, nucleotides, waters and hemes: "SOD" of SOD is sodium, "CA" of
///    HSD carbon, "NA" of HEME nitrogen;
/// 2. the mass, if it is that of an element to 0.1 % (a CH2 group is 0.14 % heavier than nitrogen),
///    and if the name does not begin with another common one, as where hydrogens have mass of the
///    atoms next to them;
/// 3. two letters, if no other reading is common: "CL1", "BR2", "FE", "ZN", "Cu1";
/// 4. the first letter;
/// 5. two letters, where the first names no element: "ZND" is zinc.
/// @return 0 if nothing fits
std::uint8_t guessElement(const ElementEvidence& evidence);

/// The same of the names alone.
std::uint8_t guessElement(const std::string& atomName, const std::string& residueName);

/// Whether the element that a file gives an atom cannot be: an alpha carbon is no calcium.
bool isMisread(std::uint8_t element, std::string_view atom, std::string_view residue);

/// The element of a type of atoms in a .mol2 file, if it is one of GAFF, Amber or CHARMM's CGenFF:
/// "ca" is carbon, "os" oxygen, "cl" chlorine. 0: it is none of them.
std::uint8_t elementOfForceFieldType(std::string_view type);

/// The element of a type of AutoDock: "A" is carbon, "OA" oxygen, "HD" hydrogen, "NA" nitrogen, but
/// "Na" sodium; 0 if there is none.
std::uint8_t elementOfAutoDockType(std::string_view type);

/// True for what files write in the place of an element of a particle that is no atom: "EP", "VS",
/// "LP", and "Bq" of a ghost.
bool isParticleSymbol(std::string_view symbol);

/// True for what programs write into structures to mark pockets, channels and probes: "APOL" of
/// STP, "QSS".
bool isMark(std::string_view residue, std::string_view atom);

/// True for names of particles that are no atoms, in any residue: "EP1", "LPA", "EPW".
bool isParticleName(std::string_view atom);

} // namespace molsurf
