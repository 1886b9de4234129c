// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// --label and --ruler.

#include <string>
#include <vector>

namespace molsurf::tool
{

/// A label of atoms, or a ruler between two.
struct NoteRule {
    std::vector<std::string> selects; ///< one, or the two ends of a ruler
    std::string text;                 ///< of a label; empty: the name of the residue
};

/// "A/57=active site", or "A/57".
/// @throws Error(ErrorKind::Usage) if it has no selection
NoteRule parseLabel(const std::string& text);

/// "A/57/NE2..A/195/OG".
/// @throws Error(ErrorKind::Usage) if it is no pair of selections
NoteRule parseRuler(const std::string& text);

} // namespace molsurf::tool
