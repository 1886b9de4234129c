// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What files add to the tables of areas.

#include "molsurf/tables.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Adds columns that say what the areas of a table are of: surface, its kind; probe_A; radii, the
/// name of their set or file, or "input".
/// @param[in] probe  radius [Å]
void addOrigin(const BallSet& atoms, const std::string& kind, double probe, Table& table);

/// The area of each ball's residue [Å^2].
std::vector<double> residueAreasOfBalls(const BallSet& atoms, const std::vector<double>& ballAreas);

} // namespace molsurf
