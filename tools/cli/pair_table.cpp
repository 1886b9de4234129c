// SPDX-License-Identifier: MPL-2.0
#include "cli/pair_table.h"

#include "cli/option_table.h"

#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/io/output_file.h"

#include <algorithm>
#include <optional>

namespace molsurf::tool
{

namespace
{

/// Tables of areas, in files or in the report.
constexpr const char* ofAtoms = "areas by atom";
constexpr const char* ofResidues = "contacts or interfaces of residues";
constexpr const char* ofForces = "forces";

Pair areasWithout(const char* option, const char* why)
{
    return {option, Excludes, {{Areas, "", ofAtoms}, {"areas", ofAtoms}}, why};
}

bool hasAreasInClosedForm(const CommandLine& call)
{
    SurfaceOptions shown = call.options;
    shown.kind = shown.areasOf.value_or(shown.kind);
    return !shown.ballAreas || isBoundary(shown);
}

/// Rows of units, bricks and groups of atoms.
std::vector<Pair> assemblyPairs()
{
    const auto coloured = [](const char* what, const char* hint) {
        return Pair{what, Excludes, {"groups", "group-by"}, hint, [](const CommandLine& call) {
                        return call.colorsCopies();
                    }};
    };
    const auto ofGroups = [](const char* what) {
        return Pair{
            what, Needs, {"groups", "group-by", "color=groups"}, "", [](const CommandLine& call) {
                const bool later = call.outputs.empty() && !call.dryRun;
                return later || call.labels.groupBy || call.verb == Convert;
            }};
    };
    return {{"weld", Needs, {"by-symmetry"}},
            {"weld", Excludes, {"sharp-colors"}},
            {"lod", Needs, {"instances", "by-symmetry"}},
            {"pieces", Excludes, {"by-symmetry", "instances", "memory", "lod"}},
            {"show=others", Needs, {"copies"}, " [hint: --copies fold:5, for example]"},
            {"show=others", Excludes, {"frames", "trajectory"}},
            {"lod", Excludes, {"voxel"}, ": the first of --lod is the voxel"},
            {"instances",
             Excludes,
             {"interfaces", "frames", "trajectory", "memory", "center", "color=radius",
              "color=potential", "color=pocket", "show=pockets", "pockets", "patches", "pore",
              "tunnels-from"}},
            {"by-symmetry",
             Excludes,
             {"pockets", "color=pocket", "show=pockets", "patches", "pore", "tunnels-from",
              "frames", "trajectory", "memory", "dry-run", "center", "color=potential"}},
            {holds::Content(anyGrids | Volume),
             Excludes,
             {"by-symmetry"},
             ": it makes no grid of the whole [hint: --memory 8G in its place makes it in bricks]"},
            {"memory",
             Excludes,
             {"for"},
             ": the density of a .vdb needs the whole at once [hint: --fields surface,Cd in its "
             "place]",
             [](const CommandLine& call) { return !call.writes(anyGrids); }},
            {"by-symmetry",
             Excludes,
             {{Areas, "contacts", ofResidues},
              {Areas, "interfaces", ofResidues},
              {"areas=contacts", ofResidues},
              {"areas=interfaces", ofResidues},
              {Areas, "forces", ofForces},
              {"areas=forces", ofForces}},
             " [hint: without --by-symmetry]"},
            {"color=copy", Needs, {"assembly"}},
            {"groups", Excludes, {"group-by"}},
            coloured("color=copy", " [hint: --group-by copy --color group]"),
            coloured("color=entity", " [hint: --group-by entity --color group]"),
            coloured("color=class", " [hint: --group-by class --color group]"),
            ofGroups("split"),
            ofGroups("surface-of"),
            ofGroups("color=group")};
}

std::vector<Pair> areaPairs()
{
    Pair memory = areasWithout("memory", " [hint: --surface sas needs no grid]");
    memory.unless = [](const CommandLine& call) {
        return call.outputs.empty() || !call.options.grid;
    };
    Pair unit =
        areasWithout("by-symmetry", ": expected a closed form [hint: --surface sas or vdw]");
    unit.unless = hasAreasInClosedForm;
    const std::vector<Thing> forces = {{Areas, "forces", ofForces}, {"areas=forces", ofForces}};
    const auto rests = [](const CommandLine& call) { return restsInClosedForm(call.options); };
    const auto patches = [](const Thing& thing) {
        return Pair{
            thing, Needs, {"patches"}, " [hint: --patches 'hydrophobicity>0', for example]"};
    };
    return {{"instances", Excludes, forces, " [hint: without --instances]"},
            patches({Areas, "patches"}),
            patches("areas=patches"),
            patches("color=patch"),
            {"patches",
             IsFor,
             {{Areas, "patches"}, "areas=patches", "color=patch"},
             ".patches.csv, .patches.pdb, --areas patches and --color patch"},
            {"patches", Excludes, {"split", "surface-of", "memory"}, ": they are of one mesh"},
            areasWithout("coarse", " [hint: a run without --coarse]"),
            areasWithout("split", " [hint: --interfaces has the areas of groups alone]"),
            areasWithout("surface-of", " [hint: a run without --surface-of]"),
            areasWithout("instances", " [hint: --by-symmetry has those of a unit in the whole]"),
            memory,
            unit,
            {"surface=gaussian", Excludes, forces, " [hint: --surface smooth-sas]"},
            {"surface=variational", Excludes, forces,
             ": expected a surface at rest in closed form [hint: --lambda 0.02, without --flow and "
             "--steps]",
             rests},
            {"fill-cavities", Excludes, forces},
            {"pieces", Excludes, forces},
            {"min-thickness", Excludes, forces},
            {"contacts", IsFor, {{Areas, "contacts"}, "areas=contacts"}, ".contacts.csv"}};
}

/// Rows of triangles of an even size.
std::vector<Pair> meshPairs()
{
    const auto nothing = [](const CommandLine& call) { return call.outputs.empty(); };
    const auto ofMesh = [=](const char* option) {
        return Pair{option,
                    Needs,
                    {{holds::Content(Triangles | Copies | Views | Pixels), "", "-o FILE.ply"}},
                    ": it makes a mesh",
                    nothing};
    };
    return {
        ofMesh("remesh"),
        ofMesh("density"),
        {"remesh", Excludes, {"density"}, ": both say how large the triangles are"},
        {"adapt", Needs, {"remesh", "density"}},
        {"sharp-colors", Excludes, {"remesh", "density"}, ": it cuts triangles where colours meet"},
        {"lod", Excludes, {"remesh", "density"}, ": its triangles are as large as its voxels"}};
}

std::vector<Pair> pocketPairs()
{
    std::vector<Pair> pairs;
    const std::vector<Thing> pockets = {
        "pockets", "color=pocket", "show=pockets", {Areas, "pockets"}, "areas=pockets"};
    for (const char* option : {"pocket-at", "probe-in", "pocket-cut", "pocket-neck"})
        pairs.push_back({option, IsFor, pockets, "--pockets and .pockets.csv"});
    std::vector<Thing> both = pockets;
    both.push_back("tunnels-from");
    pairs.push_back({"probe-out", IsFor, both, "--pockets, .pockets.csv and --tunnels-from"});
    pairs.push_back({"tunnel-probe", IsFor, {"tunnels-from"}});
    const char* place = " [hint: --tunnels-from \"resid 57\", for example]";
    pairs.push_back({{Areas, "tunnels"}, Needs, {"tunnels-from"}, place});
    pairs.push_back({"areas=tunnels", Needs, {"tunnels-from"}, place});
    pairs.push_back({{Areas, "tunnel_frames"}, Needs, {"tunnels-from"}, place});
    pairs.push_back({{Areas, "tunnel_frames"},
                     Needs,
                     {"frames", "trajectory"},
                     " [hint: -o FILE.tunnels.csv for one]"});
    return pairs;
}

/// Rows of how values are shown.
std::vector<Pair> valuePairs()
{
    const auto ofValues = [](const char* option) {
        return Pair{
            option, IsFor, {}, "--color by a value or a curvature", [](const CommandLine& call) {
                const ColorBy by = call.options.color;
                return call.verb == Compare || call.labels.valueBy || kindOf(by).ofCurvature ||
                       (call.verb == Convert && by == ColorBy::Nothing);
            }};
    };
    Pair smooth = ofValues("smooth-colors");
    smooth.others = {"patches"};
    smooth.why = "--color by a value or a curvature, and --patches";
    const auto ofAtomValues = [](const CommandLine& call) {
        return call.labels.valueBy && !call.labels.valueBy->byPoint();
    };
    return {ofValues("range"),
            ofValues("palette"),
            smooth,
            {"smooth-colors",
             Excludes,
             {"flat-values", "fields=cd", "fields=value"},
             ": means over the surface are at vertices"},
            {"smooth-colors",
             Excludes,
             {"split", "surface-of", "instances", "by-symmetry", "memory"},
             ": they are of one mesh"},
            {"value-of", IsFor, {}, "--color by a value of atoms, as bfactor", ofAtomValues},
            {"flat-values", IsFor, {}, "--color by a value of atoms, as bfactor", ofAtomValues},
            {"potential-offset", IsFor, {"color=potential"}},
            {"sharp-colors",
             IsFor,
             {},
             "--color in flat colours, as chain or element",
             [](const CommandLine& call) {
                 const bool blended =
                     call.options.color == ColorBy::Value && !call.labels.coloring.flat;
                 return !blended && kindOf(call.options.color).hasBorders != nullptr;
             }}};
}

std::vector<Pair> surfacePairs()
{
    const auto unlessAll = [](const CommandLine& call) {
        const auto& rules = call.atoms.resolutions;
        return std::none_of(rules.begin(), rules.end(),
                            [](const ResolutionRule& rule) { return rule.select.empty(); });
    };
    return {{"fog-density", Needs, {"for"}},
            {"match=ses",
             Excludes,
             {"epsilon", "lambda", "resolution"},
             ": it has values of its own for both"},
            {"min-thickness", Needs, {"print-scale"}},
            {"steps", Excludes, {"max-steps"}},
            {"no-hetero", Excludes, {"hetero", "ions"}},
            {"epsilon",
             Excludes,
             {"resolution"},
             ": a resolution for all atoms says how smooth it is, too",
             unlessAll},
            {"match-volume", IsFor, {"resolution"}},
            {"legend",
             IsFor,
             {"color", "show"},
             "",
             [](const CommandLine& call) {
                 return (call.verb & (Convert | Compare)) != 0 ||
                        !call.places.tunnelsFrom.empty() ||
                        call.options.color != ColorBy::Nothing; // --for chooses colours
             }},
            {"show-behind", IsFor, {"opacity"}},
            {"sharp-colors",
             IsFor,
             {},
             "one surface, without --split and --surface-of",
             [](const CommandLine& call) { return !call.options.ofParts(); }}};
}

/// Rows of structures that are laid on others.
std::vector<Pair> superposePairs()
{
    return {{"superpose",
             Needs,
             {"frames", "trajectory", "panel"},
             " [hint: vdb_molsurf compare A B --superpose auto]",
             [](const CommandLine& call) { return call.verb == Compare; }},
            {"superpose",
             Excludes,
             {"color=potential"},
             ": the map stays where it is [hint: another --color]"}};
}

/// Rows of files that hold one surface in a box.
std::vector<Pair> boxPairs()
{
    const std::vector<Thing> notOfPixels = {"split", "surface-of", "instances", "by-symmetry"};
    return {{{Solver},
             Excludes,
             {"frames", "trajectory", "split", "surface-of", "instances", "by-symmetry", "assembly",
              "coarse", "memory", "center"},
             ": charges are of the atoms of the file"},
            {{Density}, Needs, {"pixel-size"}, " [hint: --pixel-size 4, in Å]"},
            {{Mask}, Needs, {"pixel-size"}, " [hint: --pixel-size 4, in Å]"},
            {{Density}, Excludes, notOfPixels, ": it holds one surface"},
            {{Mask}, Excludes, notOfPixels, ": it holds one surface"},
            {{Volume},
             Excludes,
             {"split", "surface-of", "instances"},
             ": it holds one surface [hint: -o FILE.vdb holds all]"}};
}

/// Rows of frames, files and the run.
std::vector<Pair> runPairs()
{
    const auto fromModels = [](const CommandLine& call) { return !call.trajectory.empty(); };
    const auto ofPlan = [](const CommandLine& call) { return call.verb == BricksPlan; };
    const auto toPipe = [](const CommandLine& call) {
        return std::any_of(call.paths.begin(), call.paths.end(), isStream);
    };
    const auto ofStored = [](const CommandLine& call) { return call.verb == Convert; };
    const std::vector<Thing> notOfFrames = {"memory", "dry-run", "turntable", "output=-"};
    return {
        {"quiet", Excludes, {"verbose"}},
        {"bricks", Excludes, {"memory"}},
        {"frames", Excludes, notOfFrames},
        {"trajectory", Excludes, notOfFrames},
        {"model", Excludes, {"frames"}, ": frames are models [hint: --trajectory]", fromModels},
        {"fps",
         Needs,
         {"frames", "trajectory", {Moving, "", "-o FILE.mp4"}},
         "",
         [](const CommandLine& call) { return call.outputs.empty(); }},
        {"first-frame", Needs, {"frames", "trajectory"}},
        {"update-selections", Needs, {"frames", "trajectory"}},
        {"update-selections", Excludes, {"fields=v"}, ": its atoms have to be those of all frames"},
        {{Shares}, Needs, {"frames", "trajectory"}},
        {"start", IsFor, {"frames", "trajectory"}, "--frames"},
        {"fields=v", Needs, {"frames", "trajectory"}, ": it is the way between frames", ofStored},
        {{FrameRows}, Needs, {"frames", "trajectory"}, " [hint: -o FILE.residues.csv for areas]"},
        {"turntable", Excludes, {"output=-"}},
        {"panel", Excludes, {"frames", "trajectory", "memory", "dry-run", "center"}},
        {{Moving},
         Needs,
         {"turntable", "frames", "trajectory"},
         ": a film has several pictures [hint: --turntable 100]"},
        {{Moving}, Excludes, {"background=transparent"}, ": films are opaque"},
        {"require",
         Excludes,
         {"frames", "trajectory", "memory", "dry-run", "instances", "by-symmetry"}},
        {{Script}, Excludes, {"frames", "trajectory"}},
        {{Numbered}, Excludes, {"frames", "trajectory", "skip-existing", "output=-"}},
        {{Stage},
         Excludes,
         {"split", "surface-of"},
         ": a film has one mesh [hint: -o FILE.glb is a file for each frame]",
         [](const CommandLine& call) { return call.frames.empty(); }},
        {"skip-existing", Excludes, {"force", "frames", "trajectory", "dry-run", "output=-"}},
        {"skip-existing",
         Needs,
         {{Numbers, "", "-o FILE.json"}},
         ": it knows the files by their report",
         [](const CommandLine& call) { return call.outputs.empty(); }},
        {"format", Needs, {"output=-"}, ": the extension of a file says what it is", toPipe},
        {"output=-", Needs, {"format"}, " [hint: --format ply, for example]", ofPlan},
        {{Grids},
         Needs,
         {"color"},
         ": without it the file would be a copy",
         [](const CommandLine& call) {
             return call.verb != Convert || pointsOfMap(call.input) > 0;
         }}};
}

/// An option, and its value if there is one, as they are typed.
std::string typed(std::string words)
{
    const std::size_t equals = words.find('=');
    if (equals != std::string::npos) words[equals] = ' ';
    return words.rfind("output", 0) == 0 ? "-o" + words.substr(6) : "--" + words;
}

/// Whether a value of an option is the one that is looked for, or has it in its list.
/// @param[in] wanted  "": any value but none
bool isValue(const std::string& given, const std::string& wanted)
{
    const std::string value = lowered(given);
    if (wanted.empty()) return value != "none";
    if (value == wanted || value.rfind(wanted + "=", 0) == 0) return true;
    const std::vector<std::string> words = splitWords(value);
    return wanted != "-" && std::count(words.begin(), words.end(), wanted) > 0;
}

/// How a call has a thing; none: it has not.
std::optional<std::string> found(const CommandLine& call, const Thing& thing)
{
    std::string text;
    if (thing.holds) {
        const auto file = std::find_if(call.outputs.begin(), call.outputs.end(), [&](auto& o) {
            return o.beside.empty() && o.holds(thing.holds) &&
                   (!*thing.words || std::string(thing.words) == o.format->table);
        });
        if (file == call.outputs.end()) return std::nullopt;
        text = "-o " + file->path;
    } else {
        const std::string words = thing.words;
        const std::size_t equals = std::min(words.find('='), words.size());
        const std::string wanted = words.substr(std::min(equals + 1, words.size()));
        const auto given = call.given.find(words.substr(0, equals)); // a switch has no values
        if (given == call.given.end() ||
            (!given->second.empty() &&
             std::none_of(given->second.begin(), given->second.end(),
                          [&](const std::string& value) { return isValue(value, wanted); })))
            return std::nullopt;
        text = typed(words);
    }
    return thing.title ? std::string(thing.title) + " (" + text + ")" : text;
}

/// "--a or --b".
std::string anyOf(const std::vector<Thing>& things)
{
    std::string text;
    for (const Thing& thing : things)
        text += (text.empty() ? "" : " or ") + (thing.holds ? thing.title : typed(thing.words));
    return text;
}

} // namespace

const std::vector<Pair>& pairTable()
{
    static const std::vector<Pair> all = [] {
        std::vector<Pair> rows;
        for (auto* more : {runPairs, boxPairs, superposePairs, assemblyPairs, areaPairs, meshPairs,
                           pocketPairs, surfacePairs, valuePairs})
            for (Pair& row : more()) rows.push_back(std::move(row));
        return rows;
    }();
    return all;
}

void checkPairs(const CommandLine& call)
{
    for (const Pair& row : pairTable()) {
        if (row.pairing == IsFor || (row.unless && row.unless(call))) continue;
        const std::optional<std::string> thing = found(call, row.thing);
        if (!thing) continue;
        bool any = false;
        for (const Thing& other : row.others) {
            const std::optional<std::string> second = found(call, other);
            if (second && row.pairing == Excludes)
                usageError((other.title ? *second + " and " + *thing : *thing + " and " + *second) +
                           " together" + row.why);
            any = any || second;
        }
        if (row.pairing == Needs && !any)
            usageError(*thing + ": expected " + anyOf(row.others) + " too" + row.why);
    }
}

void warnOfPairs(CommandLine& call)
{
    for (const Pair& row : pairTable()) {
        if (row.pairing != IsFor || (row.unless && row.unless(call))) continue;
        const std::optional<std::string> thing = found(call, row.thing);
        if (!thing || std::any_of(row.others.begin(), row.others.end(), [&](const Thing& other) {
                return found(call, other).has_value();
            }))
            continue;
        call.warnings.push_back(*thing + " is for " + (*row.why ? row.why : anyOf(row.others)));
    }
}

} // namespace molsurf::tool
