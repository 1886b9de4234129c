// SPDX-License-Identifier: MPL-2.0
#include "cli_table.h"

#include "molsurf/bricks/plan_bricks.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace molsurf::tool
{

const char* const formatWords = "vdb, ply, obj, stl, off, glb, 3mf, html, json or png";

const std::vector<std::string>& knownFields()
{
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names = fieldNames();
        names.insert(names.begin(), "surface");
        return names;
    }();
    return all;
}

std::string shortest(double number)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

namespace
{

// Words with commas between, in lines for the help text.
std::string lines(const std::vector<std::string>& words)
{
    constexpr std::size_t width = 62;
    std::string all, line;
    for (const std::string& word : words) {
        if (!line.empty() && line.size() + word.size() > width) {
            all += line + "\n";
            line.clear();
        }
        line += word + ",";
    }
    all += line;
    all.pop_back();
    return all;
}

} // namespace

const std::vector<Group>& groups()
{
    static const Options preset;
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE",
           "file to write; repeats; the extension says what:\n"
           ".vdb level set and fields; .ply .obj .stl .off .glb\n"
           ".3mf mesh; .html page that shows it; .json report;\n"
           ".png picture; - is standard output",
           "", true},
          {"format", "WORD", std::string("what -o - writes: ") + formatWords, ""},
          {"force", nullptr, "replace existing files", ""}}},
        {"Atoms",
         {{"select", "EXPR", "gemmi selections joined by |, e.g. \"/1/A/53-132|*;polymer\"", "all"},
          {"model", "N", "number of the model in the file", "the first"},
          {"assembly", "ID",
           "biological assembly to build; none: as in the file;\n"
           "ncs: with the copies of MTRIX records or struct_ncs_oper",
           preset.atoms.assembly},
          {"copies", "LIST",
           "copies of the assembly: numbers such as 1,7,20-25, or\n"
           "fold:N, those about the nearest N-fold axis, with copy 1",
           "all"},
          {"altloc", "A", "alternate location to take, or all", "highest occupancy"},
          {"no-hydrogens", nullptr, "drop hydrogens", ""},
          {"no-hetero", nullptr, "drop ligands and ions", ""},
          {"waters", nullptr, "keep waters", ""},
          {"radii", "SET", "van der Waals radii: a name of --list-radii, or a file",
           preset.atoms.radii},
          {"probe", "R", "probe radius [Å]", shortest(preset.probe)}}},
        {"Frames",
         {{"frames", "A-B:S",
           "a surface for every S-th frame from A to B: models of\n"
           "INPUT by their numbers, or frames of --trajectory; also\n"
           "A, A- (to the end), all; files name.0001.vdb, ...; -o\n"
           "name.csv: a table of all",
           ""},
          {"trajectory", "FILE", ".dcd or .xtc with the frames, its atoms those of INPUT", ""},
          {"start", "WORD",
           "cold: each frame as a run of its own; warm: its flow\n"
           "begins at the surface of the one before",
           "cold"}}},
        {"Surface",
         {{"surface", "KIND",
           "variational; ses, sas: solvent-excluded, -accessible;\n"
           "vdw: van der Waals; gaussian",
           nameOf(preset.kind)},
          {"voxel", "H", "edge of a voxel [Å], 0.05 to 10", shortest(preset.voxel)},
          {"blobbiness", "D", "decay of the Gaussians of --surface gaussian",
           shortest(preset.blobbiness)},
          {"fill-cavities", nullptr, "drop the inner walls", ""},
          {"fields", "LIST",
           "grids of the .vdb, by commas, or all of\n" + lines(knownFields()) +
               ";\ncurvatures also at the vertices of a .ply; positive\n"
               "where convex, 1/R on a ball; shape_index 1: a cap",
           "surface"},
          {"curvature-totals", nullptr, "integrate curvature over the surface, for the report",
           ""}}},
        {"Resolution",
         {{"epsilon", "E", "tolerance of the Gaussian sum [Å]; larger is smoother",
           shortest(preset.epsilon)},
          {"resolution", "[SEL=]D",
           "blur to D [Å], 1 to 50, all atoms or those of a\n"
           "selection; repeats, later ones win",
           "", true},
          {"coarse", "[SEL=]WORD",
           "beads in the place of atoms: residue (its backbone and\n"
           "side chain), N (about N atoms each) or atom; all or\n"
           "those of a selection; repeats, later ones win",
           "atom", true},
          {"match-volume", nullptr, "resolutions keep the volume of the fine surface", ""}}},
        {"Groups",
         {{"groups", "FILE", "groups of atoms: JSON, or lines NAME SELECTION [COLOUR]", ""},
          {"group-by", "WORD", "groups by chain, entity, copy or residues:N instead", ""},
          {"split", "group", "a level set and a closed mesh for every group, alone", ""},
          {"surface-of", "GROUP=KIND",
           "this group alone, by another --surface; repeats; the\n"
           "other atoms together",
           "", true},
          {"interfaces", nullptr, "buried areas between groups, for the report", ""},
          {"color", "WORD",
           "colours of the mesh and the grid Cd: chain, group,\n"
           "element, residue, mean-curvature, gaussian-curvature",
           nameOf(preset.color)}}},
        {"Scene",
         {{"for", "PROGRAM[=SCALE]",
           "blender, houdini or usd: a .vdb with density and Cd as\n"
           "that program takes it; SCALE mn-0.01, mn-0.1, nm, or\n"
           "units per Å; usd: a .usda beside the .vdb",
           ""},
          {"center", nullptr, "the middle of the surface comes to the origin", ""},
          {"print-scale", "S", ".stl, .obj, .3mf in mm, S of them per Å", ""},
          {"min-wall", "W", "thicken what is thinner than W mm; with --print-scale", ""}}},
        {"Picture",
         {{"view", "X,Y,Z",
           "direction toward the eye, or auto: the shortest extent\n"
           "toward the eye, the longest across",
           "auto"},
          {"turn", "A", "turned by so many degrees about the upright", "0"},
          {"size", "N", "width in pixels; the height follows the shape", "1200"},
          {"background", "COLOR", "as #rrggbb", "#ffffff"},
          {"legend", "WORD",
           "on or off; auto: beside colours, if 600 pixels wide\n"
           "or more",
           "auto"},
          {"turntable", "N", "N pictures round the upright: name.0001.png, ...", ""}}},
        {"Evolution",
         {{"lambda", "L", "weight of the regulariser [Å^2 for gradient, 1 for area]",
           shortest(preset.evolution.lambda)},
          {"regularizer", "KIND", "gradient or area", nameOf(preset.evolution.regularizer)},
          {"flow", "KIND", "preconditioned or plain", nameOf(preset.evolution.flow)},
          {"max-steps", "N", "steps at most", "50; plain: 2000"},
          {"steps", "N", "so many steps, converged or not", ""},
          {"tolerance", "T",
           "converged when the energy changes by less, relative\n"
           "(and the mean displacement is below sqrt(T) voxels)",
           shortest(preset.evolution.energyTolerance)},
          {"spline-level", "L", "spline on voxels of 2^L times the edge; 0, 1 or 2",
           std::to_string(preset.splineLevel)}}},
        {"Run",
         {{"memory", "SIZE",
           "memory at most, such as 4G: in bricks, one by one, if\n"
           "the whole takes more; the flow then takes --steps [" +
               std::to_string(defaultBrickSteps) + "]",
           ""},
          {"dry-run", nullptr, "say what it takes, and stop", ""},
          {"threads,j", "N", "threads at most", "all"},
          {"quiet,q", nullptr, "print errors only", ""},
          {"verbose,v", nullptr, "print the time of every stage", ""},
          {"no-progress", nullptr, "no progress bar", ""},
          {"config", "FILE", "options as lines \"name = value\"; the command line wins", ""}}},
        {"Information",
         {{"list-radii", nullptr, "print the radii sets and stop", ""},
          {"version,V", nullptr, "print the version and stop", ""},
          {"help,h", nullptr, "print this text and stop", ""}}}};
    return all;
}

