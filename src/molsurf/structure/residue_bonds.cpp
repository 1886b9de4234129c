// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/residue_bonds.h"

#include <algorithm>
#include <unordered_map>

namespace molsurf
{

namespace
{

struct Row {
    const char* residue;
    const char* bonds; ///< "C-O" or, for a double one, "C=O", with blanks between them
};

constexpr Row rows[] = {
#include "molsurf/structure/residue_bonds.inc"
};

/// The name of today for one of before 2008: "C5*" is "C5'", "O1P" is "OP1".
std::string todaysName(std::string_view atom)
{
    std::string name(atom);
    if (!name.empty() && name.back() == '*') name.back() = '\'';
    if (name.size() == 3 && name[0] == 'O' && name[2] == 'P' && name[1] >= '1' && name[1] <= '3')
        name = {'O', 'P', name[1]};
    return name;
}

std::array<std::string_view, 2> sorted(std::string_view a, std::string_view b)
{
    return a < b ? std::array{a, b} : std::array{b, a};
}

} // namespace

ResidueBonds::ResidueBonds(std::string_view row)
{
    while (!row.empty()) {
        const std::size_t end = std::min(row.find(' '), row.size());
        const std::string_view bond = row.substr(0, end);
        const std::size_t order = bond.find_first_of("-=#");
        const std::string_view a = bond.substr(0, order), b = bond.substr(order + 1);
        bonds_.push_back(sorted(a, b));
        atoms_.insert(atoms_.end(), {a, b});
        row.remove_prefix(std::min(end + 1, row.size()));
    }
    std::sort(atoms_.begin(), atoms_.end());
    std::sort(bonds_.begin(), bonds_.end());
}

const ResidueBonds* ResidueBonds::find(const std::string& residue)
{
    static const std::unordered_map<std::string, ResidueBonds> all = [] {
        std::unordered_map<std::string, ResidueBonds> table;
        for (const Row& row : rows) table.emplace(row.residue, ResidueBonds(row.bonds));
        return table;
    }();
    const auto found = all.find(residue);
    return found == all.end() ? nullptr : &found->second;
}

bool ResidueBonds::has(std::string_view atom) const
{
    return std::binary_search(atoms_.begin(), atoms_.end(), atom) ||
           std::binary_search(atoms_.begin(), atoms_.end(), std::string_view(todaysName(atom)));
}

bool ResidueBonds::bonded(std::string_view a, std::string_view b) const
{
    if (std::binary_search(bonds_.begin(), bonds_.end(), sorted(a, b))) return true;
    const std::string first = todaysName(a), second = todaysName(b);
    return std::binary_search(bonds_.begin(), bonds_.end(), sorted(first, second));
}

} // namespace molsurf
