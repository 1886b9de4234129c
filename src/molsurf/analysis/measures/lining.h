// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms that line pockets, pores and tunnels.

#include "molsurf/atoms.h"
#include "molsurf/report.h"

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// What lines a void.
struct Lining {
    std::string residues, atoms; ///< names and numbers, with spaces between
    /// Mean of the residues' values on the scale of Kyte and Doolittle, and their charge: +1 of
    /// Lys and Arg, -1 of Asp and Glu [e]; not a number without amino acids.
    double hydrophobicity = std::numeric_limits<double>::quiet_NaN();
    double charge = std::numeric_limits<double>::quiet_NaN();
};

/// Describes it, each residue once, in ascending order.
/// @param[in] parts  indices of balls, and the weight of each
Lining liningOf(const BallSet& atoms, const std::vector<std::pair<std::size_t, double>>& parts);

/// The residues and the atoms of balls, in their order, without the other values.
Lining namesOf(const BallSet& atoms, const std::vector<std::size_t>& balls);

/// What lines a tunnel, each ball by the length of the way that it is beside.
Lining liningOfTunnel(const BallSet& atoms, const Report::Tunnels::Tunnel& tunnel);

} // namespace molsurf
