// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "bricks.h"
#include "outputs.h"
#include "sha256.h"
#include "stop.h"
#include "terminal.h"

#include "molsurf/core/error.h"
#include "molsurf/io/output_file.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_png.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/pipeline/run.h"
#include "molsurf/pipeline/size_beads.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/structure/read_structure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
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

} // namespace

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
    yesNo("option.curvature-totals", options.curvatureIntegrals);
    number("option.epsilon", options.epsilon);
    number("option.lambda", options.evolution.lambda);
    text("option.regularizer", nameOf(options.evolution.regularizer));
    text("option.flow", nameOf(options.evolution.flow));
    const int steps = options.evolution.maxSteps;
    text("option.steps", options.evolution.steps >= 0 ? std::to_string(options.evolution.steps)
                                                      : "by the stopping rule");
    text("option.max-steps", steps >= 0 ? std::to_string(steps) : "default of the flow");
    number("option.tolerance", options.evolution.energyTolerance);
    count("option.spline-level", options.splineLevel);
    return map;
}

namespace
{

void writeOne(const Call& call, const Result& result, Format format, const Progress& progress,
              OutputFile& file)
{
    switch (format) {
    case Format::Vdb: {
        openvdb::GridCPtrVec grids;
        if (result.surface) grids.push_back(result.surface);
        grids.insert(grids.end(), result.fields.begin(), result.fields.end());
        writeVdb(grids, vdbMetadata(call, result.report), file);
        break;
    }
    case Format::Ply:
        writePly(result.mesh, file);
        break;
    case Format::Obj:
        writeObj(result.mesh, file);
        break;
    case Format::Stl:
        writeStl(result.mesh, file);
        break;
    case Format::Png:
        writePng(drawMesh(result.mesh, call.picture, progress), file);
        break;
    case Format::Json:
        writeReport(result.report, file);
        break;
    }
}

void writeAll(const Call& call, Result& result, Terminal& terminal, Clock::time_point programStart)
{
    writeOutputs(
        call, terminal,
        [&](Format format, OutputFile& file) { writeOne(call, result, format, terminal, file); },
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

} // namespace

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

namespace
{

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

} // namespace

Report buildSurface(const Call& call, Clock::time_point start)
{
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

    writeAll(call, result, terminal, start);
    terminal.erase();
    if (call.verbose) sayTimes(result.report);
    if (!call.quiet) say(summary(result.report));
    return result.report;
}

int build(const Call& call, Clock::time_point start)
{
    if (call.memory > 0 || call.dryRun) return buildInBricks(call, start);
    return endOf(buildSurface(call, start));
}

int endOf(const Report& report)
{
    const auto& evolution = report.evolution;
    if (evolution && !evolution->converged) {
        say("not converged after " + counted(std::size_t(evolution->steps), "step", "steps") +
            "; the files are written [hint: --max-steps (with bricks --steps) or --tolerance]");
        return notConvergedStatus;
    }
    return 0;
}

} // namespace molsurf::tool
