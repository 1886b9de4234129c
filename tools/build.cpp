// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "outputs.h"
#include "sha256.h"
#include "sidecar.h"
#include "stop.h"
#include "terminal.h"

#include "molsurf/core/error.h"
#include "molsurf/io/draw_legend.h"
#include "molsurf/io/output_file.h"
#include "molsurf/io/write_glb.h"
#include "molsurf/io/write_html.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_png.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_usda.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/pipeline/legends.h"
#include "molsurf/pipeline/run.h"
#include "molsurf/pipeline/size_beads.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/structure/read_structure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace molsurf::tool
{

namespace
{

std::string shortest(double number)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

// Everything that is needed to make the file again.
openvdb::MetaMap vdbMetadata(const Call& call, const Report& report)
{
    openvdb::MetaMap map;
    const auto text = [&](const char* name, const std::string& value) {
        map.insertMeta(name, openvdb::StringMetadata(value));
    };
    const auto number = [&](const char* name, double value) {
        map.insertMeta(name, openvdb::DoubleMetadata(value));
    };
    const auto count = [&](const char* name, std::int64_t value) {
        map.insertMeta(name, openvdb::Int64Metadata(value));
    };
    const auto yesNo = [&](const char* name, bool value) {
        map.insertMeta(name, openvdb::BoolMetadata(value));
    };
    text("program", report.program);
    text("version", report.version);
    text("command", report.command);
    text("input", report.input);
    if (call.input != "-") text("input_sha256", sha256OfFile(call.input));
    count("atoms", std::int64_t(report.atoms));
    number("area", report.surface.area);
    number("volume", report.surface.volume);

    const Options& options = call.options;
    text("option.select", options.atoms.select.empty() ? "all" : options.atoms.select);
    text("option.model", options.atoms.model ? std::to_string(options.atoms.model) : "first");
    text("option.assembly", options.atoms.assembly);
    text("option.copies", options.atoms.copies.empty() ? "all" : options.atoms.copies);
    text("option.altloc",
         options.atoms.altloc.empty() ? "highest occupancy" : options.atoms.altloc);
    yesNo("option.no-hydrogens", !options.atoms.hydrogens);
    yesNo("option.no-hetero", !options.atoms.hetero);
    yesNo("option.waters", options.atoms.waters);
    text("option.radii", options.atoms.radii);
    number("option.probe", options.probe);
    text("option.surface", nameOf(options.kind));
    number("option.blobbiness", options.blobbiness);
    number("option.voxel", options.voxel);
    yesNo("option.fill-cavities", options.fillCavities);
    std::string coarse;
    for (const CoarseRule& rule : options.atoms.coarse)
        coarse += (coarse.empty() ? "" : ", ") + nameOf(rule);
    text("option.coarse", coarse.empty() ? "atom" : coarse);
    std::string resolutions;
    for (const ResolutionRule& rule : options.atoms.resolutions) {
        resolutions += (resolutions.empty() ? "" : ", ") +
                       (rule.select.empty() ? "" : rule.select + "=") + shortest(rule.resolution);
    }
    text("option.resolution", resolutions);
    yesNo("option.match-volume", options.matchVolume);
    std::string groups;
    for (const GroupRule& group : options.atoms.groups)
        groups += (groups.empty() ? "" : ", ") + group.name + " " + group.select;
    text("option.groups", groups);
    text("option.group-by", options.atoms.groupBy);
    text("option.color", nameOf(options.color));
    text("option.split", options.split ? "group" : "none");
    std::string surfaceOf;
    for (const auto& [name, kind] : options.surfaceOf)
        surfaceOf += (surfaceOf.empty() ? "" : ",") + name + "=" + nameOf(kind);
    text("option.surface-of", surfaceOf);
    std::string fields = "surface";
    for (const std::string& field : options.fields) fields += "," + field;
    text("option.fields", fields);
    text("option.for", nameOf(call.scene.host));
    yesNo("option.center", call.center);
    number("option.min-wall", options.minWall);
    const char* axes[] = {"scene.center_x", "scene.center_y", "scene.center_z"};
    for (int i = 0; i < 3; ++i) number(axes[i], call.scene.center[i]);
    number("scene.units_per_angstrom", call.scene.scale);
    number("scene.shift_in_voxels", call.scene.host == Host::Blender ? -0.5 : 0.0);
    yesNo("option.curvature-totals", options.curvatureIntegrals);
    number("option.epsilon", options.epsilon);
    number("option.lambda", options.evolution.lambda);
    text("option.regularizer", nameOf(options.evolution.regularizer));
    text("option.flow", nameOf(options.evolution.flow));
    const int steps = options.evolution.maxSteps;
    text("option.max-steps", steps >= 0 ? std::to_string(steps) : "default of the flow");
    number("option.tolerance", options.evolution.energyTolerance);
    count("option.spline-level", options.splineLevel);
    return map;
}

openvdb::GridCPtrVec gridsOf(const Call& call, const Result& result)
{
    openvdb::GridCPtrVec grids;
    if (result.surface) grids.push_back(result.surface);
    grids.insert(grids.end(), result.fields.begin(), result.fields.end());
    const Scene& scene = call.scene;
    return scene.known() || call.center ? placeInScene(grids, scene) : grids;
}

LengthUnit printUnit(const Call& call)
{
    return call.printScale > 0.0 ? LengthUnit{call.printScale, "mm"} : LengthUnit{};
}

// The name of the input without folder, .gz and extension.
std::string titleOf(const std::string& input)
{
    if (input == "-") return "standard input";
    std::filesystem::path name = std::filesystem::path(input).filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string();
}

std::string stemOf(const std::string& path)
{
    return path == "-" ? "surface" : std::filesystem::path(path).stem().string();
}

// What the colours can mean; the first one is what they do mean, if they were asked for.
std::vector<Legend> legendsOf(const Call& call, const BallSelection& atoms, const Mesh& mesh,
                              const Progress& progress)
{
    std::vector<ColorBy> kinds = {ColorBy::Chain, ColorBy::Group, ColorBy::MeanCurvature,
                                  ColorBy::GaussianCurvature};
    const ColorBy asked = call.options.color;
    const auto found = std::find(kinds.begin(), kinds.end(), asked);
    if (found != kinds.end()) kinds.erase(found);
    if (asked != ColorBy::Nothing) kinds.insert(kinds.begin(), asked);
    std::vector<Legend> legends;
    for (const ColorBy kind : kinds)
        if (auto legend = legendOf(kind, atoms, mesh, progress))
            legends.push_back(std::move(*legend));
    return legends;
}

void writePicture(const Call& call, const BallSelection& atoms, const Mesh& mesh, double turn,
                  const Progress& progress, OutputFile& file)
{
    DrawOptions options = call.picture;
    options.turn += turn;
    const auto legend =
        call.legend ? legendOf(call.options.color, atoms, mesh, progress) : std::optional<Legend>();
    if (!legend) {
        writePng(drawMesh(mesh, options, progress), file);
        return;
    }
    const int width = options.width;
    options.width = std::max(width - legendWidth(*legend, width), width / 2);
    writePng(withLegend(drawMesh(mesh, options, progress), *legend, width, options.background),
             file);
}

void writeOne(const Call& call, const BallSelection& atoms, const Result& result,
              const Output& output, const Progress& progress, OutputFile& file)
{
    switch (output.format) {
    case Format::Vdb:
        writeVdb(gridsOf(call, result), vdbMetadata(call, result.report), file);
        break;
    case Format::Usda:
        writeUsda(gridsOf(call, result), usdVolume(call, output), file);
        break;
    case Format::Ply:
        writePly(result.mesh, file);
        break;
    case Format::Obj:
        writeObj(result.mesh, file, printUnit(call));
        break;
    case Format::Stl:
        writeStl(result.mesh, file, printUnit(call));
        break;
    case Format::Off:
        writeOff(result.mesh, file);
        break;
    case Format::Glb:
        writeGlb(result.mesh, {stemOf(output.path), call.scene.scale, call.picture.plain}, file);
        break;
    case Format::Png:
        writePicture(call, atoms, result.mesh, output.turn, progress, file);
        break;
    case Format::Html:
        writeHtml(result.mesh,
                  {titleOf(call.input), legendsOf(call, atoms, result.mesh, progress),
                   call.picture.plain, viewAxes(result.mesh, call.picture)},
                  file);
        break;
    case Format::Json:
        writeReport(result.report, file);
        break;
    }
}

void writeAll(const Call& call, const BallSelection& atoms, Result& result, Terminal& terminal,
              Clock::time_point programStart)
{
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            writeOne(call, atoms, result, output, terminal, file);
        },
        [&](double writeSeconds) {
            auto& seconds = result.report.seconds;
            seconds.emplace_back("write", writeSeconds);
            seconds.emplace_back("total", secondsSince(programStart));
            result.report.peakMemoryBytes = peakMemory();
        });
}

