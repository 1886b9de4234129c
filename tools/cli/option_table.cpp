// SPDX-License-Identifier: MPL-2.0
#include "cli/option_table.h"

#include "sha256.h"

#include "molsurf/bricks.h"
#include "molsurf/color/color_table.h"
#include "molsurf/error.h"
#include "molsurf/selection/ball_values.h"
#include "molsurf/selection/choose_copies.h"
#include "molsurf/selection/coarse_grain.h"
#include "molsurf/selection/groups.h"
#include "molsurf/selection/radii.h"
#include "molsurf/surface/extra_grids.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numeric>

namespace molsurf::tool
{

const std::vector<std::string>& areaTables()
{
    static const std::vector<std::string> all = {"atoms", "residues", "contacts", "interfaces"};
    return all;
}

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

void misuse(const std::string& message)
{
    throw Error(ErrorKind::Usage, message);
}

std::string lowered(std::string text)
{
    for (char& letter : text)
        if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
    return text;
}

std::vector<std::string> splitWords(const std::string& list)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::string joinWords(const std::vector<std::string>& words, const char* between)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

std::string didYouMean(const std::string& typed, const std::vector<std::string>& words)
{
    const auto distance = [](const std::string& a, const std::string& b) { // Levenshtein's
        std::vector<std::size_t> row(b.size() + 1);
        std::iota(row.begin(), row.end(), std::size_t(0));
        for (std::size_t i = 1; i <= a.size(); ++i) {
            std::size_t diagonal = row[0]++;
            for (std::size_t j = 1; j <= b.size(); ++j) {
                const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
                diagonal = row[j];
                row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
        return row.back();
    };
    std::string best;
    std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
    for (const std::string& word : words) {
        const std::size_t d = distance(lowered(typed), lowered(word));
        const bool begins = typed.size() >= 3 && word.rfind(lowered(typed), 0) == 0;
        if (d < least || (begins && best.empty())) {
            least = std::min(least, d);
            best = word;
        }
    }
    return best.empty() ? "" : " [hint: did you mean " + best + "?]";
}

const char* nameOf(LegendChoice choice)
{
    return choice == LegendChoice::On ? "on" : choice == LegendChoice::Off ? "off" : "auto";
}

using molsurf::nameOf;
using namespace std::string_literals;

namespace
{

using Values = std::vector<std::string>;

[[noreturn]] void wrong(const std::string& option, const std::string& expected,
                        const std::string& got, const std::string& hint = "")
{
    misuse("--" + option + ": expected " + expected + ", got '" + got + "'" + hint);
}

template<typename T>
T parsed(const std::string& option, const std::string& expected, const std::string& word)
{
    T value{};
    const char* end = word.data() + word.size();
    const auto [stop, failure] = std::from_chars(word.data(), end, value);
    if (failure != std::errc() || stop != end || !std::isfinite(double(value)))
        wrong(option, expected, word);
    return value;
}

// Rows by the type of their value. `of` gives the variable of a call that the option sets:
// OF(options.voxel).
#define OF(variable)                                                                               \
    [](auto& call) -> auto&                                                                        \
    {                                                                                              \
        return call.variable;                                                                      \
    }

template<typename Of>
Option number(const char* name, const char* value, std::string text, unsigned verbs, const Of& of)
{
    const Call preset;
    Option o{name, 0, value, std::move(text), shortest(of(preset)), verbs};
    o.set = [=](Call& call, const Values& v) {
        of(call) = parsed<double>(name, "a number", v.back());
    };
    o.stored = [=](const Call& call) { return openvdb::DoubleMetadata(of(call)).copy(); };
    return o;
}

/// A number in a range that the library does not check.
template<typename Of>
Option number(const char* name, const char* value, std::string text, std::string preset,
              unsigned verbs, double low, double high, const char* range, const Of& of)
{
    Option o{name, 0, value, std::move(text), std::move(preset), verbs};
    o.set = [=](Call& call, const Values& v) {
        of(call) = parsed<double>(name, range, v.back());
        if (!(of(call) >= low && of(call) <= high)) wrong(name, range, v.back());
    };
    return o;
}

template<typename Of>
Option count(const char* name, const char* value, std::string text, std::string preset,
             unsigned verbs, int low, int high, const Of& of)
{
    Option o{name, 0, value, std::move(text), std::move(preset), verbs};
    o.set = [=](Call& call, const Values& v) {
        const std::string range =
            "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
        of(call) = parsed<int>(name, range, v.back());
        if (of(call) < low || of(call) > high) wrong(name, range, v.back());
    };
    return o;
}

/// @param[in] on  what the switch sets
template<typename Of, typename T = bool>
Option flag(const char* name, std::string text, unsigned verbs, const Of& of, T on = T(true))
{
    Option o{name, 0, nullptr, std::move(text), "", verbs};
    o.set = [=](Call& call, const Values&) { of(call) = on; };
    o.stored = [=](const Call& call) { return openvdb::BoolMetadata(of(call) == on).copy(); };
    return o;
}

openvdb::Metadata::Ptr stored(const std::string& text)
{
    return openvdb::StringMetadata(text).copy();
}

/// @param[in] none  what an empty text means
template<typename Of>
Option text(const char* name, const char* value, std::string help, const char* none, unsigned verbs,
            const Of& of)
{
    const Call preset;
    Option o{name, 0, value, std::move(help), of(preset).empty() ? none : of(preset), verbs};
    o.set = [=](Call& call, const Values& v) { of(call) = v.back(); };
    o.stored = [=](const Call& call) { return stored(of(call).empty() ? none : of(call)); };
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
    o.set = [=, words = o.words](Call& call, const Values& v) {
        for (const Enum choice : choices) {
            if (lowered(v.back()) != nameOf(choice)) continue;
            of(call) = choice;
            return;
        }
        wrong(name, joinWords(words, " or "), v.back(), didYouMean(v.back(), words));
    };
    o.stored = [=](const Call& call) { return stored(nameOf(of(call))); };
    return o;
}

template<typename Of, typename Enum>
Option word(const char* name, const char* value, std::string help, unsigned verbs, const Of& of,
            std::initializer_list<Enum> choices)
{
    return word(name, value, std::move(help), verbs, of, std::vector<Enum>(choices));
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
            wrong(name, std::string(off) + " or " + on, v.back(), didYouMean(v.back(), words));
        of(call) = got == on;
    };
    return o;
}

constexpr auto surfaceKinds = {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                               SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals,
                               SurfaceKind::Gaussian};

constexpr auto contactLevels = {ContactLevel::Atom, ContactLevel::Residue, ContactLevel::Chain};

std::vector<ColorBy> colorings()
{
    std::vector<ColorBy> out;
    for (const ColorKind& kind : colorTable())
        if (kind.complete) out.push_back(kind.by);
    return out;
}

/// GROUP=KIND, the group ending at the last =.
std::pair<std::string, SurfaceKind> parseSurfaceOf(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    for (const SurfaceKind kind : surfaceKinds) {
        if (split != std::string::npos && split > 0 &&
            lowered(text.substr(split + 1)) == nameOf(kind))
            return {text.substr(0, split), kind};
    }
    wrong("surface-of", "GROUP=KIND with a kind of --surface", text);
}

/// D or SELECTION=D, the selection ending at the last =.
ResolutionRule parseResolution(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    const std::string digits = split == std::string::npos ? text : text.substr(split + 1);
    ResolutionRule rule;
    if (split != std::string::npos) rule.select = text.substr(0, split);
    const char* end = digits.data() + digits.size();
    const auto [stop, problem] = std::from_chars(digits.data(), end, rule.resolution);
    if (problem != std::errc() || stop != end || split == 0 ||
        !(rule.resolution >= minResolution && rule.resolution <= maxResolution))
        wrong("resolution", "D or SELECTION=D with D from 1 to 50 Å", text);
    return rule;
}

void setFields(Call& call, const Values& values)
{
    std::vector<std::string> wanted;
    for (const std::string& field : splitWords(values.back())) {
        const auto same = [&](const std::string& known) {
            return lowered(known) == lowered(field);
        };
        const auto found = std::find_if(knownFields().begin(), knownFields().end(), same);
        if (lowered(field) == "all")
            wanted = knownFields();
        else if (found != knownFields().end())
            wanted.push_back(*found);
        else
            misuse("--fields: unknown field '" + field + "'" +
                   (didYouMean(field, knownFields()).empty()
                        ? " [hint: all, or some of " + joinWords(knownFields(), ",") + "]"
                        : didYouMean(field, knownFields())));
    }
    call.options.fields.clear();
    for (const std::string& field : knownFields()) // `surface` is always written
        if (field != "surface" && std::count(wanted.begin(), wanted.end(), field))
            call.options.fields.push_back(field);
}

/// "4G", "500M": bytes. K, M, G and T are powers of 1024.
std::size_t parseSize(const std::string& option, const std::string& text)
{
    const std::string expected = "a size such as 500M or 4G";
    double size = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, size);
    const std::string unit(stop, end), letters = "KMGT";
    const std::size_t place = unit.empty() ? 0 : letters.find(unit[0]);
    const std::string rest = unit.empty() ? "" : unit.substr(1);
    if (problem != std::errc() || !std::isfinite(size) || place == std::string::npos ||
        !(rest.empty() || rest == "B" || rest == "iB"))
        wrong(option, expected, text);
    const double bytes = size * (unit.empty() ? 1.0 : std::pow(1024.0, double(place + 1)));
    if (!(bytes >= 1.0 && bytes < 1e18)) wrong(option, expected, text);
    return std::size_t(bytes);
}

void setView(Call& call, const Values& values)
{
    const std::string& view = values.back();
    if (lowered(view) == "auto") return;
    DrawOptions& picture = call.picture;
    const char *from = view.data(), *end = from + view.size();
    for (int i = 0; i < 3; ++i) {
        const auto [stop, problem] = std::from_chars(from, end, picture.toEye[i]);
        if (problem != std::errc() || (i < 2 ? stop == end || *stop != ',' : stop != end) ||
            !std::isfinite(picture.toEye[i]))
            wrong("view", "auto or a direction X,Y,Z", view);
        from = stop + 1;
    }
    if (!(picture.toEye.lengthSqr() > 0.0)) wrong("view", "auto or a direction X,Y,Z", view);
    // Up is y, or z when looking along y.
    const openvdb::Vec3d eye = picture.toEye.unit();
    picture.up = std::abs(eye.y()) < 0.99 ? openvdb::Vec3d(0, 1, 0) : openvdb::Vec3d(0, 0, 1);
}

/// @param[in] more  what else the option takes
Color colorOf(const char* option, const std::string& more, const std::string& word)
{
    const auto color = parseColor(word);
    if (!color)
        wrong(option, "a colour as #rrggbb or #rgb, or a name such as black" + more, word,
              didYouMean(word, colorNames()));
    return *color;
}

void setBackground(Call& call, const Values& values)
{
    call.picture.transparent = lowered(values.back()) == "transparent";
    if (call.picture.transparent) return;
    call.picture.background = colorOf("background", ", or transparent", values.back());
}

void setScene(Call& call, const Values& values)
{
    const auto scene = parseScene(values.back());
    if (!scene)
        wrong("for", "blender, houdini or usd, perhaps with =mn-0.01, =mn-0.1, =nm or =UNITS_PER_Å",
              values.back(), didYouMean(values.back(), {"blender", "houdini", "usd"}));
    call.scene = *scene;
}

/// Words with commas between, in lines for the help text.
std::string inLines(const std::vector<std::string>& words)
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

/// Option::file of a value that is a path.
std::size_t wholeValue(const std::string&)
{
    return 0;
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
        if ((format.verbs & verb) && (format.holds & (Stage | FrameRows)) == 0)
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
        o.set = [](Call& call, const Values& values) { call.paths = values; };
        return o;
    };
    const auto format = [](Verb verb, unsigned verbs) {
        const Values known = formatsOf(verb);
        Option o{"format", 0,     "WORD", "what -o - writes: one of\n" + inLines(known),
                 "",       verbs, known};
        o.set = [=](Call& call, const Values& values) {
            call.format = lowered(values.back());
            if (!std::count(known.begin(), known.end(), call.format))
                wrong("format", joinWords(known, ", "), values.back(),
                      didYouMean(values.back(), known));
        };
        return o;
    };
    const auto force = [](unsigned verbs, const char* text) {
        Option o = flag("force", text, verbs, OF(force));
        o.stored = nullptr;
        return o;
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
                          "signed-distance", "distance", Compare, OF(colorBySign));
    return {"Output",
            {output(Build, "file to write; repeats; the extension says what:\n"
                           ".vdb level set and fields; .ply .obj .stl .off .wrl\n"
                           ".glb .3mf mesh; .html page that shows it; .json report;\n"
                           ".png picture; .usda copies, with --instances; areas as\n"
                           "tables .atoms.csv .residues.csv .contacts.csv\n"
                           ".interfaces.csv, and atoms .pdb .cif with them as B\n"
                           "factors; - is standard output"),
             output(Convert, "file to write; repeats; the extension says what:\n"
                             ".ply .obj .stl .off .wrl .glb .3mf mesh; .html page;\n"
                             ".json report; .png picture; with --color .vdb, the\n"
                             "grids with Cd anew; - is standard output"),
             output(Compare, "file to write; repeats; the extension says what:\n"
                             ".ply mesh of A with distances and colours,\n"
                             ".vdb distances on the band of A, .json report;\n"
                             "- is standard output; without it numbers are printed"),
             output(BricksPlan, "the manifest, a name that ends in .json"),
             output(BricksMerge, "file to write; repeats; the extension says what:\n"
                                 ".vdb level set and fields, .ply mesh, .json report"),
             folder, formats, format(Build, Build), format(Convert, Convert),
             format(Compare, Compare | BricksMerge),
             force(files | BricksPlan, "replace existing files"),
             force(Batch, "do all again, and replace existing files"),
             force(BricksRun, "do it again if it is done"), shown,
             number("range", "D", "distance at the end of the colours [Å]",
                    "that of 99 % of the vertices", Compare, 1e-300, 1e300,
                    "a positive number of Å", OF(colorRange))}};
}

OptionGroup atomOptions()
{
    const auto of = [](auto member) {
        return [=](auto& c) -> auto&
        {
            return c.atoms.*member;
        };
    };
    Option maxInput{"max-input", 0,
                    "SIZE",      "bytes that INPUT may have, unpacked, such as 10G",
                    "4G",        structures | Info};
    maxInput.set = [](Call& call, const Values& values) {
        call.atoms.maxInput = parseSize("max-input", values.back());
    };
    return {
        "Atoms",
        {text("select", "EXPR", "gemmi selections joined by |, e.g. \"/1/A/53-132|*;polymer\"",
              "all", structures, of(&SelectOptions::select)),
         with(count("model", "N", "number of the model in the file", "the first", structures, 1,
                    1000000000, of(&SelectOptions::model)),
              [](Option& o) {
                  o.stored = [](const Call& c) {
                      return stored(c.atoms.model ? std::to_string(c.atoms.model) : "first");
                  };
              }),
         text("assembly", "ID",
              "biological assembly to build; none: as in the file;\n"
              "ncs: with the copies of MTRIX records or struct_ncs_oper",
              "", structures, of(&SelectOptions::assembly)),
         flag("instances",
              "the surface of each distinct copy of the assembly once:\n"
              "the .glb, .usda, .html, .png and .json place the copies",
              Build, of(&SelectOptions::instances)),
         flag("by-symmetry",
              "the joint surface of the whole assembly from one unit,\n"
              "which its rotations repeat",
              Build, of(&SelectOptions::bySymmetry)),
         flag("weld", "with --by-symmetry: units share the vertices of their borders", Build,
              OF(weld)),
         text("copies", "LIST",
              "copies of the assembly: numbers such as 1,7,20-25, or\n"
              "fold:N, those about the nearest N-fold axis, with copy 1",
              "all", structures, of(&SelectOptions::copies)),
         text("altloc", "A", "alternate location to take, or all", "highest occupancy", structures,
              of(&SelectOptions::altloc)),
         flag("no-hydrogens", "drop hydrogens", structures, of(&SelectOptions::hydrogens), false),
         flag("ions", "keep free ions of the solution", structures, of(&SelectOptions::ions)),
         flag("hetero",
              "keep all ligands, ions, buffers and lipids; otherwise\n"
              "those that touch a polymer and are no free ions, buffers,\n"
              "lipids or detergents",
              structures, of(&SelectOptions::hetero), Hetero::All),
         flag("no-hetero", "drop all ligands and ions", structures, of(&SelectOptions::hetero),
              Hetero::None),
         flag("waters", "keep waters", structures, of(&SelectOptions::waters)),
         with(text("radii", "SET", "van der Waals radii: a name of --list-radii, or a file", "",
                   structures, of(&SelectOptions::radii)),
              [](Option& o) {
                  o.file = [](const std::string& value) {
                      return isRadiiSet(value) ? std::string::npos : 0;
                  };
              }),
         number("probe", "R", "probe radius [Å]", structures, OF(options.probe)), maxInput}};
}

OptionGroup frameOptions()
{
    const auto quiet = [](Option& o) { o.stored = nullptr; };
    const auto trajectory = [](Option& o) {
        o.stored = nullptr;
        o.file = wholeValue;
    };
    return {
        "Frames",
        {with(text("frames", "A-B:S",
                   "a surface for every S-th frame from A to B: models of\n"
                   "INPUT by their numbers, or frames of --trajectory; also\n"
                   "A, A- (to the end), all; files name.0001.vdb, ...; -o\n"
                   "name.csv: a table of all",
                   "", Build, OF(frames)),
              quiet),
         with(text("trajectory", "FILE", ".dcd or .xtc with the frames, its atoms those of INPUT",
                   "", Build, OF(trajectory)),
              trajectory),
         either("start",
                "cold: each frame as a run of its own; warm: its flow\n"
                "begins at the surface of the one before",
                "warm", "cold", Build, OF(warm))}};
}

OptionGroup surfaceOptions()
{
    Option fields{"fields",
                  0,
                  "LIST",
                  "grids of the .vdb, by commas, or all of\n" + inLines(knownFields()) +
                      ";\ncurvatures also at the vertices of a .ply; positive\n"
                      "where convex, 1/R on a ball; shape_index 1: a cap",
                  "surface",
                  surfaces,
                  knownFields()};
    fields.words.insert(fields.words.begin(), "all");
    fields.set = setFields;
    fields.stored = [](const Call& c) {
        std::string all = "surface";
        for (const std::string& field : c.options.fields) all += "," + field;
        return stored(all);
    };
    Option attributes = fields;
    attributes.text =
        "curvatures for the vertices of a .ply or .glb, by commas,\nas of vdb_molsurf --help";
    attributes.verbs = Convert;
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
            const double voxel = parsed<double>("lod", expected, word);
            if (!(voxel > (call.lod.empty() ? 0.0 : call.lod.back())))
                wrong("lod", expected, values.back());
            call.lod.push_back(voxel);
        }
        if (call.lod.size() < 2 || call.lod.size() > 8) wrong("lod", expected, values.back());
    };
    levels.stored = [](const Call& c) {
        Values all;
        for (const double voxel : c.lod) all.push_back(shortest(voxel));
        return stored(all.empty() ? "none" : joinWords(all, ","));
    };
    return {
        "Surface",
        {word("surface", "KIND",
              "variational; ses, sas: solvent-excluded, -accessible;\n"
              "vdw: van der Waals; gaussian",
              structures, OF(options.kind), surfaceKinds),
         number("voxel", "H", "edge of a voxel [Å], 0.05 to 10", structures, OF(options.voxel)),
         shownIn(Levels, levels),
         number("blobbiness", "D", "decay of the Gaussians of --surface gaussian", structures,
                OF(options.blobbiness)),
         flag("fill-cavities", "drop the inner walls", wholes | Compare, OF(options.fillCavities)),
         fields, attributes,
         shownIn(Grids,
                 flag("vdb-half", "floats of the .vdb in 16 bits, within 0.05 %: half the size",
                      surfaces, OF(options.halfFloats))),
         shownIn(Numbers,
                 flag("curvature-totals", "integrate curvature over the surface, for the report",
                      wholes, OF(options.curvatureTotals)))}};
}

