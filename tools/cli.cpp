// SPDX-License-Identifier: MPL-2.0
#include "cli.h"

#include "cli_table.h"
#include "cli_values.h"
#include "frame_source.h"
#include "sidecar.h"

#include "molsurf/core/error.h"
#include "molsurf/surface/extra_grids.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace molsurf::tool
{

namespace po = boost::program_options;

namespace
{

const std::map<std::string, Format> formats = {
    {"vdb", Format::Vdb},   {"ply", Format::Ply}, {"obj", Format::Obj},    {"stl", Format::Stl},
    {"off", Format::Off},   {"glb", Format::Glb}, {"json", Format::Json},  {"png", Format::Png},
    {"html", Format::Html}, {"csv", Format::Csv}, {"3mf", Format::ThreeMf}};

po::options_description describeOptions(Verb verb)
{
    po::options_description all;
    for (const Group& group : groupsOf(verb)) {
        for (const Entry& entry : group.entries) {
            if (!entry.value)
                all.add_options()(entry.name, po::bool_switch());
            else if (entry.repeats)
                all.add_options()(entry.name, po::value<std::vector<std::string>>());
            else
                all.add_options()(entry.name, po::value<std::string>());
        }
    }
    all.add_options()("input", po::value<std::vector<std::string>>());
    return all;
}

Format formatOf(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    for (char& letter : extension)
        if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
    const auto found = formats.find(extension);
    if (found == formats.end())
        misuse("-o " + path +
               ": expected a name that ends in .vdb, .ply, .obj, .stl, .off, .glb, .3mf, .html, "
               ".json or "
               ".png");
    return found->second;
}

std::vector<Output> outputsOf(const Values& values)
{
    const std::vector<std::string> paths = values.list("output");
    if (paths.empty()) misuse("nothing to write [hint: -o FILE, for example -o surface.vdb]");

    std::string word;
    values.get("format", word);
    if (!word.empty() && !formats.count(word)) values.wrong("format", formatWords);
    if (!word.empty() && std::count(paths.begin(), paths.end(), "-") == 0)
        misuse("--format is for -o - only; the extension of a file says what it is");

    std::vector<Output> outputs;
    std::set<std::string> seen;
    for (const std::string& path : paths) {
        if (path == "-" && word.empty())
            misuse("-o -: expected --format too [hint: --format ply, for example]");
        std::error_code ignored;
        const std::string real =
            std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored).string();
        if (!seen.insert(path == "-" ? path : real).second)
            misuse("-o " + path + " is given twice");
        outputs.push_back({path, path == "-" ? formats.at(word) : formatOf(path), ""});
    }
    return outputs;
}

// `surface` is always written.
std::vector<std::string> fieldsOf(const Values& values)
{
    std::string list = "surface";
    values.get("fields", list);
    std::set<std::string> wanted;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string word = list.substr(begin, end - begin);
        if (word == "all")
            wanted.insert(knownFields().begin(), knownFields().end());
        else if (std::count(knownFields().begin(), knownFields().end(), word))
            wanted.insert(word);
        else
            misuse("--fields: unknown field '" + word + "' [hint: all, or some of " +
                   join(knownFields(), ",") + "]");
        begin = end + 1;
    }
    std::vector<std::string> fields;
    for (const std::string& field : knownFields())
        if (field != "surface" && wanted.count(field)) fields.push_back(field);
    return fields;
}

void fillRun(const Values& values, Call& call);
void fillFrames(const Values& values, Call& call);

bool writes(const Call& call, std::initializer_list<Format> some)
{
    return std::any_of(call.outputs.begin(), call.outputs.end(), [&](const Output& output) {
        return std::count(some.begin(), some.end(), output.format) > 0;
    });
}

constexpr SurfaceKind surfaceKinds[] = {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                        SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals,
                                        SurfaceKind::Gaussian};

// GROUP=KIND, the group ending at the last =.
std::pair<std::string, SurfaceKind> parseSurfaceOf(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    for (const SurfaceKind kind : surfaceKinds) {
        if (split != std::string::npos && split > 0 && text.substr(split + 1) == nameOf(kind))
            return {text.substr(0, split), kind};
    }
    misuse("--surface-of: expected GROUP=KIND with a kind of --surface, got '" + text + "'");
}

