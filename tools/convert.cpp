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
#include "molsurf/show/io/map_grids.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/write_nvdb.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/surface/stored_surface.h"

#include <algorithm>

namespace molsurf::tool
{

namespace
{

StoredSurface restore(const CommandLine& call, const VdbFile& file, Terminal& terminal)
{
    try {
        return storedSurface(file.grids, file.metadata, call.options, call.labels.coloring,
                             terminal);
    } catch (const Cancelled&) {
        terminal.failIfOverdue(" [hint: a surface of a larger --voxel, or a larger --max-hours]");
        throw;
    } catch (const Error& e) {
        throw Error(e, call.input + ": " + e.what());
    }
}

// The file's grids; those of new colours in the place of the old ones, or at the end.
openvdb::GridCPtrVec recolored(const CommandLine& call, const VdbFile& file,
                               const StoredSurface& surface)
{
    openvdb::GridCPtrVec grids(file.grids.begin(), file.grids.end());
    if (!call.has("color")) return grids;
    grids.clear();
    const openvdb::GridBase::Ptr colors = surface.result.fields.at(0);
    bool placed = false;
    for (const auto& grid : file.grids) {
        const bool old = grid->getName() == "Cd";
        if (!old || !placed) grids.push_back(old ? colors : grid);
        placed = placed || old;
    }
    if (!placed) grids.push_back(colors);
    return grids;
}

void writeRecolored(const CommandLine& call, const VdbFile& file, const StoredSurface& surface,
                    OutputFile& out)
{
    openvdb::MetaMap metadata = file.metadata;
    for (const char* name : {"option.color", "command"}) metadata.removeMeta(name);
    metadata.insertMeta("option.color", openvdb::StringMetadata(nameOf(call.options.color)));
    metadata.insertMeta("command", openvdb::StringMetadata(call.command));
    writeVdb(recolored(call, file, surface), metadata, out);
}

/// Makes a volume of a map of so many points.
int convertMap(const CommandLine& call, std::size_t points, Terminal& terminal)
{
    for (const Output& output : call.outputs)
        if (!output.holds(anyGrids))
            throw Error(ErrorKind::Usage,
                        "-o " + output.path +
                            ": a map becomes .vdb or .nvdb [hint: --iso V -o FILE.vdb, of which "
                            "convert makes the others]");
    // measured: convert of an .mrc of 4AT1 of 1.77e7 points: 0.33 s and 167 MB, with --iso 2.5 s
    // and 204 MB
    PlannedBrick cost;
    cost.voxels = points;
    cost.bytes = std::size_t(25e6 + (call.iso ? 10.5 : 8.5) * double(points));
    cost.seconds = (call.iso ? 1.4e-7 : 2e-8) * double(points);
    if (call.dryRun) {
        terminal.erase();
        printLine(costText(cost));
        return 0;
    }
    checkCost(cost, limitsOf(call));
    const ScalarMap map = readMap(call.input, call.atoms.limits.maxInput);
    stopIfAsked();
    const openvdb::FloatGrid::Ptr grid = call.iso ? levelSetOf(map, *call.iso) : fogOf(map);
    openvdb::MetaMap metadata;
    for (const auto& [name, text] : {std::pair("program", std::string("vdb_molsurf")),
                                     {"version", MOLSURF_VERSION},
                                     {"command", call.command},
                                     {"input", call.input}})
        metadata.insertMeta(name, openvdb::StringMetadata(text));
    const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
    metadata.insertMeta("map.least", openvdb::DoubleMetadata(*low));
    metadata.insertMeta("map.most", openvdb::DoubleMetadata(*high));
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& out) {
            output.holds(Grids) ? writeVdb({grid}, metadata, out) : writeNvdb({grid}, out);
        },
        [](double) {});
    terminal.erase();
    if (!call.quiet)
        printLine(formatted("map of %zu x %zu x %zu points, from %s to %s", map.counts[0],
                            map.counts[1], map.counts[2], shortest(*low).c_str(),
                            shortest(*high).c_str()));
    return 0;
}

/// @throws Error if a call that names no map names no .vdb either
void checkStored(const CommandLine& asked)
{
    if (!isVdbFile(asked.input))
        throw Error(ErrorKind::Input, asked.input +
                                          ": is neither a .vdb file nor a map [hint: vdb_molsurf " +
                                          asked.input + " -o FILE makes a surface of a structure]");
    if (asked.iso)
        throw Error(ErrorKind::Usage,
                    "--iso: expected a map, .mrc, .map or .dx, got " + asked.input);
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
    if (const std::size_t points = pointsOfMap(asked.input); points > 0)
        return convertMap(asked, points, terminal);
    checkStored(asked);
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
            else if (output.holds(BareGrids))
                writeNvdb(recolored(call, file, surface), out);
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
