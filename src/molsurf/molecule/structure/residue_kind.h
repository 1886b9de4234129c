// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Decides what each residue of a structure is.

#include "molsurf/molecule/structure/structure.h"

#include <string_view>

namespace molsurf
{

/// Sets Residue::kind of all residues, and Atom::role of the particles that are no atoms. It asks
/// the same of every format, in this order:
/// 1. particles: names such as EP and LP, marks of pockets and channels, a name D* next to the atom
///    * (Drude), neither oxygen nor hydrogen in water, names with M or Q in amino acids;
/// 2. names, which the elements have to agree with: an ion is an atom alone, water one oxygen, a
///    nucleotide has a sugar or a phosphate;
/// 3. elements where the name is unknown: a metal or a halogen alone is an ion, one oxygen and two
///    hydrogens are water, five carbons and an oxygen in a ring a sugar;
/// 4. bonds: what a peptide bond or a phosphodiester joins to its neighbour is a link of the chain;
/// 5. records: the entities of mmCIF, which do not make links of sugars, then HETATM, which makes
///    an amino acid or a nucleotide without neighbours a ligand. TER is not asked.
/// Residues that a reader has marked as beads stay so; those without a name in a file of radii
/// become beads.
void classifyResidues(Structure& structure);

/// "protein", "water", "ion", ...: the word of a kind in selections and in the text of `info`.
std::string_view kindWord(ResidueKind kind);

/// True for metals and halogens: an atom of them alone is an ion.
bool isIonic(std::uint8_t element);

} // namespace molsurf