OptionGroup resolutionOptions()
{
    Option resolution{"resolution",
                      0,
                      "[SEL=]D",
                      "blur to D [Å], 1 to 50, all atoms or those of a\n"
                      "selection; repeats, later ones win",
                      "",
                      structures,
                      {},
                      true};
    resolution.set = [](Call& call, const Values& values) {
        for (const std::string& value : values)
            call.atoms.resolutions.push_back(parseResolution(value));
    };
    resolution.stored = [](const Call& c) {
        Values all;
        for (const ResolutionRule& rule : c.atoms.resolutions)
            all.push_back((rule.select.empty() ? "" : rule.select + "=") +
                          shortest(rule.resolution));
        return stored(joinWords(all, ", "));
    };
    Option coarse{"coarse",
                  0,
                  "[SEL=]WORD",
                  "beads in the place of atoms: residue (its backbone and\n"
                  "side chain), N (about N atoms each) or atom; all or\n"
                  "those of a selection; repeats, later ones win",
                  "atom",
                  structures,
                  {"atom", "residue"},
                  true};
    coarse.set = [](Call& call, const Values& values) {
        for (const std::string& value : values) call.atoms.coarse.push_back(parseCoarse(value));
    };
    coarse.stored = [](const Call& c) {
        Values all;
        for (const CoarseRule& rule : c.atoms.coarse) all.push_back(nameOf(rule));
        return stored(all.empty() ? "atom" : joinWords(all, ", "));
    };
    return {"Resolution",
            {number("epsilon", "E", "tolerance of the Gaussian sum [Å]; larger is smoother",
                    structures, OF(options.epsilon)),
             resolution, coarse,
             flag("match-volume", "resolutions keep the volume of the fine surface",
                  wholes | Compare, OF(options.matchVolume))}};
}

