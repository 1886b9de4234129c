// SPDX-License-Identifier: MPL-2.0
#include "cli/suggest.h"

#include <algorithm>
#include <cstring>

namespace molsurf::tool
{

namespace
{

struct ValueExample {
    const char* option;
    const char* value; ///< as a shell takes it
};

/// Values of options that have neither words nor a default to show.
constexpr ValueExample examples[] = {{"output", "surface.vdb"},
                                     {"folder", "surfaces"},
                                     {"formats", "vdb,ply,json"},
                                     {"range", "0,100"},
                                     {"select", "\"chain A and resid 5-9\""},
                                     {"model", "2"},
                                     {"assembly", "1"},
                                     {"copies", "1-5"},
                                     {"altloc", "A"},
                                     {"radii", "bondi"},
                                     {"frames", "1-10"},
                                     {"trajectory", "run.xtc"},
                                     {"fps", "24"},
                                     {"lod", "1,2,4"},
                                     {"remesh", "0.5"},
                                     {"density", "3"},
                                     {"adapt", "0.02"},
                                     {"resolution", "8"},
                                     {"groups", "groups.json"},
                                     {"surface-of", "A=ses"},
                                     {"potential-offset", "1.4"},
                                     {"pocket-at", "\"resn HEM\""},
                                     {"pore", "auto"},
                                     {"tunnels-from", "\"resid 57\""},
                                     {"superpose", "auto"},
                                     {"fog-density", "1"},
                                     {"print-scale", "1"},
                                     {"min-thickness", "1"},
                                     {"pixel-size", "4"},
                                     {"box-size", "128"},
                                     {"apbs-grid", "apbs.in"},
                                     {"ion-conc", "0.15"},
                                     {"view", "x"},
                                     {"zoom", "\"resn HEM\""},
                                     {"up", "z"},
                                     {"background", "white"},
                                     {"plain-color", "white"},
                                     {"label", "\"A/57=active site\""},
                                     {"ruler", "\"A/57..A/102\""},
                                     {"panel", "ses"},
                                     {"clip", "0"},
                                     {"dpi", "300"},
                                     {"turntable", "36"},
                                     {"max-steps", "200"},
                                     {"steps", "12"},
                                     {"bricks", "8"},
                                     {"memory", "4G"},
                                     {"max-input", "10G"},
                                     {"threads", "4"},
                                     {"config", "options.txt"}};

/// Options of other programs (MSMS, EDTSurf, NanoShaper, FreeSASA, PyMOL, ChimeraX, HOLE, fpocket,
/// APBS), without hyphens.
const std::vector<Synonyms> meanings = {
    {"proberadius radiusprobe solventradius rprobe", "--probe"},
    {"gridspacing gridresolution spacing grid step gridsize voxelsize", "--voxel"},
    {"out outfile outputfile write save", "-o"},
    {"outdir outputdir dir directory", "-O"},
    {"colour colorby colourby coloring", "--color"},
    {"cmap colormap colourmap spectrum", "--palette"},
    {"nproc ncores cores cpus cpu jobs nt numthreads nthreads", "-j N"},
    {"chain chains", "--select \"chain A\""},
    {"sel selection atoms residues resid keep", "--select"},
    {"ligand ligands het hetatm hetatoms", "--hetero"},
    {"noligand noligands nohet nohetatm protein proteinonly", "--no-hetero"},
    {"water solvent hoh", "--waters"},
    {"nowater nowaters nosolvent", "nothing, waters are left out by default"},
    {"noh nohydrogen nohydro striph", "--no-hydrogens"},
    {"biounit bioassembly biologicalassembly unit assemblyid", "--assembly 1"},
    {"transparency alpha transparent", "--opacity 0.5"},
    {"width height imagesize resx ray", "--size"},
    {"bg bgcolor backgroundcolor", "--background"},
    {"overwrite clobber y yes", "--force"},
    {"ionicstrength salt saltconc conc", "--ion-conc"},
    {"epsin indi solutedielectric interiordielectric", "--pdie"},
    {"epsout exdi solventdielectric exteriordielectric", "--sdie"},
    {"forcefield ff radiusset vdwradii", "--radii"},
    {"rotate spin orbit", "--turntable 36"},
    {"align superimpose fit match3d cealign", "--superpose auto"},
    {"traj xtc dcd", "--trajectory"},
    {"frame start stop stride skip every", "--frames"},
    {"silent", "--quiet"},
    {"timeout walltime maxtime", "--max-hours"},
    {"method type kind surfacetype mesh", "--surface"},
    {"sas sasa accessible", "--surface sas"},
    {"ses connolly excluded molecular", "--surface ses"},
    {"vdw vanderwaals", "--surface vdw"},
    {"channel hole tunnelaxis", "--pore auto"},
    {"tunnel tunnels caver startingpoint startingpointatom", "--tunnels-from \"resid 57\""},
    {"pocket cavity cavities", "--pockets"},
    {"curvature curvatures", "--fields mean_curvature"},
    {"smooth smoothing smoothness", "--epsilon"},
    {"verbosity debug", "--verbose"},
    {"stick sticks cartoon ribbon spheres", "--show sticks"},
    {"camera rotation orientation", "--view"}};

std::string withoutHyphens(const std::string& text)
{
    std::string out;
    for (const char letter : lowered(text))
        if (letter != '-' && letter != '_') out += letter;
    return out;
}

bool isNumber(const std::string& text)
{
    double value = 0.0;
    return parseWhole(text, value);
}

} // namespace

std::string exampleOf(const Option& option)
{
    std::string value = option.value ? option.value : "";
    for (const std::string& word : option.words)
        if (word != "none" && word.find("FILE") == std::string::npos) {
            value = word;
            break;
        }
    if (isNumber(option.preset)) value = option.preset;
    for (const ValueExample& row : examples)
        if (std::strcmp(row.option, option.name) == 0) value = row.value;
    return std::string("--") + option.name + " " + value;
}

std::string meantByOption(const std::string& typed)
{
    return meaningOf(withoutHyphens(typed), meanings);
}

} // namespace molsurf::tool
