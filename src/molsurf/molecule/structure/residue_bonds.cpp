// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/residue_bonds.h"

#include <algorithm>
#include <unordered_map>

namespace molsurf
{

namespace
{

struct Row {
    const char* residue;
    const char* bonds; ///< "C-O", "C=O", "C#N", or of an aromatic ring "C:C", with
                       ///< blanks between them
};

constexpr Row rows[] = {
#include "molsurf/molecule/structure/residue_bonds.inc"
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

std::array<std::string, 2> sorted(std::string_view a, std::string_view b)
{
    return a < b ? std::array{std::string(a), std::string(b)}
                 : std::array{std::string(b), std::string(a)};
}

/// The bonds of a row such as "N-CA CA-C C=O".
ResidueBonds parsed(std::string_view row)
{
    ResidueBonds bonds;
    while (!row.empty()) {
        const std::size_t end = std::min(row.find(' '), row.size());
        const std::string_view bond = row.substr(0, end);
        const std::size_t order = bond.find_first_of("-=#:");
        bonds.add(std::string(bond.substr(0, order)), std::string(bond.substr(order + 1)),
                  BondOrder(bond[order]));
        row.remove_prefix(std::min(end + 1, row.size()));
    }
    bonds.finish();
    return bonds;
}

} // namespace

const ResidueBonds* ResidueBonds::find(const std::string& residue)
{
    static const std::unordered_map<std::string, ResidueBonds> all = [] {
        std::unordered_map<std::string, ResidueBonds> table;
        for (const Row& row : rows) table.emplace(row.residue, parsed(row.bonds));
        return table;
    }();
    const auto found = all.find(residue);
    return found == all.end() ? nullptr : &found->second;
}

void ResidueBonds::add(const std::string& a, const std::string& b, BondOrder order)
{
    bonds_.push_back({sorted(a, b), order});
    atoms_.insert(atoms_.end(), {a, b});
}

void ResidueBonds::finish()
{
    std::sort(atoms_.begin(), atoms_.end());
    std::stable_sort(bonds_.begin(), bonds_.end(),
                     [](const Bond& a, const Bond& b) { return a.atoms < b.atoms; });
}

bool ResidueBonds::has(std::string_view atom) const
{
    const auto is = [&](const std::string& name) {
        return std::binary_search(atoms_.begin(), atoms_.end(), name);
    };
    return is(std::string(atom)) || is(todaysName(atom));
}

const ResidueBonds::Bond* ResidueBonds::find(std::string_view a, std::string_view b) const
{
    const auto atoms = sorted(a, b);
    const auto found =
        std::lower_bound(bonds_.begin(), bonds_.end(), atoms,
                         [](const Bond& bond, const auto& pair) { return bond.atoms < pair; });
    return found != bonds_.end() && found->atoms == atoms ? &*found : nullptr;
}

BondOrder ResidueBonds::between(std::string_view a, std::string_view b) const
{
    const Bond* bond = find(a, b);
    if (!bond) bond = find(todaysName(a), todaysName(b));
    return bond ? bond->order : BondOrder::None;
}

} // namespace molsurf
