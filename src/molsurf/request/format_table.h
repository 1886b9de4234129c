// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The formats of output files, a row each, and their writers.

#include "molsurf/analysis/measures/area_tables.h"
#include "molsurf/request/request.h"
#include "molsurf/surface.h"

#include <functional>
#include <string>
#include <vector>

namespace molsurf
{

/// The things that the program does. Their bits make sets.
enum Verb : unsigned {
    Build = 1,
    Batch = 2,
    Compare = 4,
    Convert = 8,
    Info = 16,
    BricksPlan = 32,
    BricksRun = 64,
    BricksMerge = 128
};

/// All formats, in the order of help texts.
const std::vector<Format>& formatTable();

/// The format of a word, or null.
const Format* findFormat(const std::string& word);

/// The files of a verb, for the help text of --output.
std::string filesOf(unsigned verb);

/// ".vdb, .ply and .json": the formats that hold one of some things and that some verbs write.
std::string endingsOf(unsigned holds, unsigned verbs, const char* last = " and ");

/// The tables of areas: "atoms", "residues", "contacts", "interfaces", "pockets", "patches",
/// "pore", "tunnels", "forces".
const std::vector<std::string>& areaTables();

/// A table of areas.
/// @param[in] name  one of areaTables()
Table areaTable(const std::string& name, const Request& request, const BallSet& atoms,
                const MolecularSurface& result);

/// The source of all files of a surface. Its references live longer.
struct FileSource {
    const Request& request;
    const BallSet& atoms;
    const MolecularSurface& result; ///< with a report that is complete but for what writing takes
    const Mesh& mesh;               ///< as files have it: of some walls, at another place
    const ShownMeshes& shown;
    const Report& report;                       ///< of the result, with what it was made of
    std::function<openvdb::MetaMap()> metadata; ///< of a .vdb
    const Progress& progress;
};

/// The source of one file, for the writers of the table.
struct Writing {
    const Request& request;
    const BallSet& atoms;
    const MolecularSurface& result;
    const Output& output;
    const Progress& progress;
    const Mesh& mesh;                 ///< with the borders that the format shows
    const Mesh& whole;                ///< by symmetry the mesh of the whole, else the same
    std::vector<const Mesh*> coarser; ///< further levels of detail
    const ShownMeshes& shown;
    const Report& report;
    const std::function<openvdb::MetaMap()>& metadata;
};

/// Writes one file.
/// @throws Error(ErrorKind::Output) if it cannot be written
void writeFile(const FileSource& source, const Output& output, OutputFile& file);

} // namespace molsurf
