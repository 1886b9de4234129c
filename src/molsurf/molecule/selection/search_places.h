// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where pockets, pores and tunnels are searched for, as PlaceOptions say it.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/match_atoms.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The selections among the words; some may be empty.
std::vector<std::string> selectionsOf(const PlaceOptions& options);

/// Finds the places. An end that is a selection is the mean place of its atoms.
/// @param[in,out] atoms  of selectBalls(); their record gets warnings
/// @throws Error(ErrorKind::Usage) as checkOptions(), or if a selection matches no atom of the
///         model, or both ends of a pore are in one place
SearchPlaces findPlaces(const Selections& selections, const PlaceOptions& options, BallSet& atoms);

} // namespace molsurf
