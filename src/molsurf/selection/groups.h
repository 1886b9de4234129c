// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Named groups of atoms, and what else is known of every ball: chain, element, residue.

#include "molsurf/balls/ball.h"
#include "molsurf/structure/structure.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A group as asked for.
struct GroupRule {
    std::string name;
    std::string select;                               ///< gemmi selections joined by '|'
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB
    std::string copies{}; ///< in these copies of the assembly, see parseCopies(); empty: all
    std::vector<int> copyNumbers{}; ///< what `copies` comes to; empty: all
};

/// A group as found.
struct Group {
    std::string name;
    std::size_t balls = 0;
    std::optional<std::array<std::uint8_t, 3>> color; ///< sRGB
};

/// Kinds of residues that are coloured alike.
enum class ResidueClass : std::uint8_t {
    Hydrophobic,
    Aromatic,
    Polar,
    Positive,
    Negative,
    Special, ///< glycine, proline, cysteine
    Nucleic,
    Other
};

/// What is known of every ball, by its index.
struct BallLabels {
    std::vector<std::int32_t> chainOf;        ///< index into chains
    std::vector<std::string> chains;          ///< "A", in an assembly's second copy "A-2"
    std::vector<std::int32_t> groupOf;        ///< index into groups, or -1
    std::vector<Group> groups;                ///< those asked for, in their order
    std::vector<std::uint8_t> elementOf;      ///< atomic number; 0: unknown
    std::vector<ResidueClass> residueClassOf; ///< by the residue's name
    std::vector<std::string> warnings;        ///< groups that lost atoms to later ones, ...
    /// sRGB, one a chain; empty: chosen by contacts, see chainColors().
    std::vector<std::array<std::uint8_t, 3>> chainColors{};
};

/// The colour that "#rrggbb" stands for.
std::optional<std::array<std::uint8_t, 3>> parseColor(const std::string& text);

/// Reads groups from a file: JSON {"groups": [{"name": "...", "select": "...", "color": "#rrggbb"},
/// ...]}, an entry may also have "copies": "1,7" or "fold:5"; or a table with one group a line:
/// name, selection and perhaps colour and copies=1,7, separated by white space; '#' at the start of
/// a line is a comment.
///
/// @throws Error(ErrorKind::Input) if the file cannot be read, is neither, has no group, or two of
///         one name
std::vector<GroupRule> readGroups(const std::string& path);

/// Labels balls.
///
/// @param[in] copyBegin    copy i is balls [copyBegin[i], copyBegin[i + 1])
/// @param[in] copyNumbers  of copy i in the whole assembly, from 1
/// @param[in] rules        groups; an atom of several belongs to the last
/// @param[in] by         "", "chain", "entity" (chains of the same residues), "copy" (of the
///                       assembly), or "residues:N" (N residues of a chain each): groups instead of
///                       the rules
/// @throws Error(ErrorKind::Input) if a selection does not parse or matches nothing
/// @throws Error(ErrorKind::Usage) if `by` is none of these
BallLabels labelBalls(const Structure& structure, const std::vector<Ball>& balls,
                      const std::vector<std::size_t>& copyBegin,
                      const std::vector<int>& copyNumbers, const std::vector<GroupRule>& rules,
                      const std::string& by);

} // namespace molsurf
