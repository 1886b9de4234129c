// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The names of the balls' atoms and residues.

#include "molsurf/atoms.h"
#include "molsurf/molecule/structure/structure.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Suffix of the name of a chain in a copy: "" or "-2".
inline std::string chainSuffix(int copy)
{
    return copy == 1 ? "" : "-" + std::to_string(copy);
}

/// Names balls by their atoms. Residues of different copies are different ones; the chains of copy
/// 2 end in "-2", as those of BallLabels::chains.
///
/// @param[in] atoms  balls and placement
BallNames ballNames(const Structure& structure, const BallSet& atoms);

/// The number of a residue with its insertion code, if it has one: "52A".
std::string numberText(const BallNames::Residue& residue);

/// A residue as tables name it: "A/ALA52", "_/ALA52" without a chain.
std::string titleOf(const BallNames::Residue& residue);

/// The name of the amino acid that a residue is a form of: HIS for the protonation states of force
/// fields HID, HIE, HIP, HSD, HSE and HSP; CYS for CYX and CYM; ASP for ASH, GLU for GLH, LYS for
/// LYN, MET for the selenomethionine MSE; others keep their names.
std::string parentResidue(const std::string& name);

/// The largest solvent-accessible area that a residue X has in a tripeptide Gly-X-Gly, at a probe
/// of 1.4 Å: the theoretical values of M. Z. Tien et al., Maximum allowed solvent accessibilities
/// of residues in proteins, PLoS ONE 8:e80635, 2013 [Å^2]. None for what is no amino acid.
std::optional<double> largestAccessibleArea(const std::string& residue);

} // namespace molsurf
