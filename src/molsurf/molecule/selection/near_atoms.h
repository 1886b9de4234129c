// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the atoms near some others.

#include "molsurf/molecule/structure/structure.h"

#include <vector>

namespace molsurf
{

/// Marks the atoms whose centres lie within a distance of the centre of a marked one of the same
/// model, and those too.
/// @param[in] marked    one char an atom
/// @param[in] distance  at least 0 [Å]
/// @throws Error(ErrorKind::Input) if an atom lies farther than 1e6 Å from the origin
std::vector<char> nearAtoms(const Structure& structure, const std::vector<char>& marked,
                            double distance);

} // namespace molsurf
