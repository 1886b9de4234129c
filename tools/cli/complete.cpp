// SPDX-License-Identifier: MPL-2.0
#include "cli/complete.h"

#include "cli/option_table.h"
#include "cli/verb_table.h"
#include "sidecar.h"

#include "molsurf/bricks/run_brick.h"
#include "molsurf/color/color_table.h"
#include "molsurf/error.h"
#include "molsurf/selection/groups.h"
#include "molsurf/spline/curvature.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/frame_source.h"
#include "molsurf/surface/surface_kind.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

namespace molsurf::tool
{

namespace
{

namespace fs = std::filesystem;

/// The end of a file's name that says what it is: "ply", "atoms.csv".
std::string endOf(const std::string& path)
{
    const fs::path name = lowered(fs::path(path).filename().string());
    const std::string end = name.extension().string();
    if (end.empty()) return end;
    const std::string both = name.stem().extension().string() + end;
    return findFormat(both.substr(1)) ? both.substr(1) : end.substr(1);
}

/// Refuses a name as x.residues.json, whose file would hold something else.
void checkTable(const std::string& path, const std::string& word)
{
    const std::string stem = path.substr(0, path.size() - std::min(word.size() + 1, path.size()));
    const std::string table = lowered(stem.substr(stem.rfind('.') + 1));
    if (word.find('.') == std::string::npos && table.size() < stem.size() &&
        std::count(areaTables().begin(), areaTables().end(), table) > 0)
        misuse("-o " + path + ": there are no " + table + " as ." + word + " [hint: -o FILE." +
               table + ".csv, or -o FILE.json --areas " + table + "]");
}

/// The files of --output.
std::vector<Output> outputsOf(const Call& call)
{
    if (call.paths.empty() && call.verb != Compare)
        misuse("nothing to write [hint: -o FILE, for example -o surface.vdb]");
    if (!call.format.empty() && std::count(call.paths.begin(), call.paths.end(), "-") == 0)
        misuse("--format is for -o - only; the extension of a file says what it is");
    std::vector<Output> outputs;
    std::set<std::string> seen;
    for (const std::string& path : call.paths) {
        if (path == "-" && call.format.empty())
            misuse("-o -: expected --format too [hint: --format ply, for example]");
        std::error_code ignored;
        const std::string real =
            path == "-" ? path : fs::weakly_canonical(fs::absolute(path), ignored).string();
        if (!seen.insert(real).second) misuse("-o " + path + " is given twice");
        const std::string word = path == "-" ? call.format : endOf(path);
        if (path != "-") checkTable(path, word);
        const Format* format = findFormat(word);
        const std::string some = endingsOf(~0u, call.verb, " or ");
        if (!format) misuse("-o " + path + ": expected a name that ends in " + some);
        if ((format->verbs & call.verb) == 0)
            misuse("-o " + path + ": " + infoOf(call.verb).name + " writes " + some);
        outputs.push_back({path, format});
    }
    return outputs;
}

/// The only input.
/// @param[in] what  "build: expected one INPUT", for example
void takeInput(Call& call, const std::string& what, const std::string& hint)
{
    if (call.inputs.size() == 2 && !call.inputs[0].empty())
        misuse(what + ", got '" + call.inputs[0] + "' and '" + call.inputs[1] + "'" + hint);
    if (call.inputs.size() != 1)
        misuse(what + ", got " + std::to_string(call.inputs.size()) + hint);
    if (call.inputs[0].empty()) misuse(what + ", got an empty word" + hint);
    call.input = call.inputs[0];
}

bool builds(const Call& call, SurfaceKind kind)
{
    const auto& others = call.options.surfaceOf;
    return call.options.kind == kind ||
           std::any_of(others.begin(), others.end(),
                       [=](const auto& of) { return of.second == kind; });
}

void warnIfGiven(Call& call, std::initializer_list<const char*> options, const std::string& is)
{
    for (const char* name : options)
        if (call.has(name)) call.warnings.push_back(std::string("--") + name + " is for " + is);
}

/// Options that make sense together, or not.
struct Rule {
    const char* option;
    std::vector<std::string> others; ///< of which it needs one, or excludes all
    const char* why = "";            ///< the end of the message
};

const std::vector<Rule>& needed()
{
    static const std::vector<Rule> all = {{"min-wall", {"print-scale"}},
                                          {"weld", {"by-symmetry"}},
                                          {"lod", {"instances", "by-symmetry"}},
                                          {"instances", {"assembly"}, " [hint: --assembly 1]"},
                                          {"by-symmetry", {"assembly"}, " [hint: --assembly 1]"}};
    return all;
}

const std::vector<Rule>& excluded()
{
    static const std::vector<Rule> all = {
        {"groups", {"group-by"}},
        {"steps", {"max-steps"}},
        {"no-hetero", {"hetero", "ions"}},
        {"quiet", {"verbose"}},
        {"lod", {"voxel"}, ": the first of --lod is the voxel"},
        {"frames", {"memory", "dry-run", "turntable"}},
        {"trajectory", {"memory", "dry-run", "turntable"}},
        {"weld", {"crisp"}},
        {"instances",
         {"split", "surface-of", "interfaces", "frames", "trajectory", "memory", "center"}},
        {"by-symmetry",
         {"instances", "copies", "split", "surface-of", "frames", "trajectory", "memory", "dry-run",
          "center", "fill-cavities", "match-volume"}}};
    return all;
}

// To be called before completeSurface().
void completeScene(Call& call)
{
    if (call.scene.known()) {
        for (const char* field : {"density", "Cd"}) {
            // Copies have colours instead of vertices.
            if (field == std::string("Cd") && call.colorsCopies()) continue;
            if (!hasField(call.options.fields, field)) call.options.fields.push_back(field);
        }
    }
    if (call.scene.host == Host::Usd) addSidecars(call);
    if (call.has("min-wall")) call.options.minWall = call.wall / call.printScale;
}

// Puts the frames of a turntable in the place of each picture.
void addTurntable(Call& call)
{
    std::vector<Output> outputs;
    for (const Output& output : call.outputs) {
        if (!output.holds(Pixels)) {
            outputs.push_back(output);
            continue;
        }
        if (output.path == "-") misuse("--turntable: expected a file for the pictures, got -");
        for (int n = 0; n < call.turntable; ++n) {
            char number[16];
            std::snprintf(number, sizeof number, ".%04d", n + 1);
            Output frame = output;
            frame.path.insert(frame.path.size() - std::strlen(".png"), number);
            frame.turn = 360.0 * n / call.turntable;
            outputs.push_back(std::move(frame));
        }
    }
    call.outputs = std::move(outputs);
    call.picture.turnable = true;
}

// Says what none of the files can hold.
void warnOfLosses(Call& call)
{
    if (call.atoms.valueRange && call.atoms.valueBy.empty())
        call.warnings.push_back("--range is for --color by a value, as bfactor");
    if (call.crisp && !kindOf(call.options.color).hasBorders)
        call.warnings.push_back("--crisp is for --color chain, group, element or residue");
    if (call.crisp && (call.options.split || !call.options.surfaceOf.empty()))
        call.warnings.push_back("--crisp is not for surfaces of their own");
    if (call.outputs.empty()) return;
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if ((option.verbs & call.verb) && option.shownIn && !call.writes(option.shownIn))
                warnIfGiven(call, {option.name}, endingsOf(option.shownIn, call.verb));
    const bool means = call.options.ballAreas && !call.atoms.valueBy.empty(); // in tables
    if (call.has("color") && call.options.color != ColorBy::Nothing && !means &&
        !call.writes(Colors))
        call.warnings.push_back("--color: none of the files can hold colours [hint: -o .ply, .glb, "
                                ".png or .html, for example]");
    if (!call.has("fields") || call.writes(Grids)) return;
    std::vector<std::string> lost;
    for (const std::string& field : call.options.fields)
        if (!call.writes(VertexCurvatures) || !findCurvatureField(field)) lost.push_back(field);
    if (!lost.empty())
        call.warnings.push_back("--fields " + joinWords(lost, ",") +
                                ": none of the files can hold that [hint: -o .vdb]");
}

void completeFrames(Call& call)
{
    std::vector<std::string>& fields = call.options.fields;
    if (call.frames.empty() && !call.trajectory.empty()) call.frames = "all";
    if (call.frames.empty()) {
        if (call.writes(FrameRows))
            misuse("-o .csv is for --frames [hint: -o FILE.residues.csv for areas]");
        warnIfGiven(call, {"start"}, "--frames");
        if (call.has("fields")) {
            const auto words = splitWords(call.given.at("fields").back());
            if (std::count(words.begin(), words.end(), "v"))
                misuse("--fields v: a surface moves from frame to frame [hint: --frames]");
        }
        fields.erase(std::remove(fields.begin(), fields.end(), "v"), fields.end());
        return;
    }
    parseFrames(call.frames);
    if (call.trajectory.empty() && call.has("model"))
        misuse("--model and --frames together: frames are models [hint: --trajectory]");
    if (call.trajectory == "-") misuse("--trajectory -: expected a file, it is read at random");
    for (const Output& output : call.outputs)
        if (output.path == "-") misuse("--frames: expected files to write, got -");
}

/// Whether all that is asked for is known in closed form.
bool asksForNumbers(const Call& call)
{
    const std::string& value = call.atoms.valueBy;
    const bool byPoint = value == "radius" || value.rfind("potential", 0) == 0;
    const bool unit = call.atoms.bySymmetry; // a mesh of it says nothing more of the whole
    // Estimates, bricks and prototypes are of grids; completeAreas() refuses them with areas.
    const bool ofGrid = call.dryRun || call.memory > 0 || call.atoms.instances;
    const unsigned some = Areas | FrameRows | (ofGrid && call.areas.empty() ? 0u : Numbers);
    return (call.verb & (Build | Batch)) != 0 && hasClosedForm(call.options) && !byPoint &&
           !(unit && (!value.empty() || !isBoundary(call.options))) && !call.center &&
           call.writesOnly(some);
}

/// The first file with areas by atom.
std::string areaFile(const Call& call)
{
    for (const Output& output : call.outputs)
        if (output.holds(Areas)) return output.path;
    return "";
}

// To be called before completeGroups().
void completeAreas(Call& call)
{
    std::set<std::string> tables(call.areas.begin(), call.areas.end());
    for (const Output& output : call.outputs)
        if (output.holds(Areas)) tables.insert(output.format->table);
    if (tables.count("contacts") == 0) warnIfGiven(call, {"contacts"}, ".contacts.csv");
    if (!call.has("surface") && (!tables.empty() || call.options.interfaces)) {
        // The field's words mean this surface.
        call.options.areasOf = SurfaceKind::SolventAccessible;
        if (call.writesOnly(Areas)) call.options.kind = SurfaceKind::SolventAccessible;
    }
    call.options.grid = !asksForNumbers(call);
    if (tables.empty()) return;
    SurfaceOptions& options = call.options;
    const auto refuse = [&](const char* option, const char* hint) {
        if (call.has(option))
            misuse("areas by atom (" +
                   std::string(call.areas.empty() ? "-o " + areaFile(call) : "--areas") +
                   ") and --" + option + " together" + hint);
    };
    refuse("coarse", " [hint: a run without --coarse]");
    refuse("split", " [hint: --interfaces has the areas of groups alone]");
    refuse("surface-of", " [hint: a run without --surface-of]");
    refuse("instances", " [hint: --by-symmetry has those of a unit in the whole]");
    if (options.grid) refuse("memory", " [hint: --surface sas needs no grid]");
    refuse("dry-run", " [hint: --dry-run -o FILE.vdb]");
    call.atoms.names = true;
    options.contacts = tables.count("contacts") > 0;
    options.ballAreas = tables.size() > std::size_t(options.contacts);
    SurfaceOptions shown = options;
    shown.kind = options.areasOf.value_or(options.kind);
    if (call.atoms.bySymmetry && options.ballAreas && !isBoundary(shown))
        misuse("areas of atoms and --by-symmetry together: expected a closed form [hint: --surface "
               "sas or vdw]");
    if (call.atoms.bySymmetry && (options.contacts || tables.count("interfaces") > 0))
        misuse("contacts or interfaces of residues and --by-symmetry together [hint: without "
               "--by-symmetry]");
    if (tables.count("interfaces") == 0) return;
    options.interfaces = true;
    if (call.groupsFile.empty() && call.atoms.groupBy.empty() && call.colorGroups.empty())
        call.atoms.groupBy = "chain";
}

void completeGroups(Call& call)
{
    SurfaceOptions& options = call.options;
    if (!call.groupsFile.empty())
        call.atoms.groups = readGroups(call.groupsFile, call.atoms.maxInput);
    const bool copies = call.colorGroups == "copy";
    const bool asNodes = copies && (call.atoms.instances || call.atoms.bySymmetry);
    if (!call.colorGroups.empty() && !asNodes) {
        if (copies && call.atoms.assembly == "none")
            misuse("--color copy: expected --assembly too");
        if (!call.groupsFile.empty() || !call.atoms.groupBy.empty())
            misuse("--color " + call.colorGroups + " and groups together [hint: --group-by " +
                   call.colorGroups + " --color group]");
        call.atoms.groupBy = call.colorGroups;
        options.color = ColorBy::Group;
    }
    const bool groups = !call.groupsFile.empty() || !call.atoms.groupBy.empty();
    for (const char* name : {"split", "surface-of", "interfaces"})
        if (call.has(name) && !groups)
            misuse("--" + std::string(name) + ": expected --groups or --group-by too");
    if (options.color == ColorBy::Group && !groups)
        misuse("--color group: expected --groups or --group-by too");
    const auto has = [&](const char* field) { return hasField(options.fields, field); };
    if (has("Cd") && options.color == ColorBy::Nothing) options.color = ColorBy::Chain;
    call.atoms.labels = options.color != ColorBy::Nothing || has("chain_id") || has("Cd") ||
                        call.writes(ColorChoices);
}

void completeInstances(Call& call)
{
    if (!call.atoms.instances) {
        for (const Output& output : call.outputs)
            if (output.holds(Stage) && !call.atoms.bySymmetry)
                misuse("-o " + output.path +
                       ": expected --instances too [hint: --for usd -o FILE.vdb writes a volume]");
        return;
    }
    if (call.atoms.valueBy == "radius" || call.atoms.valueBy.rfind("potential", 0) == 0)
        misuse("--instances and --color " +
               call.atoms.valueBy.substr(0, call.atoms.valueBy.find('=')) + " together");
    for (const Output& output : call.outputs)
        if (!output.holds(Copies))
            call.warnings.push_back(
                "-o " + output.path +
                ": it holds each distinct copy once [hint: -o FILE.glb has all]");
}

void completeLevels(Call& call)
{
    if (call.lod.empty()) return;
    call.options.voxel = call.lod.front();
    SurfaceOptions coarsest = call.options;
    coarsest.voxel = call.lod.back();
    checkOptions(coarsest);
}

void completeSymmetry(Call& call)
{
    if (!call.atoms.bySymmetry) return;
    for (const Output& output : call.outputs)
        if (output.holds(Grids))
            misuse("-o " + output.path +
                   ": --by-symmetry makes no grid of the whole [hint: --memory 8G in its place "
                   "makes it in bricks]");
    if (call.atoms.valueBy.rfind("potential", 0) == 0)
        misuse("--by-symmetry and --color potential together");
    for (const std::string& field : call.options.fields)
        if (!findCurvatureField(field)) misuse("--by-symmetry and --fields " + field + " together");
    SurfaceOptions coarsest = call.options;
    if (!call.lod.empty()) coarsest.voxel = call.lod.back();
    call.atoms.surroundings = surroundingsOf(coarsest);
}

void completeResolutions(Call& call)
{
    const auto& rules = call.atoms.resolutions;
    const bool all = std::any_of(rules.begin(), rules.end(),
                                 [](const ResolutionRule& rule) { return rule.select.empty(); });
    if (all && call.has("epsilon"))
        misuse("--epsilon and a --resolution for all atoms together: both say how smooth it is");
    if (call.options.matchVolume && rules.empty())
        call.warnings.push_back("--match-volume is for --resolution");
}

} // namespace

void checkPairs(const Call& call)
{
    const auto given = [&](const std::string& name) {
        const auto found = call.given.find(name); // a switch has no values
        return found != call.given.end() &&
               (found->second.empty() || lowered(found->second.back()) != "none");
    };
    for (const Rule& rule : excluded())
        for (const std::string& other : rule.others)
            if (given(rule.option) && given(other))
                misuse("--" + std::string(rule.option) + " and --" + other + " together" +
                       rule.why);
    for (const Rule& rule : needed())
        if (given(rule.option) && std::none_of(rule.others.begin(), rule.others.end(), given))
            misuse("--" + std::string(rule.option) + ": expected --" +
                   joinWords(rule.others, " or --") + " too" + rule.why);
}

void completeSurface(Call& call)
{
    completeResolutions(call);
    completeAreas(call);
    completeGroups(call);
    SurfaceOptions& options = call.options;
    checkOptions(call.atoms);
    checkOptions(options);

    if (!builds(call, SurfaceKind::Variational))
        warnIfGiven(call,
                    {"epsilon", "resolution", "match-volume", "lambda", "regularizer", "flow",
                     "max-steps", "steps", "tolerance"},
                    "--surface variational");
    if (!builds(call, SurfaceKind::Gaussian))
        warnIfGiven(call, {"blobbiness"}, "--surface gaussian");
    if (options.voxel > coarseVoxel)
        call.warnings.push_back("--voxel " + shortest(options.voxel) +
                                ": voxels this large cannot show the atoms");
    if (call.has("epsilon") && builds(call, SurfaceKind::Variational) &&
        options.epsilon < 0.5 * options.voxel)
        call.warnings.push_back("--epsilon " + shortest(options.epsilon) +
                                ": a tolerance below half a voxel is not resolved");
}

void completeBuild(Call& call)
{
    takeInput(call, "expected one INPUT", " [hint: vdb_molsurf molecule.pdb -o surface.vdb]");
    if (!call.dryRun || !call.paths.empty()) call.outputs = outputsOf(call);
    completeFrames(call);
    completeInstances(call);
    completeLevels(call);
    completeSymmetry(call);
    completeScene(call);
    completeSurface(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completeBatch(Call& call)
{
    takeInput(call, "batch: expected one list of structure files",
              " [hint: vdb_molsurf batch list.txt -O surfaces]");
    if (call.folder.empty()) misuse("batch: nowhere to write to [hint: -O DIR]");
    std::set<std::string> seen;
    for (const std::string& word : splitWords(lowered(call.formats))) {
        const Format* format = findFormat(word);
        if (!format || (format->verbs & Batch) == 0 || !seen.insert(word).second)
            misuse("--formats: expected some of " + endingsOf(~0u, Batch) + ", got '" +
                   call.formats + "'");
        call.outputs.push_back({"." + word, format});
    }
    std::vector<std::string>& fields = call.options.fields;
    fields.erase(std::remove(fields.begin(), fields.end(), "v"), fields.end());
    completeScene(call);
    completeSurface(call);
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completeCompare(Call& call)
{
    if (call.inputs.size() != 2)
        misuse("compare: expected two surfaces, A and B, got " +
               std::to_string(call.inputs.size()) +
               " [hint: vdb_molsurf compare a.vdb b.ply -o difference.ply]");
    for (const std::string& file : call.inputs)
        if (file.empty()) misuse("compare: expected the name of a file, got an empty word");
    if (call.inputs[0] == "-" && call.inputs[1] == "-")
        misuse("compare: - - : standard input can be only one of the two");
    call.outputs = outputsOf(call);
    completeSurface(call);
}

void completeConvert(Call& call)
{
    takeInput(call, "convert: expected one .vdb file",
              " [hint: vdb_molsurf convert surface.vdb -o surface.ply]");
    if (!call.dryRun || !call.paths.empty()) call.outputs = outputsOf(call);
    if (call.writes(Grids) && call.options.color == ColorBy::Nothing)
        misuse("-o .vdb: expected --color too, without which it would be a copy");
    if (call.turntable > 0) addTurntable(call);
    warnOfLosses(call);
}

void completePlan(Call& call)
{
    takeInput(call, "bricks plan: expected one structure file",
              " [hint: vdb_molsurf bricks plan molecule.cif -o plan.json --bricks 8]");
    if (call.input == "-") misuse("bricks plan: expected a file, got standard input");
    if (call.paths.size() != 1)
        misuse("bricks plan: expected one file to write [hint: -o plan.json]");
    if (call.paths[0] == "-" || endOf(call.paths[0]) != "json")
        misuse("-o " + call.paths[0] + ": expected a name that ends in .json");
    call.outputs = {{call.paths[0], findFormat("json")}};
    if ((call.bricks > 0) == (call.memory > 0))
        misuse("bricks plan: expected either --bricks N or --memory SIZE");
    completeSurface(call);
    checkBrickOptions(call.options);
}

void completeBrick(Call& call)
{
    const std::string hint = " [hint: vdb_molsurf bricks run plan.json 1]";
    if (call.inputs.size() != 2)
        misuse("bricks run: expected a plan and the number of a brick" + hint);
    call.input = call.inputs[0];
    const std::string& word = call.inputs[1];
    const char* end = word.data() + word.size();
    const auto [stop, problem] = std::from_chars(word.data(), end, call.brick);
    if (problem != std::errc() || stop != end || call.brick == 0)
        misuse("bricks run: expected a number from 1 on, got '" + word + "'" + hint);
}

void completeMerge(Call& call)
{
    takeInput(call, "bricks merge: expected one plan",
              " [hint: vdb_molsurf bricks merge plan.json -o surface.vdb]");
    call.outputs = outputsOf(call);
}

void completeInfo(Call& call)
{
    if (call.inputs.empty()) misuse("info: expected a FILE");
}

} // namespace molsurf::tool
