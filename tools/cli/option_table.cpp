// SPDX-License-Identifier: MPL-2.0
#include "cli/option_table.h"

#include "sha256.h"
#include "terminal.h"

#include "molsurf/bricks.h"
#include "molsurf/error.h"
#include "molsurf/picture/view_file.h"
#include "molsurf/selection/groups.h"
#include "molsurf/settings.h"
#include "molsurf/structure/load_text.h"
#include "molsurf/surface/set_value.h"
#include "molsurf/surface/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace molsurf::tool
{

const std::vector<std::string>& areaTables()
{
    static const std::vector<std::string> all = {"atoms",   "residues", "contacts", "interfaces",
                                                 "pockets", "pore",     "forces"};
    return all;
}

void misuse(const std::string& message)
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

openvdb::Metadata::Ptr metadataOf(const SettingValue& value)
{
    if (const auto* on = std::get_if<bool>(&value)) return openvdb::BoolMetadata(*on).copy();
    if (const auto* whole = std::get_if<std::int64_t>(&value))
        return openvdb::Int64Metadata(*whole).copy();
    if (const auto* number = std::get_if<double>(&value))
        return openvdb::DoubleMetadata(*number).copy();
    return stored(std::get<std::string>(value));
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
        if (row.get) o.stored = [&row](const Call& call) { return metadataOf(row.get(call)); };
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
    o.set = [=](Call& call, const Values&) { of(call) = on; };
    return o;
}

template<typename Of>
Option text(const char* name, const char* value, std::string help, unsigned verbs, const Of& of)
{
    Option o{name, 0, value, std::move(help), "", verbs};
    o.set = [=](Call& call, const Values& v) { of(call) = v.back(); };
    return o;
}

/// One of a few values that nameOf() names.
template<typename Of, typename Enum>
Option word(const char* name, const char* value, std::string help, unsigned verbs, const Of& of,
            const std::vector<Enum>& choices)
{
    const Call preset;
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
    o.set = [=, words = o.words](Call& call, const Values& v) {
        const std::string got = lowered(v.back());
        if (got != on && got != off)
            wrongValue(name, std::string(off) + " or " + on, v.back(), didYouMean(v.back(), words));
        of(call) = got == on;
    };
    return o;
}

void setView(Call& call, const Values& values)
{
    const std::string& view = values.back();
    if (takeView(view, call.picture)) return;
    if (!(call.verb & (Build | Batch)))
        wrongValue("view", "auto, a direction X,Y,Z or a FILE.view", view);
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
    option.stored = [=](const Call& call) { return openvdb::BoolMetadata(of(call)).copy(); };
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
        if ((format.verbs & verb) && (format.holds & (Stage | FrameRows | Moving)) == 0)
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
        o.set = [](Call& call, const Values& values) {
            call.paths = values;
            for (std::string& path : call.paths) // one name for one thing
                if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1")
                    path = "-";
            call.given["output"] = call.paths;
        };
        return o;
    };
    const auto written = [&](Verb verb, const char* more) {
        return output(verb,
                      "file to write; repeats; the extension says what:\n" +
                          wrapped(filesOf(verb) + "; - is standard output" + more, helpWidth));
    };
    const auto format = [](Verb verb, unsigned verbs) {
        const Values known = formatsOf(verb);
        Option o{"format", 0,     "WORD", "what -o - writes: one of\n" + inLines(known),
                 "",       verbs, known};
        o.set = [=](Call& call, const Values& values) {
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
    folder.set = [](Call& call, const Values& values) { call.folder = values.back(); };
    Option formats{"formats",      0,
                   "LIST",         "files to write, by commas, of\n" + inLines(formatsOf(Batch)),
                   Call().formats, Batch};
    formats.set = [](Call& call, const Values& values) { call.formats = values.back(); };
    Option shown = either("color",
                          "distance (viridis) or signed-distance (blue: A is\ninside B, red: "
                          "outside)",
                          "signed-distance", "distance", Compare, MOLSURF_OF(colorBySign));
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
         shown,
         number("range", "D", "distance at the end of the colours [Å]",
                "that of 99 % of the vertices", Compare, 1e-300, 1e300, "a positive number of Å",
                MOLSURF_OF(colorRange))}};
}

