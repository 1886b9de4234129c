// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The names of the balls' atoms and residues.

#include "molsurf/atoms.h"
#include "molsurf/structure/structure.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Names balls by their atoms. Residues of different copies are different ones; the chains of copy
/// 2 end in "-2", as those of BallLabels::chains.
///
/// @param[in] balls        copy i is balls [copyBegin[i], copyBegin[i + 1])
/// @param[in] copyNumbers  number of each copy
BallNames ballNames(const Structure& structure, const std::vector<Ball>& balls,
                    const std::vector<std::size_t>& copyBegin, const std::vector<int>& copyNumbers);

/// The name of the amino acid that a residue is a form of: HIS for the protonation states of force
/// fields HID, HIE, HIP, HSD, HSE and HSP; CYS for CYX and CYM; ASP for ASH, GLU for GLH, LYS for
/// LYN, MET for the selenomethionine MSE; others keep their names.
std::string parentResidue(const std::string& name);

/// The largest solvent-accessible area that a residue X has in a tripeptide Gly-X-Gly, at a probe
/// of 1.4 Å: the theoretical values of M. Z. Tien et al., Maximum allowed solvent accessibilities
/// of residues in proteins, PLoS ONE 8:e80635, 2013 [Å^2]. None for what is no amino acid.
std::optional<double> largestAccessibleArea(const std::string& residue);

} // namespace molsurf