void fillGroups(const Values& values, Call& call)
{
    Options& options = call.options;
    values.get("group-by", options.atoms.groupBy);
    values.get("color", options.color,
               {ColorBy::Nothing, ColorBy::Chain, ColorBy::Group, ColorBy::Element,
                ColorBy::Residue, ColorBy::MeanCurvature, ColorBy::GaussianCurvature});
    std::string file;
    values.get("groups", file);
    if (!file.empty() && !options.atoms.groupBy.empty()) misuse("--groups and --group-by together");
    if (!file.empty()) options.atoms.groups = readGroups(file);
    const bool groups = !file.empty() || !options.atoms.groupBy.empty();
    std::string split;
    values.get("split", split);
    if (!split.empty() && split != "group") values.wrong("split", "group");
    options.split = !split.empty();
    options.interfaces = values.on("interfaces");
    for (const char* name : {"split", "surface-of", "interfaces"}) {
        const bool on = name == std::string("interfaces") ? options.interfaces : values.given(name);
        if (on && !groups)
            misuse("--" + std::string(name) + ": expected --groups or --group-by too");
    }
    if (options.color == ColorBy::Group && !groups)
        misuse("--color group: expected --groups or --group-by too");
    const auto has = [&](const char* field) { return hasField(options.fields, field); };
    if (has("Cd") && options.color == ColorBy::Nothing) options.color = ColorBy::Chain;
    options.atoms.labels = options.color != ColorBy::Nothing || has("chain_id") || has("Cd") ||
                           writes(call, {Format::Html});
}

// The .vdb for another program, and meshes to print. To be called before fillGroups().
void fillScene(const Values& values, Call& call)
{
    std::vector<std::string>& fields = call.options.fields;
    std::string word;
    values.get("for", word);
    if (!word.empty()) {
        const auto scene = parseScene(word);
        if (!scene)
            values.wrong("for", "blender, houdini or usd, perhaps with =mn-0.01, =mn-0.1, =nm or "
                                "=UNITS_PER_Å");
        call.scene = *scene;
        if (!writes(call, {Format::Vdb, Format::Glb}))
            call.warnings.push_back("--for is for .vdb and .glb");
        for (const char* field : {"density", "Cd"})
            if (!hasField(fields, field)) fields.push_back(field);
    }
    if (call.scene.host == Host::Usd) addSidecars(call);
    call.center = values.on("center");
    values.get("print-scale", call.printScale);
    if (values.given("print-scale")) {
        if (!(call.printScale >= 1e-6 && call.printScale <= 1e6))
            values.wrong("print-scale", "mm per Å, from 1e-6 to 1e6");
        if (!writes(call, {Format::Stl, Format::Obj, Format::ThreeMf}))
            call.warnings.push_back("--print-scale is for .stl, .obj and .3mf");
    }
    double wall = 0.0;
    values.get("min-wall", wall);
    if (!values.given("min-wall")) return;
    if (!values.given("print-scale")) misuse("--min-wall: expected --print-scale too");
    if (!(wall > 0.0)) values.wrong("min-wall", "a positive number of mm");
    call.options.minWall = wall / call.printScale;
}

// Puts the frames of a turntable in the place of each picture.
void addFrames(int count, Call& call)
{
    std::vector<Output> outputs;
    for (const Output& output : call.outputs) {
        if (output.format != Format::Png) {
            outputs.push_back(output);
            continue;
        }
        if (output.path == "-") misuse("--turntable: expected a file for the pictures, got -");
        for (int n = 0; n < count; ++n) {
            char number[16];
            std::snprintf(number, sizeof number, ".%04d", n + 1);
            Output frame = output;
            frame.path.insert(frame.path.size() - std::strlen(".png"), number);
            frame.turn = 360.0 * n / count;
            outputs.push_back(std::move(frame));
        }
    }
    call.outputs = std::move(outputs);
    call.picture.turnable = true;
}

