// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "sha256.h"
#include "stop.h"
#include "verbs.h"

#include "molsurf/core/error.h"
#include "molsurf/io/plan_file.h"
#include "molsurf/pipeline/palette.h"
#include "molsurf/pipeline/plan_bricks.h"
#include "molsurf/pipeline/size_beads.h"
#include "molsurf/structure/read_structure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace molsurf::tool
{

BallSelection readBalls(const Call& call, Terminal& terminal, Report& report)
{
    const Clock::time_point start = Clock::now();
    terminal.update("read", 0.0);
    BallSelection selection;
    std::string description;
    {
        const Structure structure = readStructure(call.input);
        stopIfAsked();
        selection = selectBalls(structure, call.options.atoms, beadSizer(call.options, terminal));
        description = describeSelection(structure, selection);
    }
    // Colours depend on what touches what, in the whole molecule.
    if (call.options.color != ColorBy::Nothing)
        selection.colors = ballColors(selection, call.options.color, terminal);
    terminal.erase();
    report.warnings = call.warnings;
    report.warnings.insert(report.warnings.end(), selection.warnings.begin(),
                           selection.warnings.end());
    report.seconds.emplace_back("read", secondsSince(start));
    if (!call.quiet) {
        say(description);
        for (const std::string& warning : report.warnings) say("warning: " + warning);
    }
    stopIfAsked();
    return selection;
}

std::vector<std::string> describePlan(const BrickPlan& plan)
{
    std::size_t voxels = 0, bytes = 0;
    double seconds = 0.0;
    for (const PlannedBrick& brick : plan.bricks) {
        voxels += brick.voxels;
        bytes = std::max(bytes, brick.bytes);
        seconds += brick.seconds;
    }
    char text[200];
    std::snprintf(text, sizeof text,
                  "%zu atoms, %s, about %.3g voxels, %.3g GB of memory at most, %.3g s on one core",
                  plan.atoms, counted(plan.bricks.size(), "brick", "bricks").c_str(),
                  double(voxels), double(bytes) / 1e9, seconds);
    return {text};
}

int plan(const Call& call)
{
    checkOptions(call.options);
    checkBrickOptions(call.options);
    prepareOutputs(call);
    openvdb::initialize();
    std::optional<tbb::global_control> limit;
    if (call.threads)
        limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(call.threads));
    Terminal terminal(call.progress);
    Report report;
    PlanManifest manifest;
    const BallSelection atoms = readBalls(call, terminal, report);
    manifest.version = MOLSURF_VERSION;
    manifest.input = call.input;
    manifest.arguments = call.given;
    manifest.voxel = call.options.voxel;
    manifest.files.push_back({call.input, sha256OfFile(call.input)});
    for (const std::string& file : call.read) manifest.files.push_back({file, sha256OfFile(file)});
    manifest.plan = planBricks(atoms, call.options, {call.bricks, call.memory}, terminal);
    terminal.erase();

    OutputFile file(call.outputs[0].path, call.force);
    writeManifest(manifest, file);
    ignoreSignals();
    file.commit();
    if (!call.quiet)
        for (const std::string& line : describePlan(manifest.plan)) say(line);
    return 0;
}

} // namespace molsurf::tool
