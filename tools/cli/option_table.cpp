// SPDX-License-Identifier: MPL-2.0
#include "cli/option_table.h"

#include "terminal.h"

#include "molsurf/bricks.h"
#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/request/request_table.h"
#include "molsurf/request/run_metadata.h"
#include "molsurf/settings.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/surface/option_row.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace molsurf::tool
{

void usageError(const std::string& message)
{
    throw Error(ErrorKind::Usage, message);
}

using molsurf::nameOf;
using namespace std::string_literals;

namespace
{

using Values = std::vector<std::string>;

/// The option of a request, in its words on the command line.
/// @throws std::logic_error if there is none of this name
Option setting(const std::string& name, unsigned verbs)
{
    const OptionRow<Request>* row = findRow(requestTable(), name);
    if (!row) throw std::logic_error("no setting is named " + name);
    Option option = *row;
    option.text = withOptionNames(option.text);
    option.verbs = verbs;
    return option;
}

/// The option of some verbs.
Option of(unsigned verbs, Option option)
{
    option.verbs = verbs;
    return option;
}

/// A choice of two words, the second one the default.
template<typename Of>
Option either(const char* name, std::string help, const char* on, const char* off, const Of& of)
{
    Option o{name, SettingType::Word, "WORD", std::move(help), off, {off, on}};
    o.set = [=, words = o.words](CommandLine& call, const Values& v) {
        const std::string got = lowered(v.back());
        if (got != on && got != off)
            wrongValue(name, std::string(off) + " or " + on, v.back(), didYouMean(v.back(), words));
        of(call) = got == on;
    };
    return o;
}

void setView(CommandLine& call, const Values& values)
{
    const std::string& view = values.back();
    if (takeView(view, call.picture)) return;
    const std::string side = meaningOf(view, {{"front", "z"},
                                              {"back", "-z"},
                                              {"top above", "y"},
                                              {"bottom below", "-y"},
                                              {"right side", "x"},
                                              {"left", "-x"}});
    if (!(call.verb & (Build | Batch)) || !side.empty())
        wrongValue("view", "auto, a direction X,Y,Z, an axis as z or a FILE.view", view,
                   side.empty() ? "" : meant(side));
    call.viewed = view;
}

// Sets of verbs.
constexpr unsigned surfaces = Build | Batch | BricksPlan;           // they build surfaces
constexpr unsigned structures = surfaces | Compare;                 // they read structures
constexpr unsigned wholes = Build | Batch;                          // of whole molecules
constexpr unsigned files = Build | Compare | Convert | BricksMerge; // with -o
constexpr unsigned runs = 0xff & ~Info;
/// The formats that a verb writes to one place.
Values formatsOf(unsigned verb)
{
    Values words;
    for (const Format& format : formatTable())
        if ((format.verbs & verb) && format.write && (format.holds & (Stage | Moving)) == 0)
            words.push_back(format.word);
    return words;
}

/// The option --output of some verbs.
Option outputOption(unsigned verbs, std::string text)
{
    Option o{"output", SettingType::Rules, "FILE", std::move(text), ""};
    o.letter = 'o';
    o.set = [](CommandLine& call, const Values& values) {
        call.paths = values;
        for (std::string& path : call.paths) // one name for one thing
            if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1")
                path = "-";
        call.given["output"] = call.paths;
    };
    return of(verbs, o);
}

/// The option --format of some verbs, with the formats of one of them.
Option formatOption(Verb verb, unsigned verbs)
{
    const Values known = formatsOf(verb);
    Option o{"format", SettingType::Word, "WORD", "what -o - writes: one of\n" + inLines(known), "",
             known};
    o.set = [=](CommandLine& call, const Values& values) {
        call.format = lowered(values.back());
        if (!std::count(known.begin(), known.end(), call.format))
            wrongValue("format", joinWords(known, ", "), values.back(),
                       didYouMean(values.back(), known));
    };
    return of(verbs, o);
}

OptionGroup outputOptions()
{
    const auto written = [&](Verb verb, const char* more) {
        const std::string all = withOptionNames(filesOf(verb)) + "; - is standard output" + more;
        return outputOption(verb, "file to write; repeats; the extension says what:\n" +
                                      wrapped(all, helpWidth));
    };
    const auto force = [](unsigned verbs, const char* text) {
        return of(verbs, switchRow<CommandLine>("force", text, MOLSURF_OF(force)));
    };
    Option folder = textRow<CommandLine>(
        {"folder", "DIR", "where the files go, with the names of the structures"},
        MOLSURF_OF(folder));
    folder.letter = 'O';
    const std::string several = "files to write, by commas, of\n";
    const Option shown =
        either("color", "distance (OrRd) or signed-distance (blue: A is\ninside B, red: outside)",
               "signed-distance", "distance", MOLSURF_OF(colorBySign));
    Option palette = setting("palette", Compare);
    palette.preset = "that of --color";
    palette.get = nullptr; // meshes have colours, too
    return {
        "Output",
        {written(Build, ""), written(Convert, "; .vdb with --color"),
         written(
             Compare,
             "; mesh and level set are those of A with distances; without it numbers are printed"),
         outputOption(BricksPlan, "the manifest, a name that ends in .json"),
         written(BricksMerge, ""), of(Batch, folder),
         of(Batch, textRow<CommandLine>({"formats", "LIST", several + inLines(formatsOf(Batch)),
                                         CommandLine().formats},
                                        MOLSURF_OF(formats))),
         formatOption(Build, Build), formatOption(Convert, Convert),
         formatOption(Compare, Compare | BricksMerge),
         force(files | BricksPlan, "replace existing files"),
         force(Batch, "do all again, and replace existing files"),
         force(BricksRun, "do it again if it is done"),
         of(Build,
            switchRow<CommandLine>("skip-existing",
                                   "do nothing if the files are of the same input, options and\n"
                                   "version, by the report; make and replace them otherwise",
                                   MOLSURF_OF(skipExisting))),
         of(Compare, shown), palette,
         of(Compare, numberRow<CommandLine>({"range", "D", "distance at the end of the colours [Å]",
                                             "that of 99 % of the vertices"},
                                            {1e-300, 1e300, "a positive number of Å"},
                                            MOLSURF_OF(colorRange)))},
        {{"vdb_molsurf 1crn.pdb -o 1crn.vdb -o 1crn.ply -o 1crn.json",
          "level set, mesh and report of one surface"},
         {"vdb_molsurf 1crn.pdb -o - --format ply > 1crn.ply", "a mesh on standard output"}}};
}

Option superposeOption()
{
    Option superpose =
        textRow<CommandLine>({"superpose", "SEL",
                              "lay B on A, structures of --panel on INPUT or frames on the\n"
                              "first one, by these atoms where chain, number and name are\n"
                              "the same, such as \"chain A and name CA\"; auto: by CA and C4'"},
                             MOLSURF_OF(superpose));
    superpose.words = {"auto"};
    superpose.get = [](const CommandLine& c) { return c.superpose.empty() ? "none" : c.superpose; };
    return of(Build | Compare, superpose);
}

OptionGroup atomOptions()
{
    return {"Atoms",
            {setting("select", structures), setting("model", structures),
             setting("assembly", structures), setting("instances", Build),
             setting("by-symmetry", Build), setting("copies", structures),
             setting("altloc", structures), setting("no-hydrogens", structures),
             setting("ions", structures), setting("hetero", structures),
             setting("no-hetero", structures), setting("waters", structures),
             setting("radii", structures), setting("probe", structures), superposeOption(),
             setting("max-input", structures | Info)},
            {{"vdb_molsurf 4hhb.cif.gz --select \"chain A or within 5 of resn HEM\" -o part.ply",
              "some of the atoms"},
             {"vdb_molsurf 1a8o.cif.gz --assembly 1 -o dimer.ply", "the biological assembly"}}};
}

OptionGroup frameOptions()
{
    return {
        "Frames",
        {of(Build, textRow<CommandLine>({"frames", "A-B:S",
                                         "a surface for every S-th frame from A to B: models of\n"
                                         "INPUT by their numbers, or frames of --trajectory; also\n"
                                         "A, A- (to the end), all; files name.0001.vdb, ...; -o\n"
                                         "name.csv: a table of all"},
                                        MOLSURF_OF(frames))),
         of(Build, ofFile(textRow<CommandLine>(
                       {"trajectory", "FILE",
                        ".dcd, .xtc, .trr or .nc with the frames, its atoms those of INPUT"},
                       MOLSURF_OF(trajectory)))),
         of(Build,
            switchRow<CommandLine>("update-selections",
                                   "selections by distance, as within 5 of resn HEM, are those\n"
                                   "of each frame, and not of the first",
                                   MOLSURF_OF(updateSelections))),
         of(Build, countRow<CommandLine>({"first-frame", "N",
                                          "number of the first file, such as 1001: "
                                          "name.1001.vdb, ...",
                                          "1"},
                                         0, 999999, MOLSURF_OF(firstFrame))),
         setting("fps", Build)},
        {{"vdb_molsurf 1d3z.pdb.gz --frames 1-4 -o 1d3z.ply", "a mesh for each of four models"},
         {"vdb_molsurf top.pdb --trajectory run.xtc --frames all --superpose auto -o film.mp4",
          "a film of a trajectory, each frame laid on the first"}}};
}

/// The voxels of --lod.
void setLevels(CommandLine& call, const Values& values)
{
    const std::string expected = "2 to 8 ascending voxels by commas [Å], such as 1,2,4";
    call.lod.clear();
    for (const std::string& word : splitWords(values.back())) {
        const double voxel = parsedValue<double>("lod", expected, word);
        if (!(voxel > (call.lod.empty() ? 0.0 : call.lod.back())))
            wrongValue("lod", expected, values.back());
        call.lod.push_back(voxel);
    }
    if (call.lod.size() < 2 || call.lod.size() > 8) wrongValue("lod", expected, values.back());
}

OptionGroup surfaceOptions()
{
    Option attributes = setting("fields", Convert);
    attributes.text =
        "curvatures for the vertices of a .ply or .glb, by commas,\nas of vdb_molsurf --help";
    Option levels{"lod", SettingType::List, "LIST",
                  "with --instances: voxels such as 1,2,4 in the place of\n"
                  "--voxel, a mesh each; the .html shows the finest that is\n"
                  "worth it, in .glb and .usda the first one is the default",
                  ""};
    levels.set = setLevels;
    levels.get = [](const CommandLine& c) {
        Values all;
        for (const double voxel : c.lod) all.push_back(shortest(voxel));
        return all.empty() ? "none" : joinWords(all, ",");
    };
    const Option iso =
        numberRow<CommandLine>({"iso", "V",
                                "of a map: the level set where it has this value, negative\n"
                                "where it has more, or, of V below 0, less; else fog"},
                               {-1e30, 1e30, "a number"}, MOLSURF_OF(iso));
    return {"Surface",
            {setting("surface", structures), setting("voxel", structures),
             of(Build, shownIn(Levels, levels)), of(Convert, iso),
             setting("blobbiness", structures), setting("fill-cavities", wholes | Compare),
             setting("pieces", Build), setting("remesh", wholes | Convert),
             setting("density", wholes | Convert), setting("adapt", wholes | Convert),
             setting("fields", surfaces), attributes, shownIn(Grids, setting("vdb-half", surfaces)),
             shownIn(Numbers, setting("curvature-totals", wholes)),
             shownIn(Numbers, setting("measures", wholes))},
            {{"vdb_molsurf 1crn.pdb --surface ses --voxel 0.25 -o 1crn.ply",
              "the solvent-excluded surface, fine"},
             {"vdb_molsurf 1crn.pdb --fields mean_curvature -o 1crn.vdb -o 1crn.ply",
              "mean curvature as a grid and at vertices"}}};
}

OptionGroup resolutionOptions()
{
    return {"Resolution",
            {setting("epsilon", structures), setting("lambda", structures),
             setting("match", structures), setting("resolution", structures),
             setting("coarse", structures), setting("match-volume", wholes | Compare)},
            {{"vdb_molsurf 1crn.pdb --lambda 0.02 -o 1crn.ply", "more tension: smoother"},
             {"vdb_molsurf 4at1.ent.gz --resolution 8 -o blurred.glb", "blurred to 8 Å"},
             {"vdb_molsurf 4at1.ent.gz --coarse residue -o beads.glb",
              "two beads in the place of each residue"}}};
}

/// The colours that convert can give, and their words in help texts.
std::vector<ColorBy> storableColors()
{
    std::vector<ColorBy> colors = completeColors();
    for (const ColorBy found : {ColorBy::Pocket, ColorBy::Patch}) // on the atoms
        colors.erase(std::remove(colors.begin(), colors.end(), found), colors.end());
    return colors;
}

Values storableColorHelp()
{
    Values words = colorHelp();
    for (const ColorBy found : {ColorBy::Pocket, ColorBy::Patch})
        words.erase(std::remove(words.begin(), words.end(), nameOf(found)), words.end());
    return words;
}

OptionGroup colorOptions()
{
    Option shown =
        wordRow<CommandLine>("color",
                             wrapped(joinWords(storableColorHelp(), ", ") +
                                         "; chain and group are of grids chain_id and group_id, "
                                         "the others of Cd so coloured or of the mesh; those of "
                                         "Cd unless given",
                                     helpWidth),
                             storableColors(), MOLSURF_OF(options.color));
    shown.preset = "";
    return {"Colours",
            {setting("color", surfaces), of(Convert, shown), setting("range", surfaces | Convert),
             setting("palette", surfaces | Convert), setting("value-of", surfaces),
             setting("flat-values", surfaces), setting("smooth-colors", wholes),
             setting("potential-offset", surfaces), setting("plain-color", wholes | Convert),
             setting("sharp-colors", Build)},
            {{"vdb_molsurf 4hhb.cif.gz --color chain -o chains.png", "a colour for each chain"},
             {"vdb_molsurf 1ubq.pdb --color bfactor --range 0,40 -o b.glb",
              "B factors from 0 to 40 Å^2"}}};
}

OptionGroup groupOptions()
{
    Option groups = ofFile(textRow<CommandLine>(
        {"groups", "FILE", "groups of atoms: JSON, or lines NAME SELECTION [COLOUR]"},
        MOLSURF_OF(groupsFile)));
    groups.get = [](const CommandLine& c) {
        Values all;
        for (const GroupRule& group : c.labels.groups)
            all.push_back(group.name + " " + group.select);
        return joinWords(all, ", ");
    };
    return {"Groups",
            {of(surfaces, groups), setting("group-by", surfaces), setting("split", wholes),
             setting("surface-of", wholes), setting("interfaces", wholes)},
            {{"vdb_molsurf 4hhb.cif.gz --group-by chain --split group -o chains.glb",
              "a surface for each chain"},
             {"vdb_molsurf 4hhb.cif.gz --surface sas --interfaces -o buried.json",
              "the area that each pair of chains buries"}}};
}

OptionGroup areaOptions()
{
    Option areas{"areas",
                 SettingType::List,
                 "LIST",
                 "tables for the report, by commas: atoms, residues,\ncontacts, interfaces, "
                 "pockets, patches,\npore, tunnels, forces",
                 "",
                 areaTables()};
    areas.set = [](CommandLine& call, const Values& values) {
        call.areas = splitWords(lowered(values.back()));
        for (const std::string& table : call.areas)
            if (std::count(areaTables().begin(), areaTables().end(), table) == 0)
                wrongValue("areas", "some of " + joinWords(areaTables(), ", "), values.back(),
                           didYouMean(table, areaTables()));
    };
    return {"Areas",
            {of(wholes, shownIn(Numbers, areas)), shownIn(0, setting("contacts", wholes)),
             setting("patches", wholes)},
            {{"vdb_molsurf 1ubq.pdb --patches \"hydrophobicity>0\" -o 1ubq.patches.csv",
              "connected hydrophobic parts of the surface"},
             {"vdb_molsurf 1ubq.pdb -o 1ubq.residues.csv", "accessible area of each residue"},
             {"vdb_molsurf 4hhb.cif.gz -o 4hhb.contacts.csv --contacts chain",
              "contact areas between chains"}}};
}

OptionGroup pocketOptions()
{
    return {"Pockets",
            {setting("pockets", wholes), setting("pocket-at", wholes), setting("probe-in", wholes),
             setting("probe-out", wholes), setting("pocket-cut", wholes),
             setting("pocket-neck", wholes)},
            {{"vdb_molsurf 4hhb.cif.gz -o 4hhb.pockets.csv", "volume and mouths of each pocket"},
             {"vdb_molsurf 4hhb.cif.gz --pocket-at \"resn HEM\" --color pocket -o site.png",
              "a picture of the pockets around the haems"}}};
}

OptionGroup poreOptions()
{
    return {
        "Pores",
        {setting("pore", wholes), setting("tunnels-from", wholes), setting("tunnel-probe", wholes)},
        {{"vdb_molsurf 1grm.pdb.gz --pore auto -o 1grm.pore.csv",
          "radius and lining along the channel"},
         {"vdb_molsurf 1grm.pdb.gz --pore auto --view x -o 1grm.png",
          "a picture across the channel"},
         {"vdb_molsurf 1grm.pdb.gz --tunnels-from \"resid 1\" -o 1grm.tunnels.csv",
          "the ways out of its middle"}}};
}

OptionGroup sceneOptions()
{
    Option center = setting("center", wholes);
    center.shownIn = 0; // pictures look the same
    return {
        "Scene",
        {setting("for", wholes), setting("fog-density", wholes), setting("ids", wholes),
         setting("one-box", wholes), setting("mips", wholes), center},
        {{"vdb_molsurf 1crn.pdb --for blender -o 1crn.vdb", "a volume with colours for Blender"},
         {"vdb_molsurf 1crn.pdb --for usd --center -o 1crn.vdb", "a volume and its stage of USD"}}};
}

OptionGroup printOptions()
{
    Option wall = setting("min-thickness", wholes); // in mm here
    wall.text = "thicken what is thinner than W mm; with --print-scale";
    wall.set =
        numberSetter("min-thickness", 1e-300, 1e300, "a positive number of mm", MOLSURF_OF(wall));
    return {"Print",
            {setting("print-scale", wholes | Convert), wall},
            {{"vdb_molsurf 1crn.pdb --print-scale 2 -o 1crn.3mf", "a print of 2 mm per Å"},
             {"vdb_molsurf 1crn.pdb --print-scale 2 --min-thickness 1 --pieces outer -o 1crn.stl",
              "no wall thinner than 1 mm, without cavities"}}};
}

OptionGroup solverOptions()
{
    return {"Electrostatics",
            {setting("apbs-grid", Build), setting("pdie", Build), setting("sdie", Build),
             setting("ion-conc", Build)},
            {{"vdb_molsurf molecule.pqr --for apbs -o run/", "input, charges and maps for APBS"},
             {"vdb_molsurf molecule.pqr --match ses --for apbs --ion-conc 0.15 -o run/",
              "the same with a smooth boundary, in 0.15 mol/L of salt"}}};
}

OptionGroup tomogramOptions()
{
    constexpr unsigned both = Build | Batch;
    return {"Tomograms",
            {setting("pixel-size", both), setting("box-size", both), setting("mask-extend", both),
             setting("mask-edge", both), setting("invert-density", both)},
            {{"vdb_molsurf 1crn.pdb --resolution 8 --pixel-size 2.5 -o 1crn.density.mrc",
              "a template for RELION, pytom-match-pick, cryoCAT"},
             {"vdb_molsurf 1crn.pdb --pixel-size 2.5 --mask-edge 4 -o 1crn.mask.mrc",
              "a mask around the surface with a soft edge"}}};
}

constexpr std::size_t fewPockets = 8; // that can be told apart

/// How many pockets "pockets", "pockets=N" or "pockets=all" shows; 0: the text is none of these.
std::size_t pocketsIn(const std::string& text)
{
    const std::string word = lowered(text), start = "pockets=";
    if (word == "pockets") return fewPockets;
    if (word.rfind(start, 0) != 0) return 0;
    const std::string number = word.substr(start.size());
    std::size_t count = 0;
    if (number == "all") return std::numeric_limits<std::size_t>::max();
    if (!parseWhole(number, count) || count == 0)
        wrongValue("show", "pockets, pockets=N with N from 1, or pockets=all", text);
    return count;
}

/// The words of styles and what they mean.
Option showOption()
{
    Values all;
    for (const AtomStyle& row : atomStyles()) all.push_back(row.word + ": "s + row.help);
    all.push_back("or pockets: the bodies of the " + std::to_string(fewPockets) +
                  " largest, in pages too; pockets=N, pockets=all");
    Option show = rulesRow<CommandLine>(
        {"show", "[SEL=]WORD",
         wrapped("atoms beside the surface, whole and opaque, such as \"(HEM)=sticks\", with "
                 "carbon in the colour of its chain, or sticks,golden, or all of them in one, as "
                 "sticks,#ff0000; spheres,others: those of the copies that --copies leaves out, "
                 "coloured as the surface; repeats; " +
                     joinWords(all, "; "),
                 helpWidth)},
        [](CommandLine& call, const std::string& value) {
            if (const std::size_t count = pocketsIn(value))
                call.shownPockets = count;
            else
                call.shows.push_back(parseShow(value, {"pockets"}));
        });
    for (const AtomStyle& row : atomStyles()) show.words.push_back(row.word);
    show.words.push_back("spheres,others");
    show.words.push_back("pockets");
    return of(wholes, shownIn(Pixels | ColorChoices, show));
}

/// The kind of surface that a word names.
std::optional<SurfaceKind> surfaceKindOf(const std::string& word)
{
    for (const KindRow& row : kindTable())
        if (lowered(word) == row.word) return row.kind;
    return std::nullopt;
}

/// The further picture that a value of --panel asks for.
Panel panelOf(const std::string& value)
{
    const auto way = directionOf(value);
    if (value.empty() || (way && !(way->length() > 0.0 && std::isfinite(way->length()))))
        wrongValue("panel", "a file or a direction X,Y,Z that is not 0, or a kind of surface",
                   value);
    const auto kind = surfaceKindOf(value);
    std::error_code ignored;
    const std::string hint =
        way || kind || std::filesystem::exists(value, ignored) ? "" : kindMeant(value);
    if (!hint.empty()) wrongValue("panel", "a file, a direction or a kind of surface", value, hint);
    if (way) return {"", *way};
    return kind ? Panel{"", openvdb::Vec3d(0.0), kind} : Panel{value};
}

Option panelOption()
{
    Option panel = rulesRow<CommandLine>(
        {"panel", "WHAT",
         "a further picture beside the first, with its camera, scale\n"
         "and legend: the FILE of another structure, or the same one\n"
         "from X,Y,Z or with a surface of another KIND; a page shows\n"
         "files and kinds side by side or in turn; repeats"},
        [](CommandLine& call, const std::string& value) { call.panels.push_back(panelOf(value)); });
    panel.file = [](const std::string& value) {
        const bool names = !directionOf(value) && !surfaceKindOf(value);
        return std::string_view(value).substr(names ? 0 : value.size());
    };
    return of(Build, shownIn(Pixels | ColorChoices, panel));
}

/// An option that adds to the notes of pictures.
Option noteOption(const char* name, const char* argument, const char* help,
                  NoteText (*parse)(const std::string& text))
{
    return of(wholes, shownIn(Pixels, rulesRow<CommandLine>(
                                          {name, argument, help},
                                          [=](CommandLine& call, const std::string& value) {
                                              call.notes.push_back(parse(value));
                                          })));
}

Option labelOption()
{
    return noteOption("label", "SEL=TEXT",
                      "a text at the middle of atoms, such as \"A/57=active site\";\n"
                      "X,Y,Z=TEXT at a place in Å; SEL alone: chain, name and\n"
                      "number of its residue; repeats",
                      labelText);
}

Option rulerOption()
{
    return noteOption("ruler", "SEL..SEL",
                      "a line between the middles of atoms, or places X,Y,Z, with\n"
                      "its length, such as \"A/57/NE2..A/195/OG\"; repeats",
                      rulerText);
}

OptionGroup pictureOptions()
{
    constexpr unsigned draw = wholes | Convert | Compare;
    Option view = setting("view", draw);
    view.set = setView;
    Option zoom = setting("zoom", wholes);
    zoom.set = [](CommandLine& call, const Values& values) {
        call.zoomed = takeZoom(values.back(), call.picture) ? "" : values.back();
    };
    return {"Picture",
            {view, zoom, setting("up", draw), setting("turn", draw), setting("size", draw),
             setting("background", draw), setting("style", draw), showOption(), labelOption(),
             rulerOption(), panelOption(), setting("opacity", draw), setting("show-behind", draw),
             setting("clip", draw), setting("depth-cue", draw), setting("legend", draw),
             setting("scale-bar", draw), setting("dpi", draw), setting("turntable", draw)},
            {{"vdb_molsurf 4hhb.cif.gz --color chain --show \"resn HEM=sticks\" --opacity 0.5 "
              "-o haems.png",
              "ligands behind a translucent surface"},
             {"vdb_molsurf 1crn.pdb --turntable 36 -o turn.gif", "a film of one turn"}}};
}

/// For comparison and for old programs.
OptionGroup comparisonOptions()
{
    return {"Comparison",
            {setting("regularizer", structures), setting("flow", structures),
             setting("max-steps", structures & ~BricksPlan),
             with(setting("steps", structures),
                  [](Option& o) {
                      o.preset = std::to_string(BrickPlan::defaultSteps) + " in bricks, " +
                                 std::to_string(BrickPlan::defaultFrontSteps) +
                                 " at a large lambda";
                  }),
             setting("tolerance", structures), setting("spline-level", wholes | Compare),
             setting("weld", Build)},
            {{"vdb_molsurf 1crn.pdb --flow newton -v -o 1crn.json", "explicit steps"}}};
}

Option requireOption()
{
    Option required{"require",
                    SettingType::List,
                    "LIST",
                    "what the mesh has to be, or nothing is written and the\n"
                    "status is 3: watertight, manifold, components=N, cavities=N,\n"
                    "genus=N, min-angle=DEGREES",
                    "",
                    requirementWords()};
    required.set = [](CommandLine& call, const Values& values) {
        const auto parsed = parseRequirements(values.back());
        if (!parsed)
            wrongValue("require",
                       "some of " + joinWords(requirementWords(), ", ") + " with numbers",
                       values.back(),
                       didYouMean(values.back(), requirementWords(),
                                  {{"closed watertightness", "watertight"},
                                   {"connected one-piece", "components=1"}}));
        call.required = *parsed;
    };
    return of(wholes, required);
}

Option threadsOption()
{
    Option threads = countRow<CommandLine>({"threads", "N", "threads at most", "all"}, 1, 4096,
                                           MOLSURF_OF(threads));
    threads.letter = 'j';
    threads.set = [set = threads.set](CommandLine& call, const Values& values) {
        const std::string word = lowered(values.back());
        if (word == "0" || word == "-1" || word == "all" || word == "auto" || word == "max")
            wrongValue("threads", "a whole number from 1 to 4096", values.back(),
                       " [hint: all cores are used without `threads`]");
        set(call, values);
    };
    return of(runs, threads);
}

Option memoryOption(unsigned verbs, std::string text)
{
    Option o{"memory", SettingType::Text, "SIZE", std::move(text), ""};
    o.set = [](CommandLine& call, const Values& values) {
        call.memory = sizeValue("memory", values.back());
        constexpr std::size_t least = 1024; // a number without its unit
        if (call.memory < least)
            wrongValue("memory", "a size such as 500M or 4G", values.back(),
                       meant(values.back() + "G"));
    };
    return of(verbs, o);
}

OptionGroup runOptions()
{
    const auto flag = [](unsigned verbs, const char* name, char letter, const char* text,
                         const auto& member, bool on = true) {
        Option o = switchRow<CommandLine>(name, text, member, on);
        o.letter = letter;
        return of(verbs, o);
    };
    return {"Run",
            {of(BricksPlan,
                countRow<CommandLine>({"bricks", "N", "how many bricks, about as large each"}, 1,
                                      1000000, MOLSURF_OF(bricks))),
             memoryOption(BricksPlan, "or as many bricks as it takes for each to need no more,\n"
                                      "such as 500M or 4G"),
             memoryOption(Build, "memory at most, such as 4G: in bricks, one by one, if\n"
                                 "the whole takes more; the flow then takes so many --steps"),
             of(Build | Batch | Compare | Convert | BricksRun,
                numberRow<CommandLine>(
                    {"max-hours", "H", "refuse what is estimated to take more hours", "24"},
                    {1e-6, 1e6, "hours, from 1e-6 to 1e6"}, MOLSURF_OF(hours))),
             flag(Build | Compare | Convert, "dry-run", 0,
                  "print the estimated time and memory, and stop", MOLSURF_OF(dryRun)),
             requireOption(), threadsOption(),
             flag(runs, "quiet", 'q', "print errors only", MOLSURF_OF(quiet)),
             flag(Build | Batch | Compare | Convert | BricksMerge, "verbose", 'v',
                  "print the time of every stage", MOLSURF_OF(verbose)),
             flag(runs, "no-progress", 0, "no progress bar", MOLSURF_OF(progress), false),
             of(structures | Convert,
                ofFile(textRow<CommandLine>(
                    {"config", "FILE", "options as lines \"name = value\"; the command line wins"},
                    MOLSURF_OF(config))))},
            {{"vdb_molsurf 4v5a.cif.gz --dry-run -o 4v5a.ply", "estimated time and memory"},
             {"vdb_molsurf 4v5a.cif.gz --memory 4G -j 8 -o 4v5a.ply",
              "at most 4 GiB and eight threads"}}};
}

} // namespace

const std::vector<OptionGroup>& optionTable()
{
    static const std::vector<OptionGroup> all = {
        outputOptions(),     atomOptions(),     frameOptions(),   surfaceOptions(),
        resolutionOptions(), groupOptions(),    colorOptions(),   areaOptions(),
        pocketOptions(),     poreOptions(),     sceneOptions(),   printOptions(),
        solverOptions(),     tomogramOptions(), pictureOptions(), runOptions(),
        comparisonOptions()};
    return all;
}

std::vector<OptionGroup> optionGroups(unsigned verb)
{
    const auto text = [](unsigned verbs, const char* name, char letter, const char* help) {
        Option o{name, SettingType::Switch, nullptr, help, ""};
        o.letter = letter;
        return of(verbs, o);
    };
    std::vector<OptionGroup> groups = optionTable();
    groups.push_back({"Information",
                      {text(Build, "list-radii", 0, "print the radii sets and stop"),
                       text(0xff, "version", 'V', "print the version and stop"),
                       text(0xff, "help", 'h', "print the common options and stop"),
                       text(0xff, "help-all", 0, "print all options and stop")}});
    for (OptionGroup& group : groups) {
        std::vector<Option>& options = group.options;
        options.erase(std::remove_if(options.begin(), options.end(),
                                     [=](const Option& o) { return !(o.verbs & verb); }),
                      options.end());
    }
    groups.erase(std::remove_if(groups.begin(), groups.end(),
                                [](const OptionGroup& group) { return group.options.empty(); }),
                 groups.end());
    return groups;
}

bool isCalled(const Option& option, const std::string& name)
{
    return option.isNamed(name) || (option.letter && name == std::string(1, option.letter));
}

const Option* findOption(Verb verb, const std::string& name)
{
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if ((option.verbs & verb) && isCalled(option, name)) return &option;
    return nullptr;
}

std::vector<OptionFile> filesOf(Verb verb, const GivenOptions& given)
{
    std::vector<OptionFile> files;
    for (const auto& [name, values] : given) {
        const Option* option = findOption(verb, name);
        if (!option || !option->file) continue;
        for (const std::string& value : values)
            if (const auto path = option->file(value); !path.empty())
                files.push_back({option, std::string(path)});
    }
    return files;
}

void addOptions(const CommandLine& call, openvdb::MetaMap& map)
{
    const auto add = [&](const std::string& name, const openvdb::Metadata& value) {
        map.insertMeta("option." + name, value);
    };
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if (option.get && (option.verbs & Build))
                add(option.name, *metadataOf(option.get(call)));
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->get && !readsOnce(file.path))
            add(file.option->name + ".sha256"s, openvdb::StringMetadata(sha256OfFile(file.path)));
}

} // namespace molsurf::tool