// Toward the eye; up is y, or z when looking along y.
void fillPicture(const Values& values, Call& call)
{
    DrawOptions& picture = call.picture;
    std::string view = "auto";
    values.get("view", view);
    if (view != "auto") {
        const char *from = view.data(), *end = from + view.size();
        for (int i = 0; i < 3; ++i) {
            const auto [stop, problem] = std::from_chars(from, end, picture.toEye[i]);
            if (problem != std::errc() || (i < 2 ? stop == end || *stop != ',' : stop != end) ||
                !std::isfinite(picture.toEye[i]))
                values.wrong("view", "auto or a direction X,Y,Z");
            from = stop + 1;
        }
        if (!(picture.toEye.lengthSqr() > 0.0)) values.wrong("view", "auto or a direction X,Y,Z");
        const openvdb::Vec3d eye = picture.toEye.unit();
        picture.up = std::abs(eye.y()) < 0.99 ? openvdb::Vec3d(0, 1, 0) : openvdb::Vec3d(0, 0, 1);
    }
    values.get("turn", picture.turn);
    values.get("size", picture.width, 16, 16384);
    std::string color = "#ffffff";
    values.get("background", color);
    const auto parsed = parseColor(color);
    if (!parsed) values.wrong("background", "a color as #rrggbb");
    picture.background = *parsed;

    std::string legend = "auto";
    values.get("legend", legend);
    constexpr int wide = 600; // pixels; in smaller pictures letters would take too much room
    if (legend != "auto" && legend != "on" && legend != "off")
        values.wrong("legend", "auto, on or off");
    call.legend = legend == "on" || (legend == "auto" && picture.width >= wide);
    int frames = 0;
    values.get("turntable", frames, 2, 9999);
    if (frames > 0) addFrames(frames, call);
}

std::size_t memoryOf(const Values& values)
{
    std::string text;
    values.get("memory", text);
    const std::size_t bytes = text.empty() ? 0 : parseSize(text);
    if (!text.empty() && bytes == 0) values.wrong("memory", "a size such as 500M or 4G");
    return bytes;
}

void fillBuild(const Values& values, Call& call)
{
    const std::vector<std::string> inputs = values.list("input");
    if (inputs.empty()) misuse("no INPUT [hint: vdb_molsurf molecule.pdb -o surface.vdb]");
    if (inputs.size() > 1)
        misuse("expected one INPUT, got '" + inputs[0] + "' and '" + inputs[1] + "'");
    call.input = inputs[0];
    if (call.input.empty()) misuse("expected the name of a file as INPUT, got an empty word");
    call.dryRun = values.on("dry-run");
    call.memory = memoryOf(values);
    if (!call.dryRun || !values.list("output").empty()) call.outputs = outputsOf(values);
    fillRun(values, call);
    fillFrames(values, call);
    fillScene(values, call);
    fillGroups(values, call);
    fillPicture(values, call);
    const bool png = writes(call, {Format::Png});
    for (const char* name : {"size", "background", "legend", "turntable"})
        if (!png && values.given(name))
            call.warnings.push_back(std::string("--") + name + " is for .png");
    for (const char* name : {"view", "turn"})
        if (!png && !writes(call, {Format::Html}) && values.given(name))
            call.warnings.push_back(std::string("--") + name + " is for .png and .html");
}

// Frames and what only they have.
void fillFrames(const Values& values, Call& call)
{
    values.get("frames", call.frames);
    values.get("trajectory", call.trajectory);
    if (call.frames.empty() && !call.trajectory.empty()) call.frames = "all";
    std::string start = "cold";
    values.get("start", start);
    if (start != "warm" && start != "cold") values.wrong("start", "warm or cold");
    call.warm = start == "warm";
    std::vector<std::string>& fields = call.options.fields;
    if (call.frames.empty()) {
        if (writes(call, {Format::Csv})) misuse("-o .csv is for --frames");
        if (values.given("start")) call.warnings.push_back("--start is for --frames");
        std::string list;
        values.get("fields", list);
        if (("," + list + ",").find(",v,") != std::string::npos)
            misuse("--fields v: a surface moves from frame to frame [hint: --frames]");
        fields.erase(std::remove(fields.begin(), fields.end(), "v"), fields.end());
        return;
    }
    parseFrames(call.frames);
    if (call.memory > 0 || call.dryRun) misuse("--frames and --memory or --dry-run together");
    if (call.trajectory.empty() && values.given("model"))
        misuse("--model and --frames together: frames are models [hint: --trajectory]");
    if (values.given("turntable")) misuse("--turntable and --frames together");
    if (call.input == "-" && call.trajectory == "-")
        misuse("--trajectory -: expected a file, it is read at random");
    for (const Output& output : call.outputs)
        if (output.path == "-") misuse("--frames: expected files to write, got -");
}

