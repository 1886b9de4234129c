// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The rows of a table of atoms in an mmCIF text, piece by piece: a document of all of them takes
/// over ten times the memory of the text.

#include <gemmi/cifdoc.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Where the rows of the first loop _atom_site are, and where they may be cut: each piece can be
/// read as a loop of its own, for no residue goes on or comes again in the next one.
struct CifRows {
    std::vector<std::string> tags;
    std::vector<std::size_t> cuts; ///< first byte of each piece, and the byte behind the last
    std::size_t firstEnd = 0;      ///< byte behind the first row
    std::size_t rows = 0;
    std::size_t longest = 0; ///< rows of the longest piece
};

/// Finds the rows.
/// @param[in] rowsOfPiece  that a piece has at least
/// @return nothing where they are not one a line, or a model comes back, or chains are not given:
///         such a table is read as a whole
std::optional<CifRows> findCifRows(const std::string& text, std::size_t rowsOfPiece);

/// The numbers of rows of a loop _atom_site at which it may be cut in the same way, from 0 to that
/// of all, without a cut where findCifRows() returns nothing: gemmi looks through the residues of a
/// chain, and through the models, for each of them.
std::vector<std::size_t> cutsOfRows(const gemmi::cif::Loop& loop, std::size_t rowsOfPiece);

} // namespace molsurf
