// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Beads that stand for several atoms.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// Reads "atom", "residue", a number of atoms, or any of them after "SELECTION=".
/// @throws Error(ErrorKind::Usage) if the text is none of them
CoarseRule parseCoarse(const std::string& text);

/// The text that parseCoarse() makes the rule of.
std::string nameOf(const CoarseRule& rule);

/// Beads, and what they stand for.
struct CoarseBalls {
    std::vector<Ball> balls;
    std::vector<std::int32_t> beadAtoms; ///< one an atom of the structure: the number of atoms its
                                         ///< bead stands for, if it represents one; else 0
    std::vector<std::vector<std::size_t>> members; ///< one list a bead or ball: the balls that it
                                                   ///< stands for, ascending; every one is in one
    std::vector<std::string> warnings;
};

/// Puts beads in the place of atoms; later rules win.
///
/// Residue: the atoms N, CA, C and O of an amino acid are one bead, its side chain another one, as
/// in Levitt, J. Mol. Biol. 104:59-107, 1976 (simplified representation of protein conformations).
/// A nucleotide is three: phosphate with O5', sugar, base, as in Knotts et al., J. Chem. Phys.
/// 126:084901, 2007. Ligands, other residues and atoms without residues are cut into clusters of
/// about four atoms. Cluster: the atoms of a chain are cut at the median across their longest
/// extent, again and again; ligands are clustered each on its own. In both, hydrogens go with the
/// nearest atom of their residue, and waters and ions are beads of their own. A rule for a part of
/// a residue or chain makes beads of that part alone.
///
/// The centre of a bead is that of its atoms, weighted by the volumes of their balls. Its `atom` is
/// the one nearest to the centre. Beads stand in the order of their first atoms. Their radii are
/// those of sizeBeads().
///
/// @param[in] balls  atoms in the coordinates of the file
/// @param[in] probe  see sizeBeads() [Å]
/// @throws Error as matchAtoms(), and as sizeBeads()
CoarseBalls coarseGrain(const Selections& selections, const std::vector<Ball>& balls,
                        const std::vector<CoarseRule>& rules, double probe,
                        const Progress& progress);

} // namespace molsurf
