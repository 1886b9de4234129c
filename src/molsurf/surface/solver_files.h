// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of a calculation of APBS with a surface, a row each.

#include "molsurf/atoms.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/write_apbs.h"
#include "molsurf/surface.h"
#include "molsurf/surface/file_settings.h"

#include <functional>
#include <string>
#include <vector>

namespace molsurf
{

/// The source of these files.
struct SolverRun {
    const BallSet& atoms; ///< with charges
    const openvdb::FloatGrid& levelSet;
    ApbsGrid grid;
    Dielectric dielectric;
    std::string title; ///< a comment of the input
    /// The paths of the files by their word.
    std::function<std::string(const std::string& word)> pathOf;
};

/// A file of such a calculation.
struct SolverFile {
    const char* word; ///< how its name ends: "dielx.dx"
    /// @throws Error(ErrorKind::Output) if the file cannot be written
    void (*write)(const SolverRun& run, const Progress& progress, OutputFile& file);
};

/// All of them; the last one is the input, which names the others.
const std::vector<SolverFile>& solverFiles();

/// The path of one of these files, whose name begins with that of the molecule; the input has none.
/// @param[in] input  the file of the molecule
/// @throws Error(ErrorKind::Usage) if the name of the folder has spaces, which APBS cannot read
std::string solverPath(const std::string& folder, const std::string& input,
                       const std::string& word);

/// The lattice of a calculation: that of a file, or around the charges.
/// @throws Error(ErrorKind::Input) if it is wrong or does not cover the atoms
ApbsGrid solverGrid(const std::string& apbsInput, const BallSet& atoms);

/// Warnings on the energy, with names of options in backticks: a surface that neither is ses nor
/// matches it has another energy, and a solvent less polar than the molecule is a slip.
std::vector<std::string> solverWarnings(const SurfaceSpec& surface, const Dielectric& dielectric);

} // namespace molsurf