OptionGroup groupOptions()
{
    Option surfaceOf{"surface-of",
                     0,
                     "GROUP=KIND",
                     "this group alone, by another --surface; repeats; the\n"
                     "other atoms together",
                     "",
                     wholes,
                     {},
                     true};
    surfaceOf.set = [](Call& call, const Values& values) {
        for (const std::string& value : values)
            call.options.surfaceOf.push_back(parseSurfaceOf(value));
    };
    surfaceOf.stored = [](const Call& c) {
        Values all;
        for (const auto& [name, kind] : c.options.surfaceOf)
            all.push_back(name + "=" + nameOf(kind));
        return stored(joinWords(all, ","));
    };
    Option split{"split", 0,      "group",  "a level set and a closed mesh for every group, alone",
                 "",      wholes, {"group"}};
    split.set = [](Call& call, const Values& values) {
        if (lowered(values.back()) != "group") wrong("split", "group", values.back());
        call.options.split = true;
    };
    split.stored = [](const Call& c) { return stored(c.options.split ? "group" : "none"); };
    const auto color = [](std::string text, std::string preset, unsigned verbs) {
        Option o = word("color", "WORD", std::move(text), verbs, OF(options.color), colorings());
        o.preset = std::move(preset);
        return o;
    };
    const auto orMore = [](Option o) {
        const Values words = {"copy", "entity", "class"};
        o.words.insert(o.words.end(), words.begin(), words.end());
        o.words.insert(o.words.end(), valueWords().begin(), valueWords().end());
        const Values files = {"table=", "potential=", "potential-out="};
        o.file = [files](const std::string& value) {
            for (const std::string& start : files)
                if (lowered(value).rfind(start, 0) == 0) return start.size();
            return std::string::npos;
        };
        for (const std::string& start : files) o.words.push_back(start + "FILE");
        o.words.push_back("residue-type");
        o.words.push_back("plain=#RRGGBB");
        o.set = [words, files, all = o.words, others = o.set](Call& call, const Values& values) {
            const std::string typed = lowered(values.back());
            const std::string word = typed == "residue-type" ? "residue" : typed;
            const auto among = [&](const Values& some) {
                return std::count(some.begin(), some.end(), word) > 0;
            };
            call.colorGroups = among(words) ? word : "";
            call.atoms.valueBy = among(valueWords()) ? word : "";
            for (const std::string& start : files)
                if (word == start)
                    wrong("color", start + "FILE", values.back());
                else if (word.rfind(start, 0) == 0)
                    call.atoms.valueBy = start + values.back().substr(start.size());
            call.options.color = call.atoms.valueBy.empty() ? ColorBy::Nothing : ColorBy::Value;
            call.atoms.plainColor.reset();
            if (word.rfind("plain=", 0) == 0) {
                call.atoms.plainColor = colorOf("color", "", word.substr(6));
                call.options.color = ColorBy::Plain;
                return;
            }
            if (!call.colorGroups.empty() || !call.atoms.valueBy.empty()) return;
            if (!among(all))
                wrong("color", joinWords(all, ", "), values.back(), didYouMean(word, all));
            others(call, {word});
        };
        o.stored = [others = o.stored](const Call& call) {
            if (!call.colorGroups.empty()) return stored(call.colorGroups);
            return call.atoms.valueBy.empty() ? others(call) : stored(call.atoms.valueBy);
        };
        return o;
    };
    Option range{"range", 0, "LOW,HIGH", "values at the ends of the colours", "", surfaces};
    range.set = [](Call& call, const Values& values) {
        const std::string expected = "two numbers LOW,HIGH, the first one less";
        const Values words = splitWords(values.back());
        if (words.size() != 2) wrong("range", expected, values.back());
        const double low = parsed<double>("range", expected, words[0]);
        const double high = parsed<double>("range", expected, words[1]);
        if (!(low < high)) wrong("range", expected, values.back());
        call.atoms.valueRange = {low, high};
    };
    range.stored = [](const Call& c) {
        const auto& r = c.atoms.valueRange;
        return stored(r ? shortest((*r)[0]) + "," + shortest((*r)[1]) : "auto");
    };
    return {
        "Groups",
        {with(text("groups", "FILE", "groups of atoms: JSON, or lines NAME SELECTION [COLOUR]", "",
                   surfaces, OF(groupsFile)),
              [](Option& o) {
                  o.stored = [](const Call& c) {
                      Values all;
                      for (const GroupRule& group : c.atoms.groups)
                          all.push_back(group.name + " " + group.select);
                      return stored(joinWords(all, ", "));
                  };
                  o.file = wholeValue;
              }),
         with(text("group-by", "WORD",
                   "groups by chain, entity, class (a chain's copies),\ncopy or residues:N instead",
                   "", surfaces, OF(atoms.groupBy)),
              [](Option& o) {
                  o.words = {"chain", "entity", "class", "copy"};
              }),
         split, surfaceOf,
         with(flag("interfaces", "buried areas between groups, for the report", wholes,
                   OF(options.interfaces)),
              [](Option& o) { o.stored = nullptr; }),
         orMore(color("colours of the mesh and the grid Cd: chain, entity, class,\n"
                      "copy, group, element, residue (or residue-type),\n"
                      "nucleotide, illustrative (chain, carbon lighter),\n"
                      "plain=#RRGGBB, mean-curvature, gaussian-curvature;\n"
                      "by value: bfactor, occupancy, charge, hydrophobicity,\n"
                      "rainbow, radius, table=FILE, potential=FILE.dx,\n"
                      "potential-out=FILE.dx (a probe out)",
                      "none", surfaces)),
         range,
         shownIn(CutBorders, with(flag("crisp", "mesh files: triangles are cut where colours meet",
                                       Build, OF(crisp)),
                                  [](Option& o) { o.stored = nullptr; })),
         color("chain, group (of grids chain_id, group_id), element,\n"
               "residue, nucleotide, illustrative (of Cd so coloured),\n"
               "mean-curvature, gaussian-curvature; those of Cd unless given",
               "", Convert)}};
}

