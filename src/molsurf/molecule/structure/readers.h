// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The readers of the formats of structureFormats().

#include "molsurf/molecule/structure/structure.h"
#include "molsurf/progress.h"

#include <string>

namespace molsurf
{

// read_pdb: PDB and PDBQT.

/// Reads the text of a PDB file; see readStructure() for what is accepted.
/// @param[in] progress  may end the reading between its stages
/// @throws Error(ErrorKind::Input) with the line, if the coordinates of an atom are no numbers, or
///         if a record is nearly ATOM; a text without atoms gives none
/// @throws Cancelled if the progress object says so
Structure readPdb(std::string text, const std::string& path, const Progress& progress);

/// Reads the text of a PDBQT file of AutoDock: a PDB file with charges in columns 71-76 and types
/// of AutoDock from column 78 on, which tell the elements. Each MODEL is a pose.
/// @throws Error as readPdb()
Structure readPdbqt(std::string text, const std::string& path, const Progress& progress);

// read_macromolecule: mmCIF and BinaryCIF.

/// Reads the text of an mmCIF file: the first data block that has atoms, or spheres of an
/// integrative model, or a component or a crystal of a small molecule.
/// @param[in] text  consumed, to save memory
/// @throws Error(ErrorKind::Input) if it cannot be read, or if no data block has atoms
Structure readMmcif(std::string text, const std::string& path, const Progress& progress);

/// Memory that a document of all rows takes at most, for each byte of its text: 32 bytes for each
/// value, and twice that while it grows.
constexpr double cifDocumentPerByte = 21.0;

/// Memory that reading such a text takes beside it [byte].
double bytesForMmcif(const std::string& text);

/// The same of a BinaryCIF file.
Structure readBinaryCif(std::string bytes, const std::string& path, const Progress& progress);

// read_ball_list: files whose atoms carry their own radii.

/// Reads a PQR text: from the right radius, charge, z, y, x; from the left serial number, atom,
/// residue, an optional chain, residue number. HETATM records are hetero unless they are water.
/// @throws Error(ErrorKind::Input) naming the line, if it has too few columns, if a column is no
///         number, or if a radius is negative
Structure readPqr(const std::string& text, const std::string& path);

/// Reads an xyzr text; see readStructure() for its columns.
/// @throws Error(ErrorKind::Input) as readPqr()
Structure readXyzr(const std::string& text, const std::string& path);

/// Reads an xyzrn text; see readStructure() for its columns. Lines without a name are allowed.
/// @throws Error(ErrorKind::Input) as readPqr()
Structure readXyzrn(const std::string& text, const std::string& path);

// read_ligand: the files of small molecules.

/// Reads the molecules of an .sdf or .mol file, V2000 or V3000; each is a model. Atoms are named by
/// their elements, "C1", "C2", "O1".
/// @throws Error(ErrorKind::Input) with the line, if it is not as described, or if a molecule is
///         drawn in two dimensions
Structure readSdf(const std::string& text, const std::string& path);

/// Reads the molecules of a .mol2 file; each is a model. Residues are its substructures, with
/// numbers, names and chains if they are given; atoms have charges if all lines have one. The types
/// of SYBYL ("C.3") tell the elements; where a molecule has those of GAFF, Amber or CHARMM, these
/// and the names do. Lone pairs and dummies are particles.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readMol2(const std::string& text, const std::string& path);

/// Reads an .xyz file: the number of atoms, a comment, and a line with element, x, y and z for
/// each; further frames are models. The comment may name the columns
/// (Properties=species:S:1:pos:R:3).
/// Where some words are no symbols (CB), all are names of atoms.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readXyz(const std::string& text, const std::string& path);

// read_simulation: the files of GROMACS, and of CHARMM, X-PLOR and NAMD.

/// Reads a .gro file: title, number of atoms, atoms in nanometres, box; further frames are models.
/// The columns of coordinates are as wide as the distance of their decimal points says, velocities
/// are passed over. Names tell the elements.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readGro(const std::string& text, const std::string& path);

/// Reads the atoms of a .psf file, whose places are to come from elsewhere (Structure::placed is
/// false). Segments are the chains, masses and names tell the elements.
/// @throws Error(ErrorKind::Input) with the line, if it is not as described
Structure readPsf(const std::string& text, const std::string& path);

/// Reads the atoms of a topology of Amber (.parm7, .prmtop), whose places are to come from
/// elsewhere: names, residues numbered from 1, elements and charges; no chains.
/// @throws Error(ErrorKind::Input) if a section is missing or too short
Structure readParm7(const std::string& text, const std::string& path);

} // namespace molsurf
