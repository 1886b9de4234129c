// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The bonds of residues that files often have, and those that a file gives.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace molsurf
{

/// How many pairs of electrons a bond has.
enum class BondOrder : char { None = 0, Single = '-', Double = '=', Triple = '#', Aromatic = ':' };

/// The bonds of a residue by the names of its atoms, of which old ones (C5*, O1P) count, too.
class ResidueBonds
{
public:
    /// The row of a name such as "HEM", between heavy atoms alone; null: there is none.
    static const ResidueBonds* find(const std::string& residue);

    /// Adds a bond, to be found after finish().
    void add(const std::string& a, const std::string& b, BondOrder order);
    void finish();

    /// Whether it has an atom of this name.
    bool has(std::string_view atom) const;

    /// The bond between two atoms that it has; None: they have none.
    BondOrder between(std::string_view a, std::string_view b) const;

private:
    struct Bond {
        std::array<std::string, 2> atoms; ///< sorted
        BondOrder order;
    };
    const Bond* find(std::string_view a, std::string_view b) const;

    std::vector<std::string> atoms_; ///< sorted
    std::vector<Bond> bonds_;        ///< sorted by atoms
};

/// The bonds that a file gives: CONECT of PDB, _struct_conn and _chem_comp_bond of mmCIF.
struct FileBonds {
    /// An atom by its names.
    struct End {
        std::string chain; ///< label_asym_id, or the chain of a PDB file
        int number = 0;    ///< the author's
        char insertionCode = ' ';
        std::string atom;
        bool operator<(const End& other) const
        {
            return std::tie(chain, number, insertionCode, atom) <
                   std::tie(other.chain, other.number, other.insertionCode, other.atom);
        }
    };
    struct Link {
        End a, b;
        BondOrder order = BondOrder::Single;
    };

    std::map<std::string, ResidueBonds> residues; ///< by names; they have all bonds of a residue
    std::vector<Link> links;                      ///< of atoms, in one residue or two
};

} // namespace molsurf