OptionGroup areaOptions()
{
    Option areas{
        "areas",     0,
        "LIST",      "tables for the report, by commas: atoms, residues,\ncontacts, interfaces",
        "",          wholes,
        areaTables()};
    areas.set = [](Call& call, const Values& values) {
        call.areas = splitWords(lowered(values.back()));
        for (const std::string& table : call.areas)
            if (std::count(areaTables().begin(), areaTables().end(), table) == 0)
                wrong("areas", "some of " + joinWords(areaTables(), ", "), values.back(),
                      didYouMean(table, areaTables()));
    };
    return {"Areas",
            {shownIn(Numbers, areas),
             with(word("contacts", "LEVEL",
                       "contact areas between atoms, residues or chains: atom,\nresidue, chain",
                       wholes, OF(contacts), contactLevels),
                  [](Option& o) { o.stored = nullptr; })}};
}

OptionGroup sceneOptions()
{
    Option host{"for",
                0,
                "PROGRAM[=SCALE]",
                "blender, houdini or usd: a .vdb with density and Cd as\n"
                "that program takes it; SCALE mn-0.01, mn-0.1, nm, or\n"
                "units per Å; usd: a .usda beside the .vdb",
                "",
                wholes,
                {"blender", "houdini", "usd"}};
    host.set = setScene;
    host.stored = [](const Call& c) { return stored(nameOf(c.scene.host)); };
    return {
        "Scene",
        {shownIn(SceneUnits, host),
         flag("center", "the middle of the surface comes to the origin", wholes, OF(center)),
         shownIn(Millimetres,
                 number("print-scale", "S", ".stl, .obj, .3mf in mm, S of them per Å", "",
                        wholes | Convert, 1e-6, 1e6, "mm per Å, from 1e-6 to 1e6", OF(printScale))),
         with(number("min-wall", "W", "thicken what is thinner than W mm; with --print-scale", "",
                     wholes, 1e-300, 1e300, "a positive number of mm", OF(wall)),
              [](Option& o) {
                  o.stored = [](const Call& c) {
                      return openvdb::DoubleMetadata(c.options.minWall).copy();
                  };
              })}};
}

