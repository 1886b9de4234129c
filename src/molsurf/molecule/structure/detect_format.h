// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Detects the format of a text.

#include "molsurf/molecule/structure/structure.h"
#include "molsurf/progress.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The formats of readStructure().
enum class StructureFormat {
    Mmcif,
    BinaryCif,
    Mol2,
    Sdf,
    Psf,
    Parm7,
    Gro,
    Xyz,
    Pqr,
    Pdbqt,
    Pdb,
    Xyzrn,
    Xyzr
};

struct StructureSample;

/// A format of files of atoms.
struct StructureFormatRow {
    StructureFormat format;
    const char* name;                 ///< "PDB"
    std::vector<std::string> endings; ///< of names of files: ".pdb", ".ent"
    /// Whether a text is of this format and not of one of those behind it.
    bool (*matches)(const StructureSample& sample);
    Structure (*read)(std::string text, const std::string& path, const Progress& progress);
    /// Memory that reading a text and choosing its atoms takes at most beside it, for each of its
    /// bytes: measured with `bricks plan --voxel 2` on files of 100,000 to a million atoms.
    double bytesPerByte;
    /// The same of a text, if a closer look at it may find less [byte].
    double (*bytesFor)(const std::string& text) = nullptr;
};

/// All of them, in the order in which a text is held against them.
const std::vector<StructureFormatRow>& structureFormats();

const StructureFormatRow& rowOf(StructureFormat format);

/// "PDB, mmCIF, ... or xyzrn", for messages.
std::string structureFormatNames();

/// Whether a name, which may have a further ".gz", ".bz2" or ".xz", ends as those of files of atoms
/// do.
bool hasStructureEnding(const std::string& path);

/// Finds the format of a text from its first lines; the extension of `path` (a ".gz", ".bz2" or
/// ".xz" left out) decides where they leave a choice.
///
/// @throws Error(ErrorKind::Input) if the text is none of them: it says what the text looks like
StructureFormat detectFormat(const std::string& path, const std::string& text);

} // namespace molsurf
