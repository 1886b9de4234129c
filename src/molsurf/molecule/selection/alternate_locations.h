// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// One of several alternate locations.

#include "molsurf/molecule/structure/structure.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Leaves out all but one alternate location of every atom; see selectBalls() for the rule.
///
/// @param[in]     structure
/// @param[in,out] atoms  indices of atoms of one model, ascending; the others are taken out
/// @return how many were taken out
std::size_t keepHighestOccupancy(const Structure& structure, std::vector<std::int32_t>& atoms);

} // namespace molsurf