OptionGroup pictureOptions()
{
    constexpr unsigned draw = wholes | Convert;
    Option view{"view",
                0,
                "X,Y,Z",
                "direction toward the eye, or auto: the shortest extent\n"
                "toward the eye, the longest across",
                "auto",
                draw,
                {"auto"}};
    view.set = setView;
    Option background{"background",   0,
                      "COLOR",        "as #rrggbb or #rgb, a name such as black, or transparent",
                      "#ffffff",      draw,
                      {"transparent"}};
    background.set = setBackground;
    Option plain{"plain-color", 0, "COLOR", "of a surface without --color", "#8cb5de", draw};
    plain.set = [](Call& call, const Values& values) {
        call.picture.plain = colorOf("plain-color", "", values.back());
    };
    return {
        "Picture",
        {shownIn(Views, view),
         shownIn(Views, number("turn", "A", "turned by so many degrees about the upright", "0",
                               draw, -1e9, 1e9, "a number of degrees", OF(picture.turn))),
         shownIn(Pixels, count("size", "N", "width in pixels; the height follows the shape", "1200",
                               draw, 16, 16384, OF(picture.width))),
         shownIn(Pixels, background), shownIn(PlainColor, plain),
         shownIn(Pixels, with(flag("depth-cue", "distant parts fade to the background", draw,
                                   OF(picture.depthCue)),
                              [](Option& o) { o.stored = nullptr; })),
         shownIn(Pixels, with(word("legend", "WORD",
                                   "on or off; auto: beside colours, if 600 pixels wide\n"
                                   "or more",
                                   draw, OF(legend),
                                   {LegendChoice::Auto, LegendChoice::On, LegendChoice::Off}),
                              [](Option& o) { o.stored = nullptr; })),
         shownIn(Pixels, count("turntable", "N", "N pictures round the upright: name.0001.png, ...",
                               "", draw, 2, 9999, OF(turntable)))}};
}

