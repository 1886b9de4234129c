// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Values of balls, to colour a surface by.

#include "molsurf/atoms.h"
#include "molsurf/structure/structure.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The words that SelectOptions::valueBy may be, but for those with a file.
const std::vector<std::string>& valueWords();

/// Gives every ball a value.
///
/// - bfactor: of the file; if they are the same within every residue and in [0, 100], as predicted
///   models have their pLDDT there, they are taken as that, and a warning says so.
/// - occupancy: of the file.
/// - charge: of a PQR file [e].
/// - hydrophobicity: of the amino acid (Kyte and Doolittle, J. Mol. Biol. 157:105-132, 1982).
/// - rainbow: the place of the residue in its chain, 0 at its first, 1 at its last.
/// - radius: the distance from the centre [Å].
/// - table=FILE: lines of chain, residue number, perhaps the atom's name, and the value, parted by
///   commas or white space; what starts with # and a first line without a number are skipped.
/// - potential=FILE: of a map in the format OpenDX, as APBS writes it [kT/e], on the surface;
///   potential-out=FILE: a probe radius outside of it.
///
/// @param[in]     ranged    whether the ends of the colours are given: B factors are then no pLDDT
/// @param[in]     probe     radius [Å]
/// @param[in]     centre    that radii are taken from [Å]
/// @param[in]     maxBytes  that a file may have; see loadText()
/// @param[in,out] warnings  of residues in the table that the structure does not have
/// @throws Error(ErrorKind::Usage) if `by` is none of these
/// @throws Error(ErrorKind::Input) if the file has no such values, or the table cannot be read or
///         fits no atom
BallValues ballValues(const Structure& structure, const std::vector<Ball>& balls,
                      const std::string& by, bool ranged, const openvdb::Vec3d& centre,
                      double probe, std::size_t maxBytes, std::vector<std::string>& warnings);

} // namespace molsurf