// D or SELECTION=D, the selection ending at the last =.
ResolutionRule parseResolution(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    const std::string number = split == std::string::npos ? text : text.substr(split + 1);
    ResolutionRule rule;
    if (split != std::string::npos) rule.select = text.substr(0, split);
    const char* end = number.data() + number.size();
    const auto [stop, problem] = std::from_chars(number.data(), end, rule.resolution);
    if (problem != std::errc() || stop != end || split == 0 ||
        !(rule.resolution >= minResolution && rule.resolution <= maxResolution)) {
        misuse("--resolution: expected D or SELECTION=D with D from 1 to 50 Å, got '" + text + "'");
    }
    return rule;
}

// Of --epsilon and a --resolution for all atoms the later one wins.
void fillResolutions(const Values& values, Call& call)
{
    std::vector<ResolutionRule>& rules = call.options.atoms.resolutions;
    std::size_t all = 0; // 1 + the last rule for all atoms
    for (const std::string& text : values.list("resolution")) {
        rules.push_back(parseResolution(text));
        if (rules.back().select.empty()) all = rules.size();
    }
    if (all > 0 && values.given("epsilon")) {
        if (values.position("epsilon") > values.position("resolution", all - 1)) {
            call.warnings.push_back("--resolution for all atoms is without effect: --epsilon "
                                    "comes later");
            rules.erase(std::remove_if(rules.begin(), rules.begin() + std::ptrdiff_t(all),
                                       [](const ResolutionRule& r) { return r.select.empty(); }),
                        rules.begin() + std::ptrdiff_t(all));
        } else {
            call.warnings.push_back("--epsilon is without effect: --resolution for all atoms "
                                    "comes later");
        }
    }
    call.options.matchVolume = values.on("match-volume");
    if (call.options.matchVolume && rules.empty())
        call.warnings.push_back("--match-volume is for --resolution");
}

// What all verbs but info take.
void fillProcess(const Values& values, Call& call)
{
    call.force = values.on("force");
    call.quiet = values.on("quiet");
    call.verbose = values.on("verbose");
    call.progress = !values.on("no-progress") && !call.quiet;
    if (call.quiet && call.verbose) misuse("--quiet and --verbose together");
    values.get("threads", call.threads, 1, 4096);
}

