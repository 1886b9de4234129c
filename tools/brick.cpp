// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "sha256.h"
#include "stop.h"
#include "verbs.h"

#include "molsurf/bricks/brick_file.h"
#include "molsurf/bricks/plan_bricks.h"
#include "molsurf/bricks/plan_file.h"
#include "molsurf/core/error.h"

#include <cstdio>
#include <filesystem>

namespace molsurf::tool
{

std::string brickPath(const std::string& planPath, std::size_t number)
{
    const std::filesystem::path path(planPath);
    return (path.parent_path() / path.stem()).string() + "." + std::to_string(number) + ".brick";
}

Call callOf(const PlanManifest& manifest)
{
    if (manifest.version != MOLSURF_VERSION)
        throw Error(ErrorKind::Input, "the plan was made by version " + manifest.version +
                                          ", this is " MOLSURF_VERSION);
    for (const PlanInput& file : manifest.files) {
        if (!std::filesystem::exists(file.path))
            throw Error(ErrorKind::Input, "cannot find " + file.path +
                                              ", which the plan was made of [hint: run where plan "
                                              "was run, or make the plan with an absolute path]");
        if (sha256OfFile(file.path) != file.sha256)
            throw Error(ErrorKind::Input, file.path + " has changed since the plan was made "
                                                      "[hint: make a new one]");
    }
    std::vector<const char*> words = {"vdb_molsurf"};
    for (const std::string& word : manifest.arguments) words.push_back(word.c_str());
    for (const char* word : {"-o", "brick.vdb", "--"}) words.push_back(word);
    words.push_back(manifest.input.c_str());
    Call call = parseCall(int(words.size()), words.data());
    call.options.evolution.steps = manifest.plan.steps;
    checkOptions(call.options);
    checkBrickOptions(call.options);
    return call;
}

void computeBrick(const BallSelection& atoms, const Options& options, const BrickPlan& plan,
                  std::size_t number, const std::string& id, const std::string& path, bool meshed,
                  Terminal& terminal)
{
    Options fixed = options;
    fixed.evolution.steps = plan.steps;
    const Scope scope = scopeOf(plan, number - 1, fixed);
    const Brick brick =
        runBrick(ballsNear(atoms, fixed, scope), fixed, scope, terminal, plan.keepsMemory);
    terminal.update("write", 0.0);
    OutputFile file(path, true);
    writeBrick(brick, id, number, meshed, file, terminal);
    file.commit();
}

namespace
{

// Whether a brick is done already.
bool isDone(const std::string& path, const std::string& id, std::size_t number)
{
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return false;
    const BrickFile file(path);
    if (file.header().plan != id || file.header().number != number)
        throw Error(ErrorKind::Output,
                    path + " belongs to another plan [hint: another folder, or --force]");
    return true;
}

} // namespace

int brick(const Call& call)
{
    const PlanManifest manifest = readManifest(call.input);
    const std::size_t count = manifest.plan.bricks.size();
    if (call.bricks > count)
        throw Error(ErrorKind::Usage, "brick: expected a number from 1 to " +
                                          std::to_string(count) + ", got " +
                                          std::to_string(call.bricks));
    const std::string id = sha256OfFile(call.input), path = brickPath(call.input, call.bricks);
    if (!call.force && isDone(path, id, call.bricks)) {
        if (!call.quiet) say(path + " is done already");
        return 0;
    }
    Call build = callOf(manifest);
    build.outputs = {{path, Format::Vdb, "", 0.0}};
    build.force = true;
    build.quiet = call.quiet;
    prepareOutputs(build);
    openvdb::initialize();
    const auto limit = limitThreads(call);
    Terminal terminal(call.progress);
    const Clock::time_point start = Clock::now();
    Report report;
    BallSelection atoms = readBalls(build, terminal, report);
    colorBalls(build.options, terminal, atoms);
    computeBrick(atoms, build.options, manifest.plan, call.bricks, id, path, true, terminal);
    terminal.erase();
    if (!call.quiet) {
        const PlannedBrick& planned = manifest.plan.bricks[call.bricks - 1];
        char text[160];
        std::snprintf(text, sizeof text, ": %.2f s, %.3f GB of memory (%.3f planned)",
                      secondsSince(start), double(peakMemory()) / 1e9, double(planned.bytes) / 1e9);
        say(path + text);
    }
    return 0;
}

} // namespace molsurf::tool
