// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The bonds between heavy atoms of residues that files often have.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// The bonds of a residue by the names of its atoms, of which old ones (C5*, O1P) count, too.
class ResidueBonds
{
public:
    /// The row of a name such as "HEM"; null: there is none.
    static const ResidueBonds* find(const std::string& residue);

    /// Whether the table has an atom of this name.
    bool has(std::string_view atom) const;

    /// Whether two atoms that it has are bonded.
    bool bonded(std::string_view a, std::string_view b) const;

private:
    explicit ResidueBonds(std::string_view row);

    std::vector<std::string_view> atoms_;                ///< sorted
    std::vector<std::array<std::string_view, 2>> bonds_; ///< sorted, each pair too
};

} // namespace molsurf
