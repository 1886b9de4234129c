// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Named groups of atoms, and what else is known of every ball: chain, element, residue.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/match_atoms.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The colour that "#rrggbb", "#rgb" or a name of colorNames() stands for.
std::optional<std::array<std::uint8_t, 3>> parseColor(const std::string& text);

/// The colours that have names: the sixteen of HTML 4, orange, cyan and magenta.
const std::vector<std::string>& colorNames();

/// Reads groups from a file: JSON {"groups": [{"name": "...", "select": "...", "color": "#rrggbb"},
/// ...]}, an entry may also have "copies": "1,7" or "fold:5"; or a table with one group a line:
/// name, selection, which in words may have blanks, and perhaps colour and copies=1,7, separated by
/// white space; '#' at the start of a line is a comment.
///
/// @throws Error(ErrorKind::Input) if the file cannot be read, is neither, has no group, or two of
///         one name
std::vector<GroupRule> readGroups(const std::string& path, std::size_t maxBytes = 0);

/// Reads "chain", "entity", "class", "copy" or "residues:N".
/// @throws Error(ErrorKind::Usage) if the text is none of these
GroupBy parseGroupBy(const std::string& text);

/// The text that parseGroupBy() reads.
std::string textOf(const GroupBy& by);

/// Labels balls. Groups count those of the whole that a unit stands for.
///
/// @param[in] atoms  balls and placement
/// @param[in] rules  groups; an atom of several belongs to the last
/// @param[in] by     groups instead of the rules, if there are any
/// @throws Error(ErrorKind::Input) if a selection does not parse or matches nothing
BallLabels labelBalls(const Selections& selections, const BallSet& atoms,
                      const std::vector<GroupRule>& rules, const std::optional<GroupBy>& by);

/// Adds groups that are there for colours alone, by the same rules.
void addColorGroups(const Selections& selections, const BallSet& atoms,
                    const std::vector<GroupRule>& rules, BallLabels& labels);

} // namespace molsurf
