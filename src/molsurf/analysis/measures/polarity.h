// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which atoms are polar.

#include "molsurf/atoms.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace molsurf
{

/// The class of an atom.
enum class Polarity : std::uint8_t {
    Apolar, ///< C, P, S, Se and halogens
    Polar,  ///< N, O and what is left, metals for example
    Unknown ///< of no known element: beads
};

/// The class of each ball by its element, which is that of NACCESS (1993) and of FreeSASA's file
/// naccess.config for atoms of proteins and nucleic acids. A hydrogen has the class of the heavy
/// atom of its residue that is nearest to it.
/// @param[in] atoms  with names
std::vector<Polarity> polarityOf(const BallSet& atoms);

/// The areas of polar and of apolar atoms.
/// @param[in] areas  of the first balls
std::pair<double, double> areasByPolarity(const BallSet& atoms, const std::vector<double>& areas);

} // namespace molsurf
