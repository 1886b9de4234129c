// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "input_files.h"
#include "outputs.h"
#include "stop.h"
#include "verbs.h"
#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/scale/bricks/merged_bricks.h"
#include "molsurf/scale/bricks/plan_file.h"
#include "molsurf/show/io/write_report.h"

#include <utility>

namespace molsurf::tool
{

void mergeBricks(const CommandLine& call, const BrickPlan& plan,
                 const std::vector<std::string>& paths, const std::string& id, bool meshed,
                 Terminal& terminal, Clock::time_point start, Report& report)
{
    terminal.update("merge", 0.0);
    const MergedBricks merged(paths, id, plan, call.options, meshed);
    const Report read = std::exchange(report, merged.report());
    addReading(read, report);
    beginReport(call, report);
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            if (output.holds(Grids)) {
                merged.writeVdb(vdbMetadata(call, report), file, terminal);
            } else if (output.holds(Triangles)) {
                merged.writePly(file, terminal);
            } else {
                writeReport(report, file);
            }
        },
        [&](double writeSeconds) { endReport(writeSeconds, start, report); }, false);
    terminal.erase();
}

int merge(const CommandLine& call, Clock::time_point start)
{
    failIfStream(call.input, "the file of a plan");
    const PlanManifest manifest = readManifest(call.input);
    CommandLine build = callOf(manifest, call.input, PlanFiles::Hashes);
    build.outputs = call.outputs;
    build.force = call.force;
    build.quiet = call.quiet;
    build.command = call.command;
    std::vector<std::string> paths;
    for (std::size_t k = 1; k <= manifest.plan.bricks.size(); ++k)
        paths.push_back(brickPath(call.input, k));
    build.inputs = paths;
    build.inputs.push_back(call.input);
    prepareOutputs(build);
    Terminal terminal(call.progress);
    Report report;
    report.warnings = build.warnings;
    mergeBricks(build, manifest.plan, paths, sha256OfFile(call.input), true, terminal, start,
                report);
    if (call.verbose) sayTimes(report);
    if (!call.quiet) {
        for (const std::string& warning : report.warnings) printLine("warning: " + warning);
        printLine(summary(report));
    }
    return endOf(report, "bricks plan --steps");
}

} // namespace molsurf::tool
