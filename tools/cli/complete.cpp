// SPDX-License-Identifier: MPL-2.0
#include "cli/complete.h"

#include "cli/option_table.h"
#include "cli/pair_table.h"
#include "cli/verb_table.h"
#include "draw_result.h"
#include "outputs.h"
#include "sidecar.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/request/resolve.h"
#include "molsurf/request/run_outputs.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/frame_source.h"
#include "molsurf/surface/product_table.h"
#include "molsurf/surface/solver_files.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

namespace molsurf::tool
{

namespace
{

namespace fs = std::filesystem;

/// The words between spaces.
std::vector<std::string> wordsOf(const std::string& text)
{
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// The first part of a format of two parts, as "pockets" of "pockets.csv", that a word is or is
/// the singular or the plural of; empty: none.
std::string partNamed(const std::string& word)
{
    std::vector<std::string> parts = areaTables();
    parts.push_back("legend");
    for (const std::string& part : parts)
        if (word == part || word + "s" == part || word == part + "s") return part;
    return "";
}

/// Refuses a name as x.residues.json or x.pocket.ply, whose file would hold something else.
void checkTable(const std::string& path, const std::string& word)
{
    const std::string stem = path.substr(0, path.size() - std::min(word.size() + 1, path.size()));
    const std::string typed = lowered(stem.substr(stem.rfind('.') + 1)), table = partNamed(typed);
    if (!table.empty() && typed != table && word.find('.') == std::string::npos &&
        typed.size() < stem.size()) {
        const std::string meant =
            findFormat(table + "." + word) ? table + "." + word : table + ".csv";
        usageError("-o " + path + ": it would hold the whole surface [hint: -o FILE." + meant +
                   ", or a name without ." + typed + "]");
    }
    if (word.find('.') == std::string::npos && table.size() < stem.size() &&
        std::count(areaTables().begin(), areaTables().end(), table) > 0) {
        const std::string both = table + "." + word;
        if (findFormat(both))
            usageError("-o " + path + ": expected a name in front of ." + both +
                       " [hint: -o FILE." + both + "]");
        usageError("-o " + path + ": there are no " + table + " as ." + word + " [hint: -o FILE." +
                   table + ".csv, or -o FILE.json --areas " + table + "]");
    }
}

bool isFolder(const std::string& path)
{
    std::error_code ignored;
    return path.back() == '/' || fs::is_directory(path, ignored);
}

/// Refuses a name that ends in no format.
/// @param[in] word  its extension; may be empty
[[noreturn]] void refuseName(const CommandLine& call, const std::string& path,
                             const std::string& word)
{
    const std::string many = call.verb == Build ? ", or vdb_molsurf batch LIST -O " + path : "";
    if (isFolder(path))
        usageError("-o " + path + ": is a folder, expected a file [hint: -o " +
                   (fs::path(path) / "surface.ply").string() + many + "]");
    std::vector<std::string> known;
    for (const Format& format : formatTable())
        if (format.verbs & call.verb) known.push_back(format.word);
    if (word.empty())
        usageError("-o " + path + ": expected a name whose ending says what to write [hint: -o " +
                   path + "." + known.front() + ", -o " + path +
                   ".json; --help lists the formats]");
    std::string hint = didYouMean(word, known);
    for (const auto& [others, ours] :
         {std::pair("pdf jpg jpeg svg tif tiff eps webp bmp", "png"),
          std::pair("avi mov mkv mpg mpeg m4v", "mp4"), std::pair("gltf fbx dae blend abc", "glb"),
          std::pair("step stp gcode amf", "3mf")}) {
        const std::vector<std::string>& words = wordsOf(others);
        const Format* format = findFormat(ours);
        if (std::count(words.begin(), words.end(), word) > 0 && (format->verbs & call.verb))
            hint = std::string(" [hint: .") + ours + "; --help lists the formats]";
    }
    const bool packed = word == "gz" || word == "bz2" || word == "xz" || word == "zip";
    if (packed)
        hint = " [hint: a name without ." + word + "; a .vdb is compressed as it is written]";
    if (hint.empty()) hint = " [hint: --help lists the formats]";
    usageError("-o " + path + ": ." + word + " is no format that " + infoOf(call.verb).name +
               " writes" + hint);
}

/// The word of an output's format: a stream may have it by --format.
std::string wordOf(const CommandLine& call, const std::string& path)
{
    if (path == "-") return call.format;
    const std::string word = formatWordOf(path);
    const Format* known = findFormat(word);
    if (!known && isStream(path)) {
        if (call.format.empty()) usageError("-o " + path + ": expected --format too");
        return call.format;
    }
    checkTable(path, word);
    return word;
}

/// The files that APBS reads, in a folder.
std::vector<Output> outputsOfSolver(const CommandLine& call, const std::string& folder)
{
    std::vector<Output> files;
    for (const SolverFile& file : solverFiles())
        files.push_back({solverPath(folder, call.input, file.word), findFormat(file.word)});
    return files;
}

/// The files of --output.
std::vector<Output> outputsOf(const CommandLine& call)
{
    if (call.paths.empty() && call.verb != Compare)
        usageError("nothing to write [hint: -o FILE, for example -o surface.vdb]");
    std::vector<Output> outputs;
    std::set<std::string> seen;
    for (const std::string& path : call.paths) {
        std::error_code ignored;
        const std::string real =
            path == "-" ? path : fs::weakly_canonical(fs::absolute(path), ignored).string();
        if (!seen.insert(real).second) usageError("-o " + path + " is given twice");
        if (call.forApbs && isFolder(path)) {
            for (Output& file : outputsOfSolver(call, path)) outputs.push_back(std::move(file));
            continue;
        }
        const std::string word = wordOf(call, path);
        const Format* format = findFormat(word);
        if (!format) refuseName(call, path, word);
        if ((format->verbs & call.verb) == 0)
            usageError("-o " + path + ": " + infoOf(call.verb).name + " writes " +
                       endingsOf(~0u, call.verb, " or "));
        if (format->holds & Solver)
            usageError("-o " + path +
                       ": expected a folder for the files of APBS [hint: --for apbs "
                       "-o run/]");
        outputs.push_back({path, format});
    }
    return outputs;
}

/// A hint for many structures.
const char* manyHint(const CommandLine& call)
{
    return call.verb & (Build | Batch)
               ? " [hint: ls FILES | vdb_molsurf batch - -O DIR makes a surface of each]"
               : "";
}

/// The only input.
/// @param[in] what  "build: expected one INPUT", for example
void takeInput(CommandLine& call, const std::string& what, const std::string& hint)
{
    constexpr std::size_t few = 3; // that are named
    if (call.inputs.size() > 1) {
        std::vector<std::string> names;
        for (const std::string& name : call.inputs)
            if (names.size() < few) names.push_back("'" + name + "'");
        const std::string more =
            call.inputs.size() > few ? ", ... (" + std::to_string(call.inputs.size()) + ")" : "";
        usageError(what + ", got " + joinWords(names, ", ") + more + manyHint(call));
    }
    if (call.inputs.empty()) usageError(what + ", got none" + hint);
    if (call.inputs[0].empty()) usageError(what + ", got an empty word" + hint);
    call.input = call.inputs[0];
}

// Sets what the files of APBS need: charges, and the solvent-excluded surface unless another one is
// asked for. To be called before completeSurface().
void completeSolver(CommandLine& call)
{
    if (call.forApbs && !call.writes(Solver) && !call.paths.empty())
        usageError("--for apbs: expected a folder that gets its files [hint: -o run/]");
    if (!call.writes(Solver)) return;
    call.labels.charges = true;
    SurfaceSpec& surface = call.options;
    if (!call.has("surface") && surface.inset == 0.0) surface.kind = SurfaceKind::SolventExcluded;
    for (const std::string& warning : solverWarnings(surface, call.dielectric))
        call.warnings.push_back(withOptionNames(warning));
}

// Adds the fields and files that --for implies, and gives the least wall in Å, not in mm of the
// print. To be called before completeSurface().
void completeScene(CommandLine& call)
{
    if (call.scene.known() && (call.outputs.empty() || call.writes(anyGrids))) {
        for (const char* field : {"density", "Cd"}) {
            // Copies have colours instead of vertices.
            if (field == std::string("Cd") && call.colorsCopies()) continue;
            if (!hasField(call.options.fields, field)) call.options.fields.push_back(field);
        }
    }
    if (call.scene.host == Host::Usd) addSidecars(call);
    if (!call.has("min-thickness")) return;
    call.options.minThickness = call.wall / call.printScale;
    if (call.options.minThickness > maxThickness)
        usageError(
            formatted("--min-thickness: expected at most %g mm, which are %g Å at --print-scale "
                      "%g, got %g",
                      maxThickness * call.printScale, maxThickness, call.printScale, call.wall));
}

// The eye looks across what is upright.
void checkUpright(const CommandLine& call)
{
    constexpr double least = 1e-3; // sine of the angle between the two
    const openvdb::Vec3d &up = call.picture.upright, &toEye = call.picture.toEye;
    if (up.lengthSqr() > 0.0 && toEye.lengthSqr() > 0.0 &&
        up.cross(toEye).length() < least * up.length() * toEye.length())
        usageError("--up: expected a direction across that of --view, got the same");
}

// Puts the frames of a turntable in the place of each picture.
void addTurntable(CommandLine& call)
{
    call.outputs = withTurntable(call.outputs, call.turntable);
    call.picture.turnable = true;
}

// Scripts open a file that the same run writes.
void checkScripts(const CommandLine& call)
{
    for (const Output& script : call.outputs) {
        const std::string opens = script.format->opens;
        if (!opens.empty() &&
            std::none_of(call.outputs.begin(), call.outputs.end(),
                         [&](const Output& output) { return opens == output.format->word; }))
            usageError("-o " + script.path + ": expected -o FILE." + opens +
                       " too, which the script opens");
    }
}

// Says what none of the files can hold.
void warnOfLosses(CommandLine& call)
{
    checkUpright(call);
    checkScripts(call);
    warnOfPairs(call);
    if (call.outputs.empty()) return;
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if ((option.verbs & call.verb) && call.has(option.name) && option.shownIn &&
                !call.writes(option.shownIn))
                call.warnings.push_back(std::string("--") + option.name + " is for " +
                                        endingsOf(option.shownIn, call.verb));
    const bool means = call.options.ballAreas && call.labels.valueBy; // in tables
    if (!call.shows.empty() && call.writes(ColorChoices) && !call.writes(Pixels))
        call.warnings.push_back("--show: atoms are in " + endingsOf(Pixels, call.verb));
    if (call.has("color") && call.options.color != ColorBy::Nothing && !means &&
        !call.writes(Colors))
        call.warnings.push_back("--color: none of the files can hold colours [hint: -o .ply, .glb, "
                                ".png or .html, for example]");
    if (!call.has("fields") || call.writes(anyGrids)) return;
    std::vector<std::string> lost;
    for (const std::string& field : call.options.fields)
        if (!(call.writes(VertexCurvatures) && findField(field)->atVertices) &&
            !(call.writes(Areas) && findField(field)->inTables))
            lost.push_back(field);
    if (!lost.empty())
        call.warnings.push_back("--fields " + joinWords(lost, ",") +
                                ": none of the files can hold that [hint: -o .vdb]");
}

void dropField(CommandLine& call, const char* field)
{
    std::vector<std::string>& fields = call.options.fields;
    fields.erase(std::remove(fields.begin(), fields.end(), field), fields.end());
}

void completeFrames(CommandLine& call)
{
    if (call.frames.empty() && !call.trajectory.empty()) call.frames = "all";
    if (call.frames.empty()) {
        dropField(call, "v");
        return;
    }
    parseFrames(call.frames);
    if (call.trajectory == "-") usageError("--trajectory -: expected a file, it is read at random");
}

/// Whether all that is asked for is known in closed form.
bool asksForNumbers(const CommandLine& call)
{
    const std::optional<ValueBy>& value = call.labels.valueBy;
    const bool unit = call.atoms.assembly.bySymmetry; // a mesh of it says nothing more of the whole
    // Bricks and prototypes are of grids; completeAreas() refuses them with areas.
    const bool ofGrid = call.memory > 0 || call.atoms.assembly.instances;
    const unsigned some =
        Areas | FrameRows | Shares | (ofGrid && call.areas.empty() ? 0u : Numbers);
    return (call.verb & (Build | Batch)) != 0 && hasClosedForm(call.options) &&
           call.required.empty() && !(value && value->byPoint()) &&
           !(unit && (value || !isBoundary(call.options))) && !call.center && call.writesOnly(some);
}

// Sets what tables of areas need: their surface, names, groups, and whether there is a grid at all.
// To be called before completeGroups().
void completeAreas(CommandLine& call)
{
    std::set<std::string> tables(call.areas.begin(), call.areas.end());
    for (const Output& output : call.outputs)
        if (output.holds(Areas)) tables.insert(output.format->table);
    if (!call.has("surface") && (!tables.empty() || call.options.interfaces)) {
        // In the field, areas of residues and of interfaces are those of this surface.
        call.options.areasOf = SurfaceKind::SolventAccessible;
        if (call.writesOnly(Areas | Shares) && !call.options.patches)
            call.options.kind = SurfaceKind::SolventAccessible;
    }
    call.options.pockets |= call.showsPockets() || call.writes(Shares);
    call.options.grid = !asksForNumbers(call);
    call.labels.names = !tables.empty() || call.writes(ColorChoices | Density | Mask);
    SurfaceOptions& options = call.options;
    options.interfaces |= tables.count("interfaces") > 0;
    if (tables.empty()) return;
    options.contacts = tables.count("contacts") > 0;
    options.pockets |= tables.count("pockets") > 0;
    if (tables.count("pore") > 0 && call.places.pore.empty()) call.places.pore = "auto";
    for (const char* ofBalls : {"atoms", "residues", "interfaces", "forces"})
        options.ballAreas |= tables.count(ofBalls) > 0;
}

void completeGroups(CommandLine& call)
{
    SurfaceOptions& options = call.options;
    if (!call.groupsFile.empty())
        call.labels.groups = readGroups(call.groupsFile, call.atoms.limits.maxInput);
    resolveGroups(call, call.scene.known());
    const bool labels = std::any_of(options.fields.begin(), options.fields.end(),
                                    [](auto& field) { return findField(field)->needsLabels; });
    call.labels.labels = options.color != ColorBy::Nothing || labels || call.writes(ColorChoices);
}

void completeInstances(CommandLine& call)
{
    if (!call.atoms.assembly.instances) return;
    for (const Output& output : call.outputs)
        if (!output.holds(Copies))
            call.warnings.push_back(
                "-o " + output.path +
                ": it holds each distinct copy once [hint: -o FILE.glb has all]");
}

void completeLevels(CommandLine& call)
{
    if (call.lod.empty()) return;
    call.options.voxel = call.lod.front();
    SurfaceOptions coarsest = call.options;
    coarsest.voxel = call.lod.back();
    checkOptions(coarsest);
}

void completeSymmetry(CommandLine& call)
{
    if (!call.atoms.assembly.bySymmetry) return;
    checkWay(BySymmetry, call.options);
    SurfaceOptions coarsest = call.options;
    if (!call.lod.empty()) coarsest.voxel = call.lod.back();
    call.atoms.assembly.surroundings = surroundingsOf(coarsest);
}

} // namespace

void completeSurface(CommandLine& call)
{
    completeAreas(call);
    completeGroups(call);
    SurfaceOptions& options = call.options;
    checkOptions(call.atoms);
    checkOptions(call.places);
    checkOptions(call.labels);
    checkOptions(options);
    for (const Panel& panel : call.panels) checkOptions(panelOptions(options, panel));

    std::vector<SurfaceKind> kinds;
    for (const Panel& panel : call.panels)
        if (panel.kind) kinds.push_back(*panel.kind);
    for (const std::string& warning : settingWarnings(
             call, [&](const char* name) { return call.has(name); }, kinds))
        call.warnings.push_back(withOptionNames(warning));
}

void completeBuild(CommandLine& call)
{
    takeInput(
        call, "expected one INPUT",
        " [hint: vdb_molsurf molecule.pdb -o surface.vdb; vdb_molsurf --help lists the options]");
    if (!call.dryRun || !call.paths.empty()) call.outputs = outputsOf(call);
    completeFrames(call);
    completeInstances(call);
    completeLevels(call);
    completeSymmetry(call);
    completeScene(call);
    completeSolver(call);
    completeSurface(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completeBatch(CommandLine& call)
{
    takeInput(call, "batch: expected one list of structure files",
              " [hint: vdb_molsurf batch list.txt -O surfaces]");
    if (call.forApbs) usageError("batch: --for apbs is for one structure at a time");
    if (call.folder.empty()) usageError("batch: nowhere to write to [hint: -O DIR]");
    std::set<std::string> seen;
    for (const std::string& word : splitWords(lowered(call.formats))) {
        const Format* format = findFormat(word);
        if (!format || (format->verbs & Batch) == 0 || !seen.insert(word).second)
            usageError("--formats: expected some of " + endingsOf(~0u, Batch) + ", got '" +
                       call.formats + "'");
        call.outputs.push_back({"." + word, format});
    }
    dropField(call, "v");
    completeScene(call);
    completeSurface(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completeCompare(CommandLine& call)
{
    if (call.inputs.size() != 2)
        usageError("compare: expected two surfaces, A and B, got " +
                   std::to_string(call.inputs.size()) +
                   " [hint: vdb_molsurf compare a.vdb b.ply -o difference.ply]");
    for (const std::string& file : call.inputs)
        if (file.empty()) usageError("compare: expected the name of a file, got an empty word");
    if (call.inputs[0] == "-" && call.inputs[1] == "-")
        usageError("compare: - - : standard input can be only one of the two");
    call.input = call.inputs[0];
    call.outputs = outputsOf(call);
    completeSurface(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completeConvert(CommandLine& call)
{
    takeInput(call, "convert: expected one .vdb file or map",
              " [hint: vdb_molsurf convert surface.vdb -o surface.ply]");
    if (!call.dryRun || !call.paths.empty()) call.outputs = outputsOf(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completePlan(CommandLine& call)
{
    takeInput(call, "bricks plan: expected one structure file",
              " [hint: vdb_molsurf bricks plan molecule.cif -o plan.json --bricks 8]");
    if (call.input == "-") usageError("bricks plan: expected a file, got standard input");
    if (call.paths.size() != 1)
        usageError("bricks plan: expected one file to write [hint: -o plan.json]");
    if (call.paths[0] == "-" || formatWordOf(call.paths[0]) != "json")
        usageError("-o " + call.paths[0] + ": expected a name that ends in .json");
    call.outputs = {{call.paths[0], findFormat("json")}};
    if (call.bricks == 0 && call.memory == 0)
        usageError("bricks plan: expected either --bricks N or --memory SIZE");
    completeSurface(call);
    checkWay(InBricks, call.options);
}

void completeBrick(CommandLine& call)
{
    const std::string hint = " [hint: vdb_molsurf bricks run plan.json 1]";
    if (call.inputs.size() != 2)
        usageError("bricks run: expected a plan and the number of a brick" + hint);
    call.input = call.inputs[0];
    const std::string& word = call.inputs[1];
    if (!parseWhole(word, call.brick) || call.brick == 0)
        usageError("bricks run: expected a number from 1 on, got '" + word + "'" + hint);
}

void completeMerge(CommandLine& call)
{
    takeInput(call, "bricks merge: expected one plan",
              " [hint: vdb_molsurf bricks merge plan.json -o surface.vdb]");
    call.outputs = outputsOf(call);
}

void completeInfo(CommandLine& call)
{
    if (call.inputs.empty()) usageError("info: expected a FILE");
}

} // namespace molsurf::tool
