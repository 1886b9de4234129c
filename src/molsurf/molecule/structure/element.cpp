// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/element.h"

#include <gemmi/elem.hpp>

#include <cctype>
#include <cmath>

namespace molsurf
{

const char* elementSymbol(std::uint8_t number)
{
    return gemmi::element_name(static_cast<gemmi::El>(number));
}

std::uint8_t elementNumber(const std::string& symbol)
{
    if (symbol.empty() || symbol.size() > 2) return 0;
    for (const char c : symbol) {
        if (!std::isalpha(static_cast<unsigned char>(c))) return 0;
    }
    return static_cast<std::uint8_t>(gemmi::Element(symbol).atomic_number());
}

double gemmiRadius(std::uint8_t number)
{
    constexpr double digits = 100.0; // that the table has
    return std::round(digits * double(gemmi::vdw_radius(static_cast<gemmi::El>(number)))) / digits;
}

double covalentRadius(std::uint8_t number)
{
    return double(gemmi::covalent_radius(static_cast<gemmi::El>(number)));
}

} // namespace molsurf
