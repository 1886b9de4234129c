// SPDX-License-Identifier: MPL-2.0
#include "cli/option_table.h"

#include "sha256.h"
#include "terminal.h"

#include "molsurf/bricks.h"
#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/request/run_metadata.h"
#include "molsurf/settings.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/surface/set_value.h"

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

// Options by the type of their value, which is not stored in files (Option::stored). `of` gives the
// variable of a call that the option sets: MOLSURF_OF(options.voxel).

openvdb::Metadata::Ptr stored(const std::string& text)
{
    return openvdb::StringMetadata(text).copy();
}

/// The option of a setting of the library.
/// @throws std::logic_error if there is none of this name
Option setting(const std::string& name, unsigned verbs)
{
    for (const Setting& row : settingTable()) {
        if (row.name != name) continue;
        Option o{row.name, 0, row.value, withOptionNames(row.text), row.preset, verbs, row.words};
        o.repeats = row.type == SettingType::Rules;
        o.set = row.set;
        o.file = row.file;
        if (row.get)
            o.stored = [&row](const CommandLine& call) { return metadataOf(row.get(call)); };
        return o;
    }
    throw std::logic_error("no setting is named " + name);
}

/// The option of a row of pictures or files, or null.
template<typename To>
std::optional<Option> optionOf(const std::vector<SettingRow<To>>& rows, const std::string& name,
                               unsigned verbs)
{
    const SettingRow<To>* row = findRow(rows, name);
    if (!row) return std::nullopt;
    Option o{row->name, 0, row->value, withOptionNames(row->text), row->preset, verbs, row->words};
    o.set = row->set;
    o.shownIn = row->shownIn;
    if (row->get) o.stored = [row](const CommandLine& call) { return metadataOf(row->get(call)); };
    return o;
}

/// The option of a row of pictures or files.
/// @throws std::logic_error if there is none of this name
Option fileOption(const std::string& name, unsigned verbs)
{
    if (const auto o = optionOf(pictureSettings(), name, verbs)) return *o;
    if (const auto o = optionOf(fileSettings(), name, verbs)) return *o;
    throw std::logic_error("no setting of files is named " + name);
}

/// A number in a range that the library does not check.
template<typename Of>
Option number(const char* name, const char* value, std::string text, std::string preset,
              unsigned verbs, double low, double high, const char* range, const Of& of)
{
    Option o{name, 0, value, std::move(text), std::move(preset), verbs};
    o.set = numberSetter(name, low, high, range, of);
    return o;
}

template<typename Of>
Option count(const char* name, const char* value, std::string text, std::string preset,
             unsigned verbs, int low, int high, const Of& of)
{
    Option o{name, 0, value, std::move(text), std::move(preset), verbs};
    o.set = countSetter(name, low, high, of);
    return o;
}

/// @param[in] on  what the switch sets
template<typename Of>
Option flag(const char* name, std::string text, unsigned verbs, const Of& of, bool on = true)
{
    Option o{name, 0, nullptr, std::move(text), "", verbs};
    o.set = [=](CommandLine& call, const Values&) { of(call) = on; };
    return o;
}

template<typename Of>
Option text(const char* name, const char* value, std::string help, unsigned verbs, const Of& of)
{
    Option o{name, 0, value, std::move(help), "", verbs};
    o.set = [=](CommandLine& call, const Values& v) { of(call) = v.back(); };
    return o;
}

/// One of a few values that nameOf() names.
template<typename Of, typename Enum>
Option word(const char* name, const char* value, std::string help, unsigned verbs, const Of& of,
            const std::vector<Enum>& choices)
{
    const CommandLine preset;
    Option o{name, 0, value, std::move(help), nameOf(of(preset)), verbs};
    for (const Enum choice : choices) o.words.push_back(nameOf(choice));
    o.set = wordSetter(name, choices, of);
    return o;
}