// What all verbs that build a surface take.
void fillRun(const Values& values, Call& call)
{
    fillProcess(values, call);
    Options& options = call.options;
    values.get("select", options.atoms.select);
    values.get("model", options.atoms.model, 1, 1000000000);
    values.get("assembly", options.atoms.assembly);
    values.get("copies", options.atoms.copies);
    values.get("altloc", options.atoms.altloc);
    options.atoms.hydrogens = !values.on("no-hydrogens");
    options.atoms.hetero = !values.on("no-hetero");
    options.atoms.waters = values.on("waters");
    values.get("radii", options.atoms.radii);
    values.get("probe", options.probe);
    values.get("surface", options.kind, surfaceKinds);
    for (const std::string& text : values.list("surface-of"))
        options.surfaceOf.push_back(parseSurfaceOf(text));
    values.get("blobbiness", options.blobbiness);
    fillResolutions(values, call);
    for (const std::string& text : values.list("coarse")) {
        options.atoms.coarse.push_back(parseCoarse(text));
    }
    values.get("voxel", options.voxel);
    options.fillCavities = values.on("fill-cavities");
    options.fields = fieldsOf(values);
    options.curvatureIntegrals = values.on("curvature-totals");
    values.get("epsilon", options.epsilon);
    EvolveOptions& evolution = options.evolution;
    values.get("lambda", evolution.lambda);
    values.get("regularizer", evolution.regularizer, {Regularizer::Gradient, Regularizer::Area});
    values.get("flow", evolution.flow, {Flow::Preconditioned, Flow::Plain});
    values.get("max-steps", evolution.maxSteps, 0, 1000000);
    values.get("steps", evolution.steps, 0, 1000000);
    if (values.given("steps") && values.given("max-steps"))
        misuse("--steps and --max-steps together");
    values.get("tolerance", evolution.energyTolerance);
    // Near its minimum the energy is quadratic in the displacement.
    evolution.displacementTolerance = std::sqrt(evolution.energyTolerance);
    values.get("spline-level", options.splineLevel, 0, 2);

    const auto builds = [&](SurfaceKind kind) {
        return options.kind == kind ||
               std::any_of(options.surfaceOf.begin(), options.surfaceOf.end(),
                           [=](const auto& of) { return of.second == kind; });
    };
    if (!builds(SurfaceKind::Variational)) {
        for (const char* name : {"epsilon", "resolution", "match-volume", "lambda", "regularizer",
                                 "flow", "max-steps", "steps", "tolerance"}) {
            if (values.given(name))
                call.warnings.push_back(std::string("--") + name + " is for --surface variational");
        }
    }
    if (!builds(SurfaceKind::Gaussian) && values.given("blobbiness"))
        call.warnings.push_back("--blobbiness is for --surface gaussian");
    if (options.voxel > coarseVoxel)
        call.warnings.push_back("--voxel " + shortest(options.voxel) +
                                ": voxels this large cannot show the atoms");
    if (builds(SurfaceKind::Variational) && options.epsilon < 0.5 * options.voxel)
        call.warnings.push_back("--epsilon " + shortest(options.epsilon) +
                                ": a tolerance below half a voxel is not resolved");
}

void readConfig(const std::string& path, const po::options_description& all, po::variables_map& map)
{
    std::error_code ignored;
    errno = std::filesystem::is_directory(path, ignored) ? EISDIR : 0;
    std::ifstream file(path);
    if (errno == EISDIR || !file)
        throw Error(ErrorKind::Input, "cannot read " + path + ": " + std::strerror(errno));
    try {
        po::store(po::parse_config_file(file, all), map);
    } catch (const po::error& e) {
        misuse("--config " + path + ": " + e.what());
    }
}

// Build options that mean nothing unless a structure is read. --voxel is for meshes too.
std::vector<std::string> givenForStructures(const po::variables_map& map)
{
    std::vector<std::string> given;
    for (const Group& group : groups()) {
        const std::string title = group.title;
        if (title == "Output" || title == "Scene" || title == "Picture" || title == "Run" ||
            title == "Information")
            continue;
        for (const Entry& entry : group.entries) {
            const std::string name = longName(entry);
            if (name != "voxel" && map.count(name) && !map[name].defaulted())
                given.push_back("--" + name);
        }
    }
    return given;
}

void fillCompare(const Values& values, const po::variables_map& map, Call& call)
{
    call.files = values.list("input");
    if (call.files.size() != 2)
        misuse("compare: expected two surfaces, A and B, got " + std::to_string(call.files.size()) +
               " [hint: vdb_molsurf compare a.vdb b.ply -o difference.ply]");
    for (const std::string& file : call.files)
        if (file.empty()) misuse("compare: expected the name of a file, got an empty word");
    if (call.files[0] == "-" && call.files[1] == "-")
        misuse("compare: - - : standard input can be only one of the two");
    if (!values.list("output").empty())
        call.outputs = outputsOf(values);
    else if (map.count("format"))
        misuse("--format is for -o - only");
    for (const Output& output : call.outputs)
        if (output.format != Format::Ply && output.format != Format::Vdb &&
            output.format != Format::Json)
            misuse("-o " + output.path + ": compare writes .ply, .vdb or .json");
    if (map.count("fields")) misuse("--fields is not for compare");
    if (values.on("curvature-totals")) misuse("--curvature-totals is not for compare");
    std::string color = "distance";
    values.get("color", color);
    if (color != "distance" && color != "signed-distance")
        values.wrong("color", "distance or signed-distance");
    call.colorBySign = color == "signed-distance";
    values.get("range", call.colorRange);
    if (map.count("range") && !(call.colorRange > 0.0))
        values.wrong("range", "a positive number of Å");
    fillRun(values, call);
    call.given = givenForStructures(map);
}

