// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/residue_kind.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace molsurf
{

bool isWaterName(const std::string& residueName)
{
    static constexpr std::array<std::string_view, 18> names{
        "HOH", "WAT", "DOD", "H2O", "HHO", "OHH",  "SOL",  "SPC",  "SPCE",
        "TIP", "TP3", "TP4", "T3P", "T4P", "TIP3", "TIP4", "TIP5", "TIP3P"};
    return std::find(names.begin(), names.end(), residueName) != names.end();
}

} // namespace molsurf
