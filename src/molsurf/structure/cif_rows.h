// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The rows of a table of atoms in an mmCIF text, line by line: a document of all of them takes
/// over ten times the memory of the text.

#include "molsurf/structure/text_fields.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// Where the rows of the first loop _atom_site are in a text: bytes [begin, end).
struct CifRows {
    std::vector<std::string> tags;
    std::size_t begin = 0, firstEnd = 0, end = 0; ///< firstEnd: behind the first row
};

/// Finds the rows; nothing where the tags of the loop do not lie on lines of their own, or where
/// the first row is not one line.
std::optional<CifRows> findCifRows(const std::string& text);

/// Splits a line by the rules of CIF, quotes included.
/// @return false if it holds more than values: a comment, a keyword, a text of several lines
bool splitRow(std::string_view line, Fields& fields);

} // namespace molsurf