const std::vector<Group>& batchGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"folder,O", "DIR", "where the files go, with the names of the structures", ""},
          {"formats", "LIST",
           "files to write, by commas: vdb, ply, obj, stl, off,\nglb, 3mf, html, json, png",
           "vdb,ply,json"},
          {"force", nullptr, "do all again, and replace existing files", ""}}}};
    return all;
}

const std::vector<Group>& planGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE", "the manifest, a name that ends in .json", ""},
          {"force", nullptr, "replace it", ""}}},
        {"Bricks",
         {{"bricks", "N", "how many, about as large each", ""},
          {"memory", "SIZE",
           "or as many as it takes for each to need no more,\n"
           "such as 500M or 4G",
           ""}}}};
    return all;
}

const std::vector<Group>& brickGroups()
{
    static const std::vector<Group> all = {
        {"Output", {{"force", nullptr, "do it again if it is done", ""}}}};
    return all;
}

const std::vector<Group>& mergeGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE",
           "file to write; repeats; the extension says what:\n"
           ".vdb level set and fields, .ply mesh, .json report",
           "", true},
          {"format", "WORD", "what -o - writes: vdb, ply or json", ""},
          {"force", nullptr, "replace existing files", ""}}}};
    return all;
}

namespace
{

// What compare has in the place of the group Output.
const std::vector<Group>& compareGroups()
{
    static const std::vector<Group> all = {
        {"Output (without -o the numbers are printed)",
         {{"output,o", "FILE",
           "file to write; repeats; the extension says what:\n"
           ".ply mesh of A with distances and colours,\n"
           ".vdb distances on the band of A, .json report;\n"
           "- is standard output",
           "", true},
          {"format", "WORD", "what -o - writes: ply, vdb or json", ""},
          {"force", nullptr, "replace existing files", ""},
          {"color", "WORD",
           "distance (viridis) or signed-distance (blue: A is\ninside B, red: outside)",
           "distance"},
          {"range", "D", "distance at the end of the colours [Å]",
           "that of 99 % of the vertices"}}}};
    return all;
}

// What mesh and color have in the place of the groups before Picture.
const std::vector<Group>& storedGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE",
           "file to write; repeats; the extension says what:\n"
           ".ply .obj .stl .off .glb .3mf mesh; .html page;\n"
           ".json report; .png picture; color: .vdb, the grids\n"
           "with Cd anew; - is standard output",
           "", true},
          {"format", "WORD", std::string("what -o - writes: ") + formatWords, ""},
          {"force", nullptr, "replace existing files", ""},
          {"color", "WORD",
           "chain, group (of grids chain_id, group_id), element,\n"
           "residue (of Cd so coloured), mean-curvature,\n"
           "gaussian-curvature; mesh: those of Cd unless given",
           ""},
          {"fields", "LIST", "curvatures for the vertices, as of vdb_molsurf --help", ""},
          {"print-scale", "S", ".stl, .obj, .3mf in mm, S of them per Å", ""}}}};
    return all;
}

} // namespace

