// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "bricks.h"
#include "input_files.h"
#include "outputs.h"
#include "terminal.h"
#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/surface/stored_surface.h"

namespace molsurf::tool
{

namespace
{

StoredSurface restore(const CommandLine& call, const VdbFile& file, Terminal& terminal)
{
    try {
        return storedSurface(file.grids, file.metadata, call.options, call.atoms.coloring,
                             terminal);
    } catch (const Cancelled&) {
        terminal.failIfOverdue(" [hint: a surface of a larger --voxel, or a larger --max-hours]");
        throw;
    } catch (const Error& e) {
        throw Error(e, call.input + ": " + e.what());
    }
}

// The file's grids with the new colours in the place of the old ones, or at the end.
void writeRecolored(const CommandLine& call, const VdbFile& file, const StoredSurface& surface,
                    OutputFile& out)
{
    openvdb::GridCPtrVec grids;
    const openvdb::GridBase::Ptr colors = surface.result.fields.at(0);
    bool placed = false;
    for (const auto& grid : file.grids) {
        const bool old = grid->getName() == "Cd";
        if (!old || !placed) grids.push_back(old ? colors : grid);
        placed = placed || old;
    }
    if (!placed) grids.push_back(colors);
    openvdb::MetaMap metadata = file.metadata;
    for (const char* name : {"option.color", "command"}) metadata.removeMeta(name);
    metadata.insertMeta("option.color", openvdb::StringMetadata(nameOf(call.options.color)));
    metadata.insertMeta("command", openvdb::StringMetadata(call.command));
    writeVdb(grids, metadata, out);
}

} // namespace

int convert(const CommandLine& asked, Clock::time_point start)
{
    prepareOutputs(asked);
    Terminal terminal(asked.progress);
    Clock::time_point lapStart = Clock::now();
    terminal.update("read", 0.0);
    failIfNoFile(asked.input);
    failIfStream(asked.input, "a .vdb file");
    if (!isVdbFile(asked.input))
        throw Error(ErrorKind::Input, asked.input + ": is no .vdb file [hint: vdb_molsurf " +
                                          asked.input + " -o FILE makes a surface of a structure]");
    PlannedBrick cost;
    const VdbFile file = readVdb(asked.input, [&](const VdbContent& content) {
        cost = costOfStored(content);
        if (asked.writes(Pixels)) {
            const PlannedBrick drawing =
                costOfPicture(cost.voxels, asked.picture.width, seesBehind(asked));
            cost.bytes += drawing.bytes;
            cost.seconds += drawing.seconds;
        }
        if (!asked.dryRun) checkCost(cost, limitsOf(asked));
        return !asked.dryRun;
    });
    if (asked.dryRun) {
        terminal.erase();
        printLine(costText(cost));
        return 0;
    }
    terminal.limitTo(cost.seconds, asked.hours);
    const double readSeconds = secondsSince(lapStart);
    stopIfAsked();

    lapStart = Clock::now();
    StoredSurface surface = restore(asked, file, terminal);
    terminal.erase();
    CommandLine call = asked;
    call.options.color = surface.options.color;
    call.scene.scale = surface.scale;
    Report& report = surface.result.report;
    beginReport(call, report);
    report.warnings = call.warnings;
    report.warnings.insert(report.warnings.end(), surface.warnings.begin(), surface.warnings.end());
    for (std::string& warning : report.warnings) warning = withOptionNames(warning);
    report.seconds = {{"read", readSeconds}, {"mesh", secondsSince(lapStart)}};
    if (!call.quiet)
        for (const std::string& warning : report.warnings) printLine("warning: " + warning);

    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& out) {
            if (output.holds(Grids))
                writeRecolored(call, file, surface, out);
            else
                writeOutput(call, surface.names, surface.result, output, terminal, out);
        },
        [&](double seconds) { endReport(seconds, start, report); });
    terminal.erase();
    if (call.verbose) sayTimes(report);
    if (!call.quiet) {
        printLine(formatted("area %.1f Å^2, volume %.1f Å^3, %zu triangles, %.2f s",
                            report.surface.area, report.surface.volume, report.surface.triangles,
                            report.seconds.back().second));
    }
    return 0;
}

} // namespace molsurf::tool