void fillBatch(const Values& values, const po::parsed_options& parsed, Call& call)
{
    const std::vector<std::string> lists = values.list("input");
    if (lists.size() != 1 || lists[0].empty())
        misuse("batch: expected one list of structure files, got " + std::to_string(lists.size()) +
               " [hint: vdb_molsurf batch list.txt -O surfaces]");
    call.input = lists[0];
    values.get("folder", call.folder);
    if (call.folder.empty()) misuse("batch: nowhere to write to [hint: -O DIR]");
    std::string words = "vdb,ply,json";
    values.get("formats", words);
    std::set<std::string> seen;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        const auto found = formats.find(word);
        if (found == formats.end() || found->second == Format::Csv || !seen.insert(word).second)
            values.wrong("formats", "some of vdb, ply, obj, stl, off, glb, 3mf, html, json, png");
        call.outputs.push_back({"." + word, found->second, ""});
        begin = end + 1;
    }
    fillRun(values, call);
    std::vector<std::string>& fields = call.options.fields;
    fields.erase(std::remove(fields.begin(), fields.end(), "v"), fields.end());
    fillScene(values, call);
    fillGroups(values, call);
    fillPicture(values, call);

    std::string line;
    for (const auto& option : parsed.options) {
        const std::string& name = option.string_key;
        const auto isRun = [&](const Group& group) {
            const std::string title = group.title;
            return (title == "Run" || title == "Output") &&
                   std::any_of(group.entries.begin(), group.entries.end(),
                               [&](const Entry& e) { return longName(e) == name; });
        };
        const std::vector<Group> all = groupsOf(Verb::Batch);
        if (name == "input" ||
            (name != "config" && name != "formats" && std::any_of(all.begin(), all.end(), isRun)))
            continue;
        line += (line.empty() ? "--" : " --") + name;
        for (const std::string& value : option.value) line += " " + value;
    }
    call.given = {line};
}

// The words of a command line that say what surface is wanted.
std::vector<std::string> surfaceWords(const po::parsed_options& parsed)
{
    std::vector<std::string> words;
    for (const auto& option : parsed.options) {
        const std::string& name = option.string_key;
        const auto has = [&](const Group& group) {
            const std::string title = group.title;
            return title != "Output" && title != "Bricks" && title != "Run" &&
                   std::any_of(group.entries.begin(), group.entries.end(),
                               [&](const Entry& e) { return longName(e) == name; });
        };
        const std::vector<Group> all = groupsOf(Verb::Plan);
        if (name != "config" && std::none_of(all.begin(), all.end(), has)) continue;
        if (option.value.empty()) words.push_back("--" + name);
        for (const std::string& value : option.value) words.push_back("--" + name + "=" + value);
    }
    return words;
}

// Files that options were read from.
std::vector<std::string> filesRead(const Values& values, const Call& call)
{
    std::vector<std::string> files;
    for (const char* name : {"config", "groups"}) {
        std::string file;
        values.get(name, file);
        if (!file.empty()) files.push_back(file);
    }
    std::error_code ignored;
    if (std::filesystem::is_regular_file(call.options.atoms.radii, ignored))
        files.push_back(call.options.atoms.radii);
    return files;
}

