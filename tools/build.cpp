// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "bricks.h"
#include "outputs.h"
#include "stop.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/core/error.h"
#include "molsurf/io/output_file.h"
#include "molsurf/pipeline/run.h"
#include "molsurf/pipeline/size_beads.h"
#include "molsurf/selection/select_balls.h"
#include "molsurf/structure/read_structure.h"

#include <tbb/global_control.h>

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace molsurf::tool
{

namespace
{

void writeAll(const Call& call, const BallSelection& atoms, Result& result, Terminal& terminal,
              Clock::time_point programStart)
{
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            writeOutput(call, atoms, result, output, terminal, file);
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

// The middle of the mesh's box comes to the origin; the grids follow when they are written.
void centerMesh(Call& call, Result& result)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3f& p : result.mesh.positions) box.expand(openvdb::Vec3d(p));
    const openvdb::Vec3d center = call.frame > 0 ? call.scene.center : box.getCenter();
    for (openvdb::Vec3f& p : result.mesh.positions) p = openvdb::Vec3f(openvdb::Vec3d(p) - center);
    call.scene.center = center;
    result.report.center = {center[0], center[1], center[2]};
}

} // namespace

Report surfaceOf(Call call, const Atoms& atoms, Terminal& terminal, Clock::time_point start,
                 WarmStart* warm, const std::function<void(Result&)>& extend)
{
    stopIfAsked();
    const BallSelection& selection = atoms.selection;
    Result result = run(selection, call.options, terminal, warm);
    terminal.erase();
    if (!call.quiet)
        for (const std::string& warning : result.report.warnings) say("warning: " + warning);
    completeReport(call, selection.balls.size(), atoms.readSeconds, atoms.warnings, result.report);
    if (extend) extend(result);
    const std::string creator = "vdb_molsurf " MOLSURF_VERSION;
    if (result.surface) result.surface->setCreator(creator);
    for (const auto& field : result.fields) field->setCreator(creator);

    if (call.center) centerMesh(call, result);
    writeAll(call, selection, result, terminal, start);
    terminal.erase();
    return result.report;
}

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
    malloc_trim(0); // what the parser has left is in pieces too small for the fields
    const double readSeconds = secondsSince(readStart);
    warnings.insert(warnings.end(), selection.warnings.begin(), selection.warnings.end());
    terminal.erase();
    if (!call.quiet) {
        say(description);
        for (const std::string& warning : warnings) say("warning: " + warning);
    }

    const Report report = surfaceOf(call, {selection, readSeconds, warnings}, terminal, start);
    if (call.verbose) sayTimes(report);
    if (!call.quiet) say(summary(report));
    return report;
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
