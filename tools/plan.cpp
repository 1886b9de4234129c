// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "sha256.h"
#include "stop.h"
#include "verbs.h"

#include "molsurf/bricks/plan_bricks.h"
#include "molsurf/bricks/plan_file.h"
#include "molsurf/core/error.h"

#include <algorithm>
#include <cstdio>

namespace molsurf::tool
{

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
    const auto limit = limitThreads(call);
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
    if (!call.quiet) {
        for (const std::string& line : describePlan(manifest.plan)) say(line);
        if (manifest.plan.bricks.size() < call.bricks)
            say("fewer bricks than asked for: smaller ones would be little but overlap");
    }
    return 0;
}

} // namespace molsurf::tool