/// A choice of two words, the second one the default.
template<typename Of>
Option either(const char* name, std::string help, const char* on, const char* off, unsigned verbs,
              const Of& of)
{
    Option o{name, 0, "WORD", std::move(help), off, verbs, {off, on}};
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

/// Option::file of a value that is a path.
std::size_t wholeValue(const std::string&)
{
    return 0;
}

/// The option of a file that is read, whose path is its value.
Option ofFile(Option option)
{
    option.file = wholeValue;
    return option;
}

/// The option of a switch that files have.
template<typename Of>
Option kept(const Of& of, Option option)
{
    option.stored = [=](const CommandLine& call) { return openvdb::BoolMetadata(of(call)).copy(); };
    return option;
}

/// The option of a number that files have.
template<typename Of>
Option numberKept(const Of& of, Option option)
{
    option.stored = [=](const CommandLine& call) {
        return openvdb::DoubleMetadata(of(call)).copy();
    };
    return option;
}

/// The option with more than its type says.
Option with(Option option, const std::function<void(Option&)>& change)
{
    change(option);
    return option;
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

/// The option with the formats that show it.
Option shownIn(unsigned formats, Option option)
{
    option.shownIn = formats;
    return option;
}

OptionGroup outputOptions()
{
    const auto output = [](unsigned verbs, std::string text) {
        Option o{"output", 'o', "FILE", std::move(text), "", verbs, {}, true};
        o.set = [](CommandLine& call, const Values& values) {
            call.paths = values;
            for (std::string& path : call.paths) // one name for one thing
                if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1")
                    path = "-";
            call.given["output"] = call.paths;
        };
        return o;
    };
    const auto written = [&](Verb verb, const char* more) {
        const std::string all = withOptionNames(filesOf(verb)) + "; - is standard output" + more;
        return output(verb, "file to write; repeats; the extension says what:\n" +
                                wrapped(all, helpWidth));
    };
    const auto format = [](Verb verb, unsigned verbs) {
        const Values known = formatsOf(verb);
        Option o{"format", 0,     "WORD", "what -o - writes: one of\n" + inLines(known),
                 "",       verbs, known};
        o.set = [=](CommandLine& call, const Values& values) {
            call.format = lowered(values.back());
            if (!std::count(known.begin(), known.end(), call.format))
                wrongValue("format", joinWords(known, ", "), values.back(),
                           didYouMean(values.back(), known));
        };
        return o;
    };
    const auto force = [](unsigned verbs, const char* text) {
        return flag("force", text, verbs, MOLSURF_OF(force));
    };
    Option folder{"folder", 'O',  "DIR", "where the files go, with the names of the structures",
                  "",       Batch};
    folder.set = [](CommandLine& call, const Values& values) { call.folder = values.back(); };
    const std::string preset = CommandLine().formats, several = "files to write, by commas, of\n";
    Option formats{"formats", 0, "LIST", several + inLines(formatsOf(Batch)), preset, Batch};
    formats.set = [](CommandLine& call, const Values& values) { call.formats = values.back(); };
    Option shown = either("color",
                          "distance (OrRd) or signed-distance (blue: A is\ninside B, red: "
                          "outside)",
                          "signed-distance", "distance", Compare, MOLSURF_OF(colorBySign));
    Option palette = setting("palette", Compare);
    palette.preset = "that of --color";
    palette.stored = nullptr; // meshes have colours, too
    return {
        "Output",
        {written(Build, ""), written(Convert, "; .vdb with --color"),
         written(
             Compare,
             "; mesh and level set are those of A with distances; without it numbers are printed"),
         output(BricksPlan, "the manifest, a name that ends in .json"), written(BricksMerge, ""),
         folder, formats, format(Build, Build), format(Convert, Convert),
         format(Compare, Compare | BricksMerge),
         force(files | BricksPlan, "replace existing files"),
         force(Batch, "do all again, and replace existing files"),
         force(BricksRun, "do it again if it is done"),
         flag("skip-existing",
              "do nothing if the files are of the same input, options and\n"
              "version, by the report; make and replace them otherwise",
              Build, MOLSURF_OF(skipExisting)),
         shown, palette,
         number("range", "D", "distance at the end of the colours [Å]",
                "that of 99 % of the vertices", Compare, 1e-300, 1e300, "a positive number of Å",
                MOLSURF_OF(colorRange))},
        {{"vdb_molsurf 1crn.pdb -o 1crn.vdb -o 1crn.ply -o 1crn.json",
          "level set, mesh and report of one surface"},
         {"vdb_molsurf 1crn.pdb -o - --format ply > 1crn.ply", "a mesh on standard output"}}};
}

Option superposeOption()
{
    Option superpose = text("superpose", "SEL",
                            "lay B on A, structures of --panel on INPUT or frames on the\n"
                            "first one, by these atoms where chain, number and name are\n"
                            "the same, such as \"chain A and name CA\"; auto: by CA and C4'",
                            Build | Compare, MOLSURF_OF(superpose));
    superpose.words = {"auto"};
    superpose.stored = [](const CommandLine& c) {
        return stored(c.superpose.empty() ? "none" : c.superpose);
    };
    return superpose;
}

OptionGroup atomOptions()
{
    return {"Atoms",
            {setting("select", structures), setting("model", structures),
             setting("assembly", structures), setting("instances", Build),
             setting("by-symmetry", Build), fileOption("weld", Build),
             setting("copies", structures), setting("altloc", structures),
             setting("no-hydrogens", structures), setting("ions", structures),
             setting("hetero", structures), setting("no-hetero", structures),
             setting("waters", structures), setting("radii", structures),
             setting("probe", structures), superposeOption(),
             setting("max-input", structures | Info)},
            {{"vdb_molsurf 4hhb.cif.gz --select \"chain A or within 5 of resn HEM\" -o part.ply",
              "some of the atoms"},
             {"vdb_molsurf 1a8o.cif.gz --assembly 1 -o dimer.ply", "the biological assembly"}}};
}

OptionGroup frameOptions()
{
    return {"Frames",
            {text("frames", "A-B:S",
                  "a surface for every S-th frame from A to B: models of\n"
                  "INPUT by their numbers, or frames of --trajectory; also\n"
                  "A, A- (to the end), all; files name.0001.vdb, ...; -o\n"
                  "name.csv: a table of all",
                  Build, MOLSURF_OF(frames)),
             ofFile(text("trajectory", "FILE",
                         ".dcd, .xtc, .trr or .nc with the frames, its atoms those of INPUT", Build,
                         MOLSURF_OF(trajectory))),
             flag("update-selections",
                  "selections by distance, as within 5 of resn HEM, are those\n"
                  "of each frame, and not of the first",
                  Build, MOLSURF_OF(updateSelections)),
             count("first-frame", "N", "number of the first file, such as 1001: name.1001.vdb, ...",
                   "1", Build, 0, 999999, MOLSURF_OF(firstFrame)),
             fileOption("fps", Build)},
            {{"vdb_molsurf 1d3z.pdb.gz --frames 1-4 -o 1d3z.ply", "a mesh for each of four models"},
             {"vdb_molsurf top.pdb --trajectory run.xtc --frames all --superpose auto -o film.mp4",
              "a film of a trajectory, each frame laid on the first"}}};
}

OptionGroup surfaceOptions()
{
    Option attributes = setting("fields", Convert);
    attributes.text =
        "curvatures for the vertices of a .ply or .glb, by commas,\nas of vdb_molsurf --help";
    Option levels{"lod",
                  0,
                  "LIST",
                  "with --instances: voxels such as 1,2,4 in the place of\n"
                  "--voxel, a mesh each; the .html shows the finest that is\n"
                  "worth it, in .glb and .usda the first one is the default",
                  "",
                  Build};
    levels.set = [](CommandLine& call, const Values& values) {
        const std::string expected = "2 to 8 ascending voxels by commas [Å], such as 1,2,4";
        call.lod.clear();
        for (const std::string& word : splitWords(values.back())) {
            const double voxel = parsedValue<double>("lod", expected, word);
            if (!(voxel > (call.lod.empty() ? 0.0 : call.lod.back())))
                wrongValue("lod", expected, values.back());
            call.lod.push_back(voxel);
        }
        if (call.lod.size() < 2 || call.lod.size() > 8) wrongValue("lod", expected, values.back());
    };
    levels.stored = [](const CommandLine& c) {
        Values all;
        for (const double voxel : c.lod) all.push_back(shortest(voxel));
        return stored(all.empty() ? "none" : joinWords(all, ","));
    };
    return {"Surface",
            {setting("surface", structures), setting("voxel", structures), shownIn(Levels, levels),
             number("iso", "V",
                    "of a map: the level set where it has this value, negative\n"
                    "where it has more, or, of V below 0, less; else fog",
                    "", Convert, -1e30, 1e30, "a number", MOLSURF_OF(iso)),
             setting("blobbiness", structures), setting("fill-cavities", wholes | Compare),
             fileOption("walls", Build), setting("remesh", wholes | Convert),
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
            {setting("epsilon", structures), setting("match", structures),
             setting("resolution", structures), setting("coarse", structures),
             setting("match-volume", wholes | Compare)},
            {{"vdb_molsurf 4at1.ent.gz --resolution 8 -o blurred.glb", "blurred to 8 Å"},
             {"vdb_molsurf 4at1.ent.gz --coarse residue -o beads.glb",
              "two beads in the place of each residue"}}};
}

/// The colours that convert can give, and their words in help texts.
std::vector<ColorBy> storableColors()
{
    std::vector<ColorBy> colors = completeColors();
    colors.erase(std::remove(colors.begin(), colors.end(), ColorBy::Pocket), colors.end());
    return colors;
}

Values storableColorHelp()
{
    Values words = colorHelp();
    words.erase(std::remove(words.begin(), words.end(), nameOf(ColorBy::Pocket)), words.end());
    return words;
}

OptionGroup colorOptions()
{
    const Option shown =
        with(word("color", "WORD",
                  wrapped(joinWords(storableColorHelp(), ", ") +
                              "; chain and group are of grids chain_id and group_id, "
                              "the others of Cd so coloured or of the mesh; those of "
                              "Cd unless given",
                          helpWidth),
                  Convert, MOLSURF_OF(options.color), storableColors()),
             [](Option& o) { o.preset = ""; });
    return {"Colours",
            {setting("color", surfaces), shown, setting("range", surfaces | Convert),
             setting("palette", surfaces | Convert), setting("value-of", surfaces),
             setting("flat-values", surfaces), setting("outward", surfaces),
             fileOption("plain-color", wholes | Convert), fileOption("crisp", Build)},
            {{"vdb_molsurf 4hhb.cif.gz --color chain -o chains.png", "a colour for each chain"},
             {"vdb_molsurf 1ubq.pdb --color bfactor --range 0,40 -o b.glb",
              "B factors from 0 to 40 Å^2"}}};
}

OptionGroup groupOptions()
{
    const Option groups =
        with(text("groups", "FILE", "groups of atoms: JSON, or lines NAME SELECTION [COLOUR]",
                  surfaces, MOLSURF_OF(groupsFile)),
             [](Option& o) {
                 o.stored = [](const CommandLine& c) {
                     Values all;
                     for (const GroupRule& group : c.labels.groups)
                         all.push_back(group.name + " " + group.select);
                     return stored(joinWords(all, ", "));
                 };
                 o.file = wholeValue;
             });
    return {"Groups",
            {groups, setting("group-by", surfaces), setting("split", wholes),
             setting("surface-of", wholes), setting("interfaces", wholes)},
            {{"vdb_molsurf 4hhb.cif.gz --group-by chain --split group -o chains.glb",
              "a surface for each chain"},
             {"vdb_molsurf 4hhb.cif.gz --surface sas --interfaces -o buried.json",
              "the area that each pair of chains buries"}}};
}

OptionGroup areaOptions()
{
    Option areas{"areas",
                 0,
                 "LIST",
                 "tables for the report, by commas: atoms, residues,\ncontacts, interfaces, "
                 "pockets,\npore, tunnels, forces",
                 "",
                 wholes,
                 areaTables()};
    areas.set = [](CommandLine& call, const Values& values) {
        call.areas = splitWords(lowered(values.back()));
        for (const std::string& table : call.areas)
            if (std::count(areaTables().begin(), areaTables().end(), table) == 0)
                wrongValue("areas", "some of " + joinWords(areaTables(), ", "), values.back(),
                           didYouMean(table, areaTables()));
    };
    return {"Areas",
            {shownIn(Numbers, areas), shownIn(0, fileOption("contacts", wholes))},
            {{"vdb_molsurf 1ubq.pdb -o 1ubq.residues.csv", "accessible area of each residue"},
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
    Option center = fileOption("center", wholes);
    center.shownIn = 0; // pictures look the same
    return {
        "Scene",
        {fileOption("for", wholes), fileOption("fog-density", wholes), fileOption("ids", wholes),
         fileOption("one-box", wholes), fileOption("mips", wholes), center},
        {{"vdb_molsurf 1crn.pdb --for blender -o 1crn.vdb", "a volume with colours for Blender"},
         {"vdb_molsurf 1crn.pdb --for usd --center -o 1crn.vdb", "a volume and its stage of USD"}}};
}

OptionGroup printOptions()
{
    return {"Print",
            {fileOption("print-scale", wholes | Convert),
             numberKept(MOLSURF_OF(options.minWall),
                        number("min-wall", "W",
                               "thicken what is thinner than W mm; with --print-scale", "", wholes,
                               1e-300, 1e300, "a positive number of mm", MOLSURF_OF(wall)))},
            {{"vdb_molsurf 1crn.pdb --print-scale 2 -o 1crn.3mf", "a print of 2 mm per Å"},
             {"vdb_molsurf 1crn.pdb --print-scale 2 --min-wall 1 --walls outer -o 1crn.stl",
              "no wall thinner than 1 mm, without cavities"}}};
}

OptionGroup solverOptions()
{
    return {"Electrostatics",
            {ofFile(fileOption("apbs-grid", Build)), fileOption("pdie", Build),
             fileOption("sdie", Build), fileOption("ion-conc", Build)},
            {{"vdb_molsurf molecule.pqr --for apbs -o run/", "input, charges and maps for APBS"},
             {"vdb_molsurf molecule.pqr --match ses --for apbs --ion-conc 0.15 -o run/",
              "the same with a smooth boundary, in 0.15 mol/L of salt"}}};
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
    Option show{
        "show",
        0,
        "[SEL=]WORD",
        wrapped(
            "atoms beside the surface, whole and opaque, such as \"(HEM)=sticks\", with carbon in "
            "the colour of its chain, or sticks,golden; repeats; " +
                joinWords(all, "; "),
            helpWidth),
        "",
        Build | Batch};
    for (const AtomStyle& row : atomStyles()) show.words.push_back(row.word);
    show.words.push_back("pockets");
    show.repeats = true;
    show.set = [](CommandLine& call, const Values& values) {
        for (const std::string& value : values)
            if (const std::size_t count = pocketsIn(value))
                call.shownPockets = count;
            else
                call.shows.push_back(parseShow(value, {"pockets"}));
    };
    return show;
}

/// The kind of surface that a word names.
std::optional<SurfaceKind> surfaceKindOf(const std::string& word)
{
    for (const KindRow& row : kindTable())
        if (lowered(word) == row.word) return row.kind;
    return std::nullopt;
}

Option panelOption()
{
    Option panel{"panel",
                 0,
                 "WHAT",
                 "a further picture beside the first, with its camera, scale\n"
                 "and legend: the FILE of another structure, or the same one\n"
                 "from X,Y,Z or with a surface of another KIND; a page shows\n"
                 "files and kinds side by side or in turn; repeats",
                 "",
                 Build};
    panel.repeats = true;
    panel.file = [](const std::string& value) {
        return directionOf(value) || surfaceKindOf(value) ? std::string::npos : std::size_t(0);
    };
    panel.set = [](CommandLine& call, const Values& values) {
        for (const std::string& value : values) {
            const auto way = directionOf(value);
            if (value.empty() || (way && !(way->length() > 0.0 && std::isfinite(way->length()))))
                wrongValue("panel",
                           "a file or a direction X,Y,Z that is not 0, or a kind of surface",
                           value);
            const auto kind = surfaceKindOf(value);
            std::error_code ignored;
            const std::string hint =
                way || kind || std::filesystem::exists(value, ignored) ? "" : kindMeant(value);
            if (!hint.empty())
                wrongValue("panel", "a file, a direction or a kind of surface", value, hint);
            call.panels.push_back(way    ? Panel{"", *way}
                                  : kind ? Panel{"", openvdb::Vec3d(0.0), kind}
                                         : Panel{value});
        }
    };
    return shownIn(Pixels | ColorChoices, panel);
}

/// An option that adds to the notes of pictures.
Option noteOption(const char* name, const char* argument, const char* help,
                  NoteText (*parse)(const std::string& text))
{
    Option note{name, 0, argument, help, "", Build | Batch};
    note.repeats = true;
    note.set = [=](CommandLine& call, const Values& values) {
        for (const std::string& value : values) call.notes.push_back(parse(value));
    };
    return shownIn(Pixels, note);
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
    Option view = fileOption("view", draw);
    view.set = setView;
    view.file = [](const std::string& value) {
        return isViewName(value) ? std::size_t(0) : std::string::npos;
    };
    return {"Picture",
            {view, fileOption("up", draw), fileOption("turn", draw), fileOption("size", draw),
             fileOption("background", draw), fileOption("style", draw),
             shownIn(Pixels | ColorChoices, showOption()), labelOption(), rulerOption(),
             panelOption(), fileOption("opacity", draw), fileOption("all-walls", draw),
             fileOption("clip", draw), fileOption("depth-cue", draw), fileOption("legend", draw),
             fileOption("scale-bar", draw), fileOption("dpi", draw), fileOption("turntable", draw)},
            {{"vdb_molsurf 4hhb.cif.gz --color chain --show \"resn HEM=sticks\" --opacity 0.5 "
              "-o haems.png",
              "ligands behind a translucent surface"},
             {"vdb_molsurf 1crn.pdb --turntable 36 -o turn.gif", "a film of one turn"}}};
}

OptionGroup flowOptions()
{
    return {
        "Evolution",
        {setting("lambda", structures), setting("regularizer", structures),
         setting("flow", structures), setting("max-steps", structures & ~BricksPlan),
         with(setting("steps", structures),
              [](Option& o) {
                  o.preset = std::to_string(BrickPlan::defaultSteps) + " in bricks, " +
                             std::to_string(BrickPlan::defaultFrontSteps) + " at a large lambda";
              }),
         setting("tolerance", structures), setting("spline-level", wholes | Compare)},
        {{"vdb_molsurf 1crn.pdb --lambda 0.01 -o 1crn.ply", "less tension: closer to the atoms"},
         {"vdb_molsurf 1crn.pdb --flow newton -v -o 1crn.json", "explicit steps"}}};
}

Option requireOption()
{
    Option required{"require",
                    0,
                    "LIST",
                    "what the mesh has to be, or nothing is written and the\n"
                    "status is 3: watertight, manifold, components=N, cavities=N,\n"
                    "genus=N, min-angle=DEGREES",
                    "",
                    wholes,
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
    return required;
}

Option threadsOption()
{
    Option threads{"threads", 'j', "N", "threads at most", "all", runs};
    threads.set = [set = countSetter("threads", 1, 4096, MOLSURF_OF(threads))](
                      CommandLine& call, const Values& values) {
        const std::string word = lowered(values.back());
        if (word == "0" || word == "-1" || word == "all" || word == "auto" || word == "max")
            wrongValue("threads", "a whole number from 1 to 4096", values.back(),
                       " [hint: all cores are used without `threads`]");
        set(call, values);
    };
    return threads;
}

OptionGroup runOptions()
{
    const auto memory = [](unsigned verbs, std::string text) {
        Option o{"memory", 0, "SIZE", std::move(text), "", verbs};
        o.set = [](CommandLine& call, const Values& values) {
            call.memory = sizeValue("memory", values.back());
            constexpr std::size_t least = 1024; // a number without its unit
            if (call.memory < least)
                wrongValue("memory", "a size such as 500M or 4G", values.back(),
                           meant(values.back() + "G"));
        };
        return o;
    };
    const auto flagOf = [](const char* name, char letter, const char* text, unsigned verbs,
                           const auto& of, bool on = true) {
        Option o = flag(name, text, verbs, of, on);
        o.letter = letter;
        return o;
    };
    return {
        "Run",
        {count("bricks", "N", "how many bricks, about as large each", "", BricksPlan, 1, 1000000,
               MOLSURF_OF(bricks)),
         memory(BricksPlan, "or as many bricks as it takes for each to need no more,\n"
                            "such as 500M or 4G"),
         memory(Build, "memory at most, such as 4G: in bricks, one by one, if\n"
                       "the whole takes more; the flow then takes so many --steps"),
         number("max-hours", "H", "refuse what is estimated to take more hours", "24",
                Build | Batch | Compare | Convert | BricksRun, 1e-6, 1e6, "hours, from 1e-6 to 1e6",
                MOLSURF_OF(hours)),
         flagOf("dry-run", 0, "print the estimated time and memory, and stop",
                Build | Compare | Convert, MOLSURF_OF(dryRun)),
         requireOption(), threadsOption(),
         flagOf("quiet", 'q', "print errors only", runs, MOLSURF_OF(quiet)),
         flagOf("verbose", 'v', "print the time of every stage",
                Build | Batch | Compare | Convert | BricksMerge, MOLSURF_OF(verbose)),
         flagOf("no-progress", 0, "no progress bar", runs, MOLSURF_OF(progress), false),
         ofFile(text("config", "FILE", "options as lines \"name = value\"; the command line wins",
                     structures | Convert, MOLSURF_OF(config)))},
        {{"vdb_molsurf 4v5a.cif.gz --dry-run -o 4v5a.ply", "estimated time and memory"},
         {"vdb_molsurf 4v5a.cif.gz --memory 4G -j 8 -o 4v5a.ply",
          "at most 4 GiB and eight threads"}}};
}

} // namespace

const std::vector<OptionGroup>& optionTable()
{
    static const std::vector<OptionGroup> all = {
        outputOptions(),     atomOptions(),    frameOptions(), surfaceOptions(),
        resolutionOptions(), groupOptions(),   colorOptions(), areaOptions(),
        pocketOptions(),     poreOptions(),    sceneOptions(), printOptions(),
        solverOptions(),     pictureOptions(), flowOptions(),  runOptions()};
    return all;
}

std::vector<OptionGroup> optionGroups(unsigned verb)
{
    std::vector<OptionGroup> groups = optionTable();
    groups.push_back({"Information",
                      {{"list-radii", 0, nullptr, "print the radii sets and stop", "", Build},
                       {"version", 'V', nullptr, "print the version and stop", "", 0xff},
                       {"help", 'h', nullptr, "print the common options and stop", "", 0xff},
                       {"help-all", 0, nullptr, "print all options and stop", "", 0xff}}});
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
    return option.name == name || (option.letter && name == std::string(1, option.letter));
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
        for (const std::string& value : values) {
            const std::size_t begin = option->file(value);
            if (begin != std::string::npos) files.push_back({option, value.substr(begin)});
        }
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
            if (option.stored && (option.verbs & Build)) add(option.name, *option.stored(call));
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->stored && !readsOnce(file.path))
            add(file.option->name + ".sha256"s, openvdb::StringMetadata(sha256OfFile(file.path)));
}

} // namespace molsurf::tool
