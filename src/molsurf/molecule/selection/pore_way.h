// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where a pore is searched for, as SelectOptions::pore says it, and where tunnels begin.

#include "molsurf/atoms.h"
#include "molsurf/molecule/structure/structure.h"

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

/// Checks where tunnels begin.
/// @throws Error(ErrorKind::Usage) if it is of numbers but no point
void checkTunnelsFrom(const std::string& from);

/// The selection that it is, or "".
std::string tunnelSelection(const std::string& from);

/// Where they begin; none: nothing is asked for.
/// @throws Error(ErrorKind::Usage) as checkTunnelsFrom(), or if a selection matches no atom of the
///         model
std::optional<BallSet::PoreWay::End> tunnelsFrom(const std::string& from,
                                                 const Structure& structure, const Model& model);

} // namespace molsurf
