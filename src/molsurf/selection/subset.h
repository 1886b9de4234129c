// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Some of the balls, with all that is known of them.

#include "molsurf/atoms.h"

#include <cstddef>
#include <vector>

namespace molsurf
{

/// What the numbers of balls in groups and resolution rules count: those of a subset, or still
/// those of the whole.
enum class Counted { Subset, Whole };

/// Takes some of the balls, with their labels, colours and resolutions. Chains, groups and rules
/// stay all, so that their indices mean the same.
/// @param[in] which  indices, in the order that is wanted
BallSet subset(const BallSet& atoms, const std::vector<std::size_t>& which,
               Counted counted = Counted::Subset);

/// The same balls in spatial order, so that results have the same bits for any order of the atoms.
BallSet inSpatialOrder(const BallSet& atoms);

} // namespace molsurf