void fillPlan(const Values& values, const po::parsed_options& parsed, Call& call)
{
    const std::vector<std::string> inputs = values.list("input");
    if (inputs.size() != 1 || inputs[0].empty() || inputs[0] == "-")
        misuse("plan: expected one structure file, got " + std::to_string(inputs.size()) +
               " [hint: vdb_molsurf plan molecule.cif -o plan.json --bricks 8]");
    call.input = inputs[0];
    std::string path;
    values.get("output", path);
    if (path.empty()) misuse("plan: nothing to write [hint: -o plan.json]");
    if (path == "-" || formatOf(path) != Format::Json)
        misuse("-o " + path + ": expected a name that ends in .json");
    call.outputs = {{path, Format::Json, "", 0.0}};
    int bricks = 0;
    values.get("bricks", bricks, 1, 1000000);
    call.bricks = std::size_t(bricks);
    call.memory = memoryOf(values);
    if ((bricks > 0) == (call.memory > 0))
        misuse("plan: expected either --bricks N or --memory SIZE");
    fillRun(values, call);
    fillGroups(values, call);
    call.given = surfaceWords(parsed);
    call.read = filesRead(values, call);
}

void fillBrick(const Values& values, Call& call)
{
    const std::vector<std::string> words = values.list("input");
    if (words.size() != 2)
        misuse("brick: expected a plan and the number of a brick [hint: vdb_molsurf brick "
               "plan.json 1]");
    call.input = words[0];
    const char *begin = words[1].data(), *end = begin + words[1].size();
    const auto [stop, problem] = std::from_chars(begin, end, call.bricks);
    if (problem != std::errc() || stop != end || call.bricks == 0)
        misuse("brick: expected a number from 1 on, got '" + words[1] + "'");
    fillProcess(values, call);
}

void fillMerge(const Values& values, Call& call)
{
    const std::vector<std::string> words = values.list("input");
    if (words.size() != 1 || words[0].empty())
        misuse("merge: expected one plan [hint: vdb_molsurf merge plan.json -o surface.vdb]");
    call.input = words[0];
    call.outputs = outputsOf(values);
    for (const Output& output : call.outputs)
        if (output.format != Format::Vdb && output.format != Format::Ply &&
            output.format != Format::Json)
            misuse("-o " + output.path + ": merge writes .vdb, .ply or .json");
    fillProcess(values, call);
}

// mesh and color.
void fillStored(const Values& values, Call& call)
{
    const bool recolor = call.verb == Verb::Color;
    const std::string verb = recolor ? "color" : "mesh";
    const std::vector<std::string> inputs = values.list("input");
    if (inputs.size() != 1 || inputs[0].empty())
        misuse(verb + ": expected one .vdb file, got " + std::to_string(inputs.size()) +
               " [hint: vdb_molsurf " + verb + " surface.vdb -o surface.ply]");
    call.input = inputs[0];
    call.outputs = outputsOf(values);
    if (writes(call, {Format::Csv})) misuse("-o .csv is for --frames");
    if (!recolor && writes(call, {Format::Vdb}))
        misuse("mesh: it does not write .vdb [hint: vdb_molsurf color]");
    fillProcess(values, call);
    values.get("color", call.options.color,
               {ColorBy::Nothing, ColorBy::Chain, ColorBy::Group, ColorBy::Element,
                ColorBy::Residue, ColorBy::MeanCurvature, ColorBy::GaussianCurvature});
    if (recolor && call.options.color == ColorBy::Nothing) misuse("color: expected --color WORD");
    call.options.fields = fieldsOf(values);
    values.get("print-scale", call.printScale);
    if (values.given("print-scale") && !(call.printScale >= 1e-6 && call.printScale <= 1e6))
        values.wrong("print-scale", "mm per Å, from 1e-6 to 1e6");
    fillPicture(values, call);
}

