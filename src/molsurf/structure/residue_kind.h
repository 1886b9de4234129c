// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Recognises residues of water by their names.

#include <string>

namespace molsurf
{

/// True for the names of water: HOH, WAT, DOD, H2O, SOL, SPC, and TIP with or without a number.
bool isWaterName(const std::string& residueName);

} // namespace molsurf
