// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/solver_files.h"

#include "molsurf/analysis/measures/compare.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/printable.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/point_charges.h"
#include "molsurf/molecule/structure/archive.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace molsurf
{

namespace
{

template<int axis>
void writeMap(const SolverRun& run, const Progress& progress, OutputFile& file)
{
    const Spline spline = splineThrough(run.levelSet, progress);
    writeDielectricMap({run.levelSet, spline}, run.grid, axis, run.dielectric, file);
}

void writeIons(const SolverRun& run, const Progress&, OutputFile& file)
{
    writeIonMap(run.atoms.balls, run.grid, run.dielectric.ionRadius, file);
}

void writeCharges(const SolverRun& run, const Progress&, OutputFile& file)
{
    writePqr(*run.atoms.charges, file);
}

void writeInput(const SolverRun& run, const Progress&, OutputFile& file)
{
    const ApbsFiles files{run.pathOf("charges.pqr"),
                          run.pathOf("kappa.dx"),
                          {run.pathOf("dielx.dx"), run.pathOf("diely.dx"), run.pathOf("dielz.dx")}};
    writeApbsInput("vdb_molsurf: " + printable(run.title), files, run.grid, run.dielectric, file);
}

/// Whether a letter ends a name for APBS: a blank, a quote, the sign of a comment, or a control
/// character.
bool endsName(char c)
{
    return static_cast<unsigned char>(c) <= ' ' || c == 0x7f ||
           std::string_view("\"#%").find(c) != std::string_view::npos;
}

} // namespace

const std::vector<SolverFile>& solverFiles()
{
    static const std::vector<SolverFile> all = {
        {"dielx.dx", writeMap<0>}, {"diely.dx", writeMap<1>},     {"dielz.dx", writeMap<2>},
        {"kappa.dx", writeIons},   {"charges.pqr", writeCharges}, {"apbs.in", writeInput}};
    return all;
}

std::string solverPath(const std::string& folder, const std::string& input, const std::string& word)
{
    if (std::any_of(folder.begin(), folder.end(), endsName))
        throw Error(ErrorKind::Usage, "'" + folder +
                                          "': APBS reads no names with spaces, quotes, # or %, "
                                          "expected a folder without");
    std::string stem = inputStem(input) + ".";
    std::replace_if(stem.begin(), stem.end(), endsName, '_');
    return (std::filesystem::path(folder) / ((word == "apbs.in" ? "" : stem) + word)).string();
}

ApbsGrid solverGrid(const std::string& apbsInput, const BallSet& atoms)
{
    const ApbsGrid grid =
        apbsInput.empty() ? gridAround(*atoms.charges) : readApbsGrid(apbsInput, *atoms.charges);
    checkCovers(grid, atoms.balls);
    return grid;
}

std::vector<std::string> solverWarnings(const SurfaceSpec& surface, const Dielectric& dielectric)
{
    std::vector<std::string> warnings;
    if (surface.kind != SurfaceKind::SolventExcluded && surface.inset == 0.0)
        warnings.push_back(std::string("`surface` ") + nameOf(surface.kind) +
                           ": its energy is another one than that of the solvent-excluded surface "
                           "[hint: `surface` ses, or `match` ses]");
    const bool vacuum = dielectric.outside == 1.0;
    if (dielectric.inside > dielectric.outside && !vacuum)
        warnings.push_back(formatted(
            "`pdie` %g is above `sdie` %g: the molecule is more polar than "
            "the solvent [hint: `pdie` %g `sdie` %g]",
            dielectric.inside, dielectric.outside, dielectric.outside, dielectric.inside));
    return warnings;
}

} // namespace molsurf
