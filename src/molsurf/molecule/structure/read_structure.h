// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads the files of structureFormats(), each also .gz, .bz2 or .xz, and standard input.

#include "molsurf/molecule/structure/detect_format.h"
#include "molsurf/molecule/structure/structure.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <string>

namespace molsurf
{

/// Reads a structure.
///
/// The format is found from the content; the extension decides only where the content leaves a
/// choice (PDB or PQR). Packed files are known by their first bytes, whatever the name.
///
/// The readers accept more than the descriptions of the formats allow:
/// - PDB: columns 73-80 of pre-1992 files, which hold the entry name and a line number, are
///   ignored. END ends a model, as VMD writes frames. Hybrid-36 numbers are read. Columns 18-21 are
///   the name of a residue where programs use them so. In standard residues an element that no such
///   residue has (a CA in column 13) is corrected; guessElement() finds those that are missing.
/// - mmCIF: label_alt_id, occupancy, B_iso_or_equiv and auth_seq_id may be missing, or a number be
///   "." or "?", for which label_seq_id stands in. One atom may be given as pairs.
/// - PQR: columns are separated by blanks, the chain column is optional, numbers may be glued by
///   a minus sign. END and TER do not end the file, so files may be concatenated.
/// - xyzr: the last four columns are x y z r. Three columns before them are chain, residue number
///   and atom name; any other number of leading columns is ignored. '#' starts a comment line.
/// - xyzrn: the first four columns are x y z r, the last one of five or six is the name. A name of
///   the form N_ALA_1 or N_ALA_1_A (atom, residue, number, chain) or A_1_x_ALA_N_Blue (chain,
///   number, insertion code or x, residue, atom, anything) gives these; other names are kept only.
///
/// - Integrative models: see addSpheres(). Atoms beside the spheres have no radii of their own.
/// - PDBQT, .gro, .psf, .sdf, .mol, .mol2 and .xyz: see their readers.
///
/// classifyResidues() then says what each residue is, and markBeads() finds beads.
///
/// @param[in] maxBytes  that the text may have; see loadText()
/// @param[in] progress  may end the reading between its stages: unpacking, parsing, making atoms
/// @param[in] memory    that the process may take [byte]; see ReadLimits::memory
/// @throws Error(ErrorKind::Input) if reading is estimated to take more memory, or if the file does
///         not exist, is a folder, is empty, too large or cut short, is not a structure, has no
///         model or no atom, or has a coordinate that is not finite or lies beyond 1e6 Å
/// @throws Cancelled if the progress object says so
Structure readStructure(const std::string& path, std::size_t maxBytes = 0,
                        const Progress& progress = Progress(), std::size_t memory = 0);

/// Reads a structure from a file in memory; otherwise as above.
/// @param[in] path  stands for it in messages
Structure parseStructure(std::string bytes, const std::string& path, std::size_t maxBytes = 0,
                         const Progress& progress = Progress(), std::size_t memory = 0);

/// Reads a structure whose format is known, whatever its content looks like; otherwise as above.
Structure readStructureAs(StructureFormat format, const std::string& path,
                          std::size_t maxBytes = 0);

/// "atom 17 (CA of ALA 5)", for messages; the number counts from 1.
std::string describeAtom(const Structure& structure, std::size_t index);

} // namespace molsurf
