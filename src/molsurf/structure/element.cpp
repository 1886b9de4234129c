// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/element.h"

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

std::uint8_t guessElement(const std::string& atomName, const std::string& residueName)
{
    std::string letters;
    for (const char c : atomName) {
        if (std::isalpha(static_cast<unsigned char>(c))) letters += c;
    }
    if (letters.empty()) return 0;
    struct Ion {
        const char *name, *symbol;
    };
    constexpr Ion ions[] = {{"SOD", "Na"}, {"CLA", "Cl"}, {"POT", "K"},
                            {"CAL", "Ca"}, {"CES", "Cs"}, {"LIT", "Li"},
                            {"RUB", "Rb"}, {"CAD", "Cd"}, {"BAR", "Ba"}};
    for (const Ion& ion : ions)
        if (atomName == residueName && atomName == ion.name) return elementNumber(ion.symbol);
    if (letters.size() == 2 && residueName.compare(0, 2, letters) == 0) {
        const std::uint8_t ion = elementNumber(letters);
        if (ion != 0 && (residueName.size() == 2 ||
                         !std::isalpha(static_cast<unsigned char>(residueName[2])))) {
            return ion;
        }
    }
    return elementNumber(letters.substr(0, 1));
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