void completeReport(const Call& call, std::size_t atoms, double readSeconds,
                    const std::vector<std::string>& warnings, Report& report)
{
    report.version = MOLSURF_VERSION;
    report.command = call.command;
    report.input = call.input;
    report.atoms = atoms;
    report.voxel = call.options.voxel;
    report.threads =
        int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    report.warnings.insert(report.warnings.begin(), warnings.begin(), warnings.end());
    auto& seconds = report.seconds;
    seconds.erase(std::remove_if(seconds.begin(), seconds.end(),
                                 [](const auto& stage) {
                                     return stage.first == "read" || stage.first == "write" ||
                                            stage.first == "total";
                                 }),
                  seconds.end());
    seconds.insert(seconds.begin(), {"read", readSeconds});
}

std::string summary(const Report& report)
{
    char text[128];
    const SurfaceReport& surface = report.surface;
    std::snprintf(text, sizeof text, "area %.1f Å^2, volume %.1f Å^3, ", surface.area,
                  surface.volume);
    std::string line = text;
    line += counted(std::size_t(surface.components), "component", "components") + ", ";
    line += counted(surface.cavities.size(), "cavity", "cavities") + ", ";
    line += counted(surface.triangles, "triangle", "triangles");
    std::snprintf(text, sizeof text, ", %.2f s", report.seconds.back().second);
    return line + text;
}