OptionGroup flowOptions()
{
    const auto of = [](auto member) {
        return [=](auto& c) -> auto&
        {
            return c.options.evolution.*member;
        };
    };
    const auto steps = [](const char* none, auto member) {
        return [=](Option& o) {
            o.stored = [=](const Call& c) {
                const int n = c.options.evolution.*member;
                return stored(n >= 0 ? std::to_string(n) : none);
            };
        };
    };
    return {"Evolution",
            {number("lambda", "L", "weight of the regulariser [Å^2 for gradient, 1 for area]",
                    structures, of(&EvolveOptions::lambda)),
             word("regularizer", "KIND", "gradient or area", structures,
                  of(&EvolveOptions::regularizer), {Regularizer::Gradient, Regularizer::Area}),
             word("flow", "KIND", "newton, or paper: the paper's own scheme, for comparison",
                  structures, of(&EvolveOptions::flow), {Flow::Newton, Flow::Paper}),
             with(count("max-steps", "N", "steps at most", "50; paper: 200", structures, 0, 1000000,
                        of(&EvolveOptions::maxSteps)),
                  steps("default of the flow", &EvolveOptions::maxSteps)),
             with(count("steps", "N", "so many steps, converged or not",
                        std::to_string(defaultBrickSteps) + " in bricks, " +
                            std::to_string(defaultFrontSteps) + " at a large lambda",
                        structures, 0, 1000000, of(&EvolveOptions::steps)),
                  steps("by the stopping rule", &EvolveOptions::steps)),
             number("tolerance", "T",
                    "converged when the way left is below T voxels (rms), and\n"
                    "below 8 T on 99.9 % of the surface",
                    structures, of(&EvolveOptions::tolerance)),
             with(count("spline-level", "L", "spline on voxels of 2^L times the edge; 0, 1 or 2",
                        "0", wholes | Compare, 0, 2, OF(options.splineLevel)),
                  [](Option& o) {
                      o.stored = [](const Call& c) {
                          return openvdb::Int64Metadata(c.options.splineLevel).copy();
                      };
                  })}};
}