OptionGroup atomOptions()
{
    return {
        "Atoms",
        {setting("select", structures), setting("model", structures),
         setting("assembly", structures), setting("instances", Build),
         setting("by-symmetry", Build),
         shownIn(Triangles,
                 kept(MOLSURF_OF(weld),
                      flag("weld", "with --by-symmetry: units share the vertices of their borders",
                           Build, MOLSURF_OF(weld)))),
         setting("copies", structures), setting("altloc", structures),
         setting("no-hydrogens", structures), setting("ions", structures),
         setting("hetero", structures), setting("no-hetero", structures),
         setting("waters", structures), setting("radii", structures), setting("probe", structures),
         setting("max-input", structures | Info)}};
}

OptionGroup frameOptions()
{
    return {
        "Frames",
        {text("frames", "A-B:S",
              "a surface for every S-th frame from A to B: models of\n"
              "INPUT by their numbers, or frames of --trajectory; also\n"
              "A, A- (to the end), all; files name.0001.vdb, ...; -o\n"
              "name.csv: a table of all",
              Build, MOLSURF_OF(frames)),
         ofFile(text("trajectory", "FILE", ".dcd or .xtc with the frames, its atoms those of INPUT",
                     Build, MOLSURF_OF(trajectory))),
         flag("update-selections",
              "selections by distance, as within 5 of resn HEM, are those\n"
              "of each frame, and not of the first",
              Build, MOLSURF_OF(updateSelections)),
         count("first-frame", "N", "number of the first file, such as 1001: name.1001.vdb, ...",
               "1", Build, 0, 999999, MOLSURF_OF(firstFrame)),
         shownIn(Grids | VertexCurvatures | Stage | Moving,
                 with(number("fps", "N",
                             "frames per second, such as 24: velocities of --fields v\n"
                             "are per second; a .usda and a film play at this rate",
                             "", Build, 1e-3, 1e6, "a number from 0.001 to 1e6", MOLSURF_OF(fps)),
                      [](Option& o) {
                          o.stored = [](const Call& c) {
                              return openvdb::DoubleMetadata(c.fps).copy();
                          };
                      }))}};
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
    levels.set = [](Call& call, const Values& values) {
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
    levels.stored = [](const Call& c) {
        Values all;
        for (const double voxel : c.lod) all.push_back(shortest(voxel));
        return stored(all.empty() ? "none" : joinWords(all, ","));
    };
    return {"Surface",
            {setting("surface", structures), setting("voxel", structures), shownIn(Levels, levels),
             setting("blobbiness", structures), setting("fill-cavities", wholes | Compare),
             fileOption("walls", Build), setting("remesh", wholes | Convert),
             setting("density", wholes | Convert), setting("adapt", wholes | Convert),
             setting("fields", surfaces), attributes, shownIn(Grids, setting("vdb-half", surfaces)),
             shownIn(Numbers, setting("curvature-totals", wholes))}};
}

OptionGroup resolutionOptions()
{
    return {"Resolution",
            {setting("epsilon", structures), setting("match", structures),
             setting("resolution", structures), setting("coarse", structures),
             setting("match-volume", wholes | Compare)}};
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

OptionGroup groupOptions()
{
    const Option groups =
        with(text("groups", "FILE", "groups of atoms: JSON, or lines NAME SELECTION [COLOUR]",
                  surfaces, MOLSURF_OF(groupsFile)),
             [](Option& o) {
                 o.stored = [](const Call& c) {
                     Values all;
                     for (const GroupRule& group : c.atoms.groups)
                         all.push_back(group.name + " " + group.select);
                     return stored(joinWords(all, ", "));
                 };
                 o.file = wholeValue;
             });
    const Option shown =
        with(word("color", "WORD",
                  wrapped(joinWords(storableColorHelp(), ", ") +
                              "; chain and group are of grids chain_id and group_id, "
                              "the others of Cd so coloured or of the mesh; those of "
                              "Cd unless given",
                          helpWidth),
                  Convert, MOLSURF_OF(options.color), storableColors()),
             [](Option& o) { o.preset = ""; });
    return {"Groups",
            {groups, setting("group-by", surfaces), setting("split", wholes),
             setting("surface-of", wholes), setting("interfaces", wholes),
             setting("color", surfaces), setting("range", surfaces | Convert),
             setting("palette", surfaces | Convert), setting("value-of", surfaces),
             setting("flat-values", surfaces), setting("outward", surfaces),
             fileOption("crisp", Build), shown}};
}

OptionGroup areaOptions()
{
    Option areas{"areas",
                 0,
                 "LIST",
                 "tables for the report, by commas: atoms, residues,\ncontacts, interfaces, "
                 "pockets,\npore, forces",
                 "",
                 wholes,
                 areaTables()};
    areas.set = [](Call& call, const Values& values) {
        call.areas = splitWords(lowered(values.back()));
        for (const std::string& table : call.areas)
            if (std::count(areaTables().begin(), areaTables().end(), table) == 0)
                wrongValue("areas", "some of " + joinWords(areaTables(), ", "), values.back(),
                           didYouMean(table, areaTables()));
    };
    return {"Areas",
            {shownIn(Numbers, areas),
             word("contacts", "LEVEL",
                  "contact areas between atoms, residues or chains: atom,\nresidue, chain", wholes,
                  MOLSURF_OF(contacts),
                  std::vector{ContactLevel::Atom, ContactLevel::Residue, ContactLevel::Chain})}};
}

OptionGroup pocketOptions()
{
    return {"Pockets",
            {setting("pockets", wholes), setting("pocket-at", wholes), setting("probe-in", wholes),
             setting("probe-out", wholes), setting("pocket-cut", wholes),
             setting("pocket-neck", wholes), setting("pore", wholes)}};
}

OptionGroup sceneOptions()
{
    const auto numberOf = [](Option option, const auto& of) {
        option.stored = [=](const Call& c) { return openvdb::DoubleMetadata(of(c)).copy(); };
        return option;
    };
    Option host = fileOption("for", wholes), center = fileOption("center", wholes);
    host.stored = [](const Call& c) { return stored(c.forApbs ? "apbs" : nameOf(c.scene.host)); };
    center.shownIn = 0; // pictures look the same
    return {
        "Scene",
        {host, numberOf(fileOption("fog-density", wholes), MOLSURF_OF(scene.fogDensity)),
         kept(MOLSURF_OF(center), center), fileOption("print-scale", wholes | Convert),
         numberOf(number("min-wall", "W", "thicken what is thinner than W mm; with --print-scale",
                         "", wholes, 1e-300, 1e300, "a positive number of mm", MOLSURF_OF(wall)),
                  MOLSURF_OF(options.minWall))}};
}

OptionGroup solverOptions()
{
    return {"Electrostatics",
            {ofFile(fileOption("apbs-grid", Build)), fileOption("pdie", Build),
             fileOption("sdie", Build), fileOption("ion-conc", Build)}};
}

/// The words of styles and what they mean.
Option showOption()
{
    Values all;
    for (const AtomStyle& row : atomStyles()) all.push_back(row.word + ": "s + row.help);
    all.push_back("or pockets: their bodies, in pages too");
    Option show{
        "show",
        0,
        "[SEL=]WORD",
        wrapped("atoms beside the surface, whole and opaque, such as \"(HEM)=sticks\"; repeats; " +
                    joinWords(all, "; "),
                helpWidth),
        "",
        Build | Batch};
    for (const AtomStyle& row : atomStyles()) show.words.push_back(row.word);
    show.words.push_back("pockets");
    show.repeats = true;
    show.set = [](Call& call, const Values& values) {
        for (const std::string& value : values)
            if (lowered(value) == "pockets")
                call.showsPockets = true;
            else
                call.shows.push_back(parseShow(value));
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
    panel.set = [](Call& call, const Values& values) {
        for (const std::string& value : values) {
            const auto way = directionOf(value);
            if (value.empty() || (way && !(way->length() > 0.0 && std::isfinite(way->length()))))
                wrongValue("panel", "a file or a direction X,Y,Z that is not 0", value);
            const auto kind = surfaceKindOf(value);
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
    note.set = [=](Call& call, const Values& values) {
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
             fileOption("background", draw), fileOption("plain-color", wholes | Convert),
             fileOption("style", draw), shownIn(Pixels | ColorChoices, showOption()), labelOption(),
             rulerOption(), panelOption(), fileOption("opacity", draw),
             fileOption("all-walls", draw), fileOption("clip", draw), fileOption("depth-cue", draw),
             fileOption("legend", draw), fileOption("scale-bar", draw), fileOption("dpi", draw),
             shownIn(Pixels, count("turntable", "N",
                                   "N pictures round the upright: name.0001.png, ..., or in\na "
                                   "film, such as name.mp4",
                                   "", draw, 2, 9999, MOLSURF_OF(turntable)))}};
}

OptionGroup flowOptions()
{
    return {"Evolution",
            {setting("lambda", structures), setting("regularizer", structures),
             setting("flow", structures), setting("max-steps", structures & ~BricksPlan),
             with(setting("steps", structures),
                  [](Option& o) {
                      o.preset = std::to_string(BrickPlan::defaultSteps) + " in bricks, " +
                                 std::to_string(BrickPlan::defaultFrontSteps) +
                                 " at a large lambda";
                  }),
             setting("tolerance", structures), setting("spline-level", wholes | Compare)}};
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
    required.set = [](Call& call, const Values& values) {
        const auto parsed = parseRequirements(values.back());
        if (!parsed)
            wrongValue("require",
                       "some of " + joinWords(requirementWords(), ", ") + " with numbers",
                       values.back());
        call.required = *parsed;
    };
    return required;
}

OptionGroup runOptions()
{
    const auto memory = [](unsigned verbs, std::string text) {
        Option o{"memory", 0, "SIZE", std::move(text), "", verbs};
        o.set = [](Call& call, const Values& values) {
            call.memory = sizeValue("memory", values.back());
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
         flagOf("dry-run", 0, "say what it takes, and stop", Build | Compare | Convert,
                MOLSURF_OF(dryRun)),
         requireOption(),
         with(count("threads", "N", "threads at most", "all", runs, 1, 4096, MOLSURF_OF(threads)),
              [](Option& o) { o.letter = 'j'; }),
         flagOf("quiet", 'q', "print errors only", runs, MOLSURF_OF(quiet)),
         flagOf("verbose", 'v', "print the time of every stage",
                Build | Batch | Compare | Convert | BricksMerge, MOLSURF_OF(verbose)),
         flagOf("no-progress", 0, "no progress bar", runs, MOLSURF_OF(progress), false),
         ofFile(text("config", "FILE", "options as lines \"name = value\"; the command line wins",
                     structures | Convert, MOLSURF_OF(config)))}};
}

} // namespace

bool Call::writes(unsigned some) const
{
    return std::any_of(outputs.begin(), outputs.end(),
                       [=](const Output& output) { return output.holds(some); });
}

bool Call::writesOnly(unsigned some) const
{
    return !outputs.empty() &&
           std::all_of(outputs.begin(), outputs.end(),
                       [=](const Output& output) { return output.holds(some); });
}

const std::vector<OptionGroup>& optionTable()
{
    static const std::vector<OptionGroup> all = {
        outputOptions(),  atomOptions(), frameOptions(),  surfaceOptions(), resolutionOptions(),
        groupOptions(),   areaOptions(), pocketOptions(), sceneOptions(),   solverOptions(),
        pictureOptions(), flowOptions(), runOptions()};
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

const Option* findOption(Verb verb, const std::string& name)
{
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if ((option.verbs & verb) && option.name == name) return &option;
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

void addOptions(const Call& call, openvdb::MetaMap& map)
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