void sayTimes(const Report& report)
{
    for (const auto& [stage, time] : report.seconds) {
        char text[64];
        std::snprintf(text, sizeof text, "%-10s %9.3f s", stage.c_str(), time);
        say(text);
    }
    char text[96];
    std::snprintf(text, sizeof text, "%d threads, %.1f MB at most, %zu active voxels",
                  report.threads, double(report.peakMemoryBytes) / 1e6, report.activeVoxels);
    say(text);
}

// The middle of the mesh's box comes to the origin; the grids follow when they are written.
void centerMesh(Call& call, Result& result)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3f& p : result.mesh.positions) box.expand(openvdb::Vec3d(p));
    const openvdb::Vec3d center = box.getCenter();
    for (openvdb::Vec3f& p : result.mesh.positions) p = openvdb::Vec3f(openvdb::Vec3d(p) - center);
    call.scene.center = center;
    result.report.center = {center[0], center[1], center[2]};
}

} // namespace

Report buildSurface(const Call& asked, Clock::time_point start)
{
    Call call = asked;
    checkOptions(call.options);
    prepareOutputs(call);
    openvdb::initialize();
    std::optional<tbb::global_control> limit;
    if (call.threads)
        limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(call.threads));

    Terminal terminal(call.progress);
    std::vector<std::string> warnings = call.warnings;
    const Clock::time_point readStart = Clock::now();
    terminal.update("read", 0.0);
    BallSelection selection;
    std::string description;
    {
        const Structure structure = readStructure(call.input);
        stopIfAsked();
        selection = selectBalls(structure, call.options.atoms, beadSizer(call.options, terminal));
        description = describeSelection(structure, selection);
    }
    const double readSeconds = secondsSince(readStart);
    warnings.insert(warnings.end(), selection.warnings.begin(), selection.warnings.end());
    terminal.erase();
    if (!call.quiet) {
        say(description);
        for (const std::string& warning : warnings) say("warning: " + warning);
    }

    stopIfAsked();
    Result result = run(selection, call.options, terminal);
    terminal.erase();
    if (!call.quiet)
        for (const std::string& warning : result.report.warnings) say("warning: " + warning);
    completeReport(call, selection.balls.size(), readSeconds, warnings, result.report);
    const std::string creator = "vdb_molsurf " MOLSURF_VERSION;
    if (result.surface) result.surface->setCreator(creator);
    for (const auto& field : result.fields) field->setCreator(creator);

    if (call.center) centerMesh(call, result);
    writeAll(call, selection, result, terminal, start);
    terminal.erase();
    if (call.verbose) sayTimes(result.report);
    if (!call.quiet) say(summary(result.report));
    return result.report;
}

int build(const Call& call, Clock::time_point start)
{
    const Report report = buildSurface(call, start);
    const auto& evolution = report.evolution;
    if (evolution && !evolution->converged) {
        say("not converged after " + counted(std::size_t(evolution->steps), "step", "steps") +
            "; the files are written [hint: --max-steps or --tolerance]");
        return notConvergedStatus;
    }
    return 0;
}

} // namespace molsurf::tool
