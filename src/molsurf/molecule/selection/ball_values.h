// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Values of balls, to colour a surface by.

#include "molsurf/atoms.h"
#include "molsurf/molecule/structure/structure.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The words of ValueBy::Kind, in its order.
const std::vector<std::string>& valueWords();

/// How many of them, the first ones, are without a file.
constexpr std::size_t valuesWithoutFile = 7;

/// The values of a word, with a file "table=FILE"; none: it is no such word.
/// @param[in] option  that has it, for the error
/// @throws Error(ErrorKind::Usage) if the file is missing
std::optional<ValueBy> parseValueBy(const std::string& text, const std::string& option = "color");

/// The text that parseValueBy() reads.
std::string textOf(const ValueBy& by);

/// The hydrophobicity of an amino acid (Kyte and Doolittle, J. Mol. Biol. 157:105-132, 1982); not a
/// number of others.
float hydrophobicityOf(const std::string& residue);

/// Where balls lie in the whole.
struct BallPlaces {
    openvdb::Vec3d centre;      ///< that radii are taken from [Å]
    std::vector<double> depths; ///< of the balls, for values that are depths [Å]
};

/// Gives every ball a value.
///
/// - bfactor: of the file; if they are the same within every residue of a chain and in [0, 100] or
///   [0, 1], they are taken as the pLDDT of a predicted model, with a warning.
/// - occupancy: of the file.
/// - charge: of a PQR file [e].
/// - hydrophobicity: of the amino acid (Kyte and Doolittle, J. Mol. Biol. 157:105-132, 1982).
/// - rainbow: the place of the residue in its chain, 0 at its first, 1 at its last.
/// - radius: the distance from the centre [Å].
/// - depth: of the centre below the solvent-excluded surface of the whole [Å].
/// - table: lines of chain, residue number, perhaps the atom's name, and the value, parted by
///   commas or white space; what starts with # and a first line without a number are skipped.
/// - potential: of a map in the format OpenDX, as APBS writes it [kT/e].
///
/// A hydrogen without a value has that of the nearest heavy atom of its residue, and so has one
/// with a B factor of 0 beside heavy atoms with others. B factors, occupancies, charges and values
/// of a table that are all the same show nothing, if no range is given.
///
/// @param[in]     coloring  range: B factors are then no pLDDT
/// @param[in]     places    of the balls in the whole
/// @param[in]     maxBytes  that a file may have; see loadText()
/// @param[in,out] warnings  of residues in the table that the structure does not have, of balls
///                          without a value, of values that are all the same
/// @throws Error(ErrorKind::Input) if the file has no such values, or the table cannot be read or
///         fits no atom
BallValues ballValues(const Structure& structure, const std::vector<Ball>& balls, const ValueBy& by,
                      const Coloring& coloring, const BallPlaces& places, std::size_t maxBytes,
                      std::vector<std::string>& warnings);

} // namespace molsurf
