// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Chemical elements by number and symbol.

#include <cstdint>
#include <string>

namespace molsurf
{

/// Number of the heaviest element known here.
constexpr int maxElement = 118;

/// Atomic number of carbon.
constexpr std::uint8_t carbonElement = 6;

/// Symbol of an element, "Mg"; "X" for 0, the unknown element.
/// @param[in] number  atomic number, in [0, maxElement]
const char* elementSymbol(std::uint8_t number);

/// Atomic number of a symbol in any case, "MG" or "Mg"; deuterium "D" is 1; 0 if there is no such
/// element.
std::uint8_t elementNumber(const std::string& symbol);

/// Van der Waals radius in gemmi's table [Å].
/// @param[in] number  atomic number, in [1, maxElement]
double gemmiRadius(std::uint8_t number);

/// Covalent radius in gemmi's table [Å].
/// @param[in] number  atomic number, in [0, maxElement]
double covalentRadius(std::uint8_t number);

} // namespace molsurf