std::string longName(const Entry& entry)
{
    const std::string name = entry.name;
    return name.substr(0, name.find(','));
}

std::vector<Group> groupsOf(Verb verb)
{
    if (verb == Verb::Build) return groups();
    // Options that plan a run are for the run of a molecule.
    const auto runGroup = [](Group group, bool partial) {
        const auto elsewhere = [&](const Entry& entry) {
            const std::string name = longName(entry);
            return name == "memory" || name == "dry-run" || (partial && name == "config");
        };
        group.entries.erase(std::remove_if(group.entries.begin(), group.entries.end(), elsewhere),
                            group.entries.end());
        return group;
    };
    if (verb == Verb::Mesh || verb == Verb::Color) {
        std::vector<Group> all = storedGroups();
        for (const Group& group : groups()) {
            const std::string title = group.title;
            if (title == "Run") all.push_back(runGroup(group, false));
            if (title == "Picture" || title == "Information") all.push_back(group);
        }
        return all;
    }
    const bool partial =
        verb == Verb::Brick || verb == Verb::Merge; // of a plan, which has the rest
    std::vector<Group> all = verb == Verb::Batch   ? batchGroups()
                             : verb == Verb::Plan  ? planGroups()
                             : verb == Verb::Brick ? brickGroups()
                             : verb == Verb::Merge ? mergeGroups()
                                                   : compareGroups();
    for (Group group : groups()) {
        const std::string title = group.title;
        const bool process = title == "Run" || title == "Information";
        if (title == "Output" || (partial && !process)) continue;
        if (title == "Frames") continue;
        if ((title == "Picture" || title == "Scene") && verb != Verb::Batch) continue;
        if (title == "Groups" && verb == Verb::Compare) continue;
        if (title == "Run") group = runGroup(group, partial);
        all.push_back(group);
    }
    return all;
}

std::vector<Group> shownGroups(Verb verb)
{
    std::vector<Group> all = groupsOf(verb);
    if (verb != Verb::Compare) return all;
    const auto hidden = [](const Entry& entry) {
        const std::string name = longName(entry);
        return name == "fields" || name == "curvature-totals";
    };
    for (Group& group : all) {
        group.entries.erase(std::remove_if(group.entries.begin(), group.entries.end(), hidden),
                            group.entries.end());
    }
    return all;
}

std::vector<OptionText> optionTexts(Verb verb)
{
    std::vector<OptionText> all;
    for (const Group& group : shownGroups(verb)) {
        for (const Entry& entry : group.entries) {
            const std::string name = entry.name, whole = longName(entry);
            all.push_back({group.title, whole,
                           whole.size() < name.size() ? name.substr(whole.size() + 1) : "",
                           entry.value ? entry.value : "", entry.text, entry.preset});
        }
    }
    return all;
}

std::size_t parseSize(const std::string& text)
{
    double number = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    if (problem != std::errc() || !std::isfinite(number) || number <= 0.0) return 0;
    const std::string unit(stop, end);
    const std::string letters = "KMGT";
    if (unit.empty()) return std::size_t(number);
    const std::size_t place = letters.find(unit[0]);
    const std::string rest = unit.substr(1);
    if (place == std::string::npos || !(rest.empty() || rest == "B" || rest == "iB")) return 0;
    return std::size_t(number * std::pow(1024.0, double(place + 1)));
}

} // namespace molsurf::tool