Call parseBuild(int argc, const char* const* argv, Verb verb)
{
    const po::options_description all = describeOptions(verb);
    po::positional_options_description positional;
    positional.add("input", -1);
    // Without guessing: --vox must not come to mean something else when an option is added.
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;

    po::variables_map map;
    const auto parsed =
        po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run();
    po::store(parsed, map);
    std::vector<std::string> order; // one a value
    for (const auto& option : parsed.options) {
        order.insert(order.end(), std::max<std::size_t>(option.value.size(), 1), option.string_key);
    }
    const Values values(map, std::move(order));
    Call call;
    call.verb = verb;
    if (values.on("help"))
        call.verb = verb == Verb::Compare ? Verb::CompareHelp
                    : verb == Verb::Mesh  ? Verb::MeshHelp
                    : verb == Verb::Color ? Verb::ColorHelp
                    : verb == Verb::Batch ? Verb::BatchHelp
                    : verb == Verb::Plan  ? Verb::PlanHelp
                    : verb == Verb::Brick ? Verb::BrickHelp
                    : verb == Verb::Merge ? Verb::MergeHelp
                                          : Verb::Help;
    else if (values.on("version"))
        call.verb = Verb::Version;
    else if (values.on("list-radii"))
        call.verb = Verb::ListRadii;
    if (call.verb != verb) return call;

    std::string config;
    values.get("config", config);
    if (!config.empty()) readConfig(config, all, map);
    if (verb == Verb::Compare)
        fillCompare(values, map, call);
    else if (verb == Verb::Batch)
        fillBatch(values, parsed, call);
    else if (verb == Verb::Plan)
        fillPlan(values, parsed, call);
    else if (verb == Verb::Brick)
        fillBrick(values, call);
    else if (verb == Verb::Merge)
        fillMerge(values, call);
    else if (verb == Verb::Mesh || verb == Verb::Color)
        fillStored(values, call);
    else
        fillBuild(values, call);
    return call;
}

Call parseInfo(int argc, const char* const* argv)
{
    Call call;
    call.verb = Verb::Info;
    bool onlyFiles = false;
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        if (!onlyFiles && (word == "--help" || word == "-h")) {
            call.verb = Verb::InfoHelp;
            return call;
        }
        if (!onlyFiles && word == "--")
            onlyFiles = true;
        else if (!onlyFiles && word.size() > 1 && word[0] == '-')
            misuse("info: unknown option '" + word + "'");
        else
            call.files.push_back(word);
    }
    if (call.files.empty()) misuse("info: expected a FILE");
    return call;
}

std::string quoted(const std::string& word)
{
    const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=:,@%+-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string all = "'";
    for (char letter : word) all += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return all + "'";
}

} // namespace

const char* nameOf(Regularizer regularizer)
{
    return regularizer == Regularizer::Gradient ? "gradient" : "area";
}

const char* nameOf(Flow flow)
{
    return flow == Flow::Preconditioned ? "preconditioned" : "plain";
}

Call parseCall(int argc, const char* const* argv)
{
    std::string command;
    for (int i = 0; i < argc; ++i) command += (i ? " " : "") + quoted(argv[i]);
    try {
        const std::string first = argc > 1 ? argv[1] : "";
        if (argc == 2 && (first == "--man" || first == "--bash-completion")) {
            Call call;
            call.verb = first == "--man" ? Verb::Man : Verb::Completion;
            return call;
        }
        Call call = first == "info"      ? parseInfo(argc, argv)
                    : first == "batch"   ? parseBuild(argc - 1, argv + 1, Verb::Batch)
                    : first == "compare" ? parseBuild(argc - 1, argv + 1, Verb::Compare)
                    : first == "plan"    ? parseBuild(argc - 1, argv + 1, Verb::Plan)
                    : first == "brick"   ? parseBuild(argc - 1, argv + 1, Verb::Brick)
                    : first == "merge"   ? parseBuild(argc - 1, argv + 1, Verb::Merge)
                    : first == "mesh"    ? parseBuild(argc - 1, argv + 1, Verb::Mesh)
                    : first == "color"   ? parseBuild(argc - 1, argv + 1, Verb::Color)
                                         : parseBuild(argc, argv, Verb::Build);
        call.command = command;
        return call;
    } catch (const po::unknown_option& e) {
        misuse("unknown option '" + e.get_option_name() + "' [hint: vdb_molsurf --help]");
    } catch (const po::error& e) {
        misuse(std::string(e.what()) + " [hint: vdb_molsurf --help]");
    }
}

} // namespace molsurf::tool
