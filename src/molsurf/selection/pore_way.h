// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where a pore is searched for, as SelectOptions::pore says it.

#include "molsurf/atoms.h"
#include "molsurf/structure/structure.h"

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Checks the text.
/// @throws Error(ErrorKind::Usage) if it says neither ends nor an axis
void checkPore(const std::string& pore);

/// The selections among the ends.
std::vector<std::string> poreSelections(const std::string& pore);

/// Where it is searched for; a selection is the mean place of its atoms.
/// @throws Error(ErrorKind::Usage) as checkPore(), or if a selection matches no atom of the model,
///         or both ends are in one place
std::optional<BallSet::PoreWay> poreWay(const std::string& pore, const Structure& structure,
                                        const Model& model);

} // namespace molsurf