OptionGroup runOptions()
{
    const auto memory = [](unsigned verbs, std::string text) {
        Option o{"memory", 0, "SIZE", std::move(text), "", verbs};
        o.set = [](Call& call, const Values& values) {
            call.memory = parseSize("memory", values.back());
        };
        return o;
    };
    const auto flagOf = [](const char* name, char letter, const char* text, unsigned verbs,
                           const auto& of, bool on = true) {
        Option o = flag(name, text, verbs, of, on);
        o.letter = letter;
        o.stored = nullptr;
        return o;
    };
    return {"Run",
            {count("bricks", "N", "how many bricks, about as large each", "", BricksPlan, 1,
                   1000000, OF(bricks)),
             memory(BricksPlan, "or as many bricks as it takes for each to need no more,\n"
                                "such as 500M or 4G"),
             memory(Build, "memory at most, such as 4G: in bricks, one by one, if\n"
                           "the whole takes more; the flow then takes so many --steps"),
             number("max-hours", "H", "refuse what is estimated to take more hours", "24",
                    Build | Batch | Compare | Convert | BricksRun, 1e-6, 1e6,
                    "hours, from 1e-6 to 1e6", OF(hours)),
             flagOf("dry-run", 0, "say what it takes, and stop", Build | Convert, OF(dryRun)),
             with(count("threads", "N", "threads at most", "all", runs, 1, 4096, OF(threads)),
                  [](Option& o) { o.letter = 'j'; }),
             flagOf("quiet", 'q', "print errors only", runs, OF(quiet)),
             flagOf("verbose", 'v', "print the time of every stage",
                    Build | Batch | Compare | Convert | BricksMerge, OF(verbose)),
             flagOf("no-progress", 0, "no progress bar", runs, OF(progress), false),
             with(text("config", "FILE", "options as lines \"name = value\"; the command line wins",
                       "", structures | Convert, OF(config)),
                  [](Option& o) {
                      o.stored = nullptr;
                      o.file = wholeValue;
                  })}};
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

bool Call::drawsLegend() const
{
    constexpr int wide = 600; // pixels; in smaller pictures letters would take too much room
    return legend == LegendChoice::On || (legend == LegendChoice::Auto && picture.width >= wide);
}

const std::vector<OptionGroup>& optionTable()
{
    static const std::vector<OptionGroup> all = {
        outputOptions(),     atomOptions(),  frameOptions(), surfaceOptions(),
        resolutionOptions(), groupOptions(), areaOptions(),  sceneOptions(),
        pictureOptions(),    flowOptions(),  runOptions()};
    return all;
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
        if (file.option->stored && file.path != "-")
            add(file.option->name + ".sha256"s, openvdb::StringMetadata(sha256OfFile(file.path)));
}

} // namespace molsurf::tool
