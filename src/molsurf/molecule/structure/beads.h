// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Coarse-grained files: Martini beads, whose names are not elements.

#include "molsurf/molecule/structure/structure.h"

namespace molsurf
{

/// Finds out whether the atoms of a structure are beads and sets Structure::beads. Martini beads
/// lose their element, and those that are waters (W, WF, SW, TW, PW) are marked as such. The
/// charges of polarizable beads (SCP, SCN, WP, WM) and the sites of a Go model, which lie where BB
/// lies, become AtomRole::Particle. The first model decides, by these criteria.
///
/// Martini: at least 9 of 10 atoms have names of Martini beads (BB, SC1, W, NC3, PO4, GL1, C1A,
/// D2A, ROH, R1, NA, ...), and one of them a name that no atom has (BB, SC1, W, PO4, GL1, ...). It
/// is Martini 3 unless a residue has the beads of Martini 2 (alanine without side chain, tyrosine
/// without SC4, tryptophan without SC5).
///
/// Unnamed: all residues but waters are amino acids with CA and without N and C, at least one of
/// them with a side chain, and no two beads of a residue are closer than 1.9 Å, which bonded atoms
/// always are. Such files name each bead by an atom of it.
void markBeads(Structure& structure);

} // namespace molsurf
