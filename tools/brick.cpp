// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "cli/complete.h"
#include "cli/option_table.h"
#include "cli/parse.h"
#include "input_files.h"
#include "stop.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/scale/bricks/atoms_file.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/scale/bricks/plan_file.h"

#include <algorithm>
#include <filesystem>

namespace molsurf::tool
{

std::string brickPath(const std::string& planPath, std::size_t number)
{
    const std::filesystem::path path(planPath);
    return (path.parent_path() / path.stem()).string() + "." + std::to_string(number) + ".brick";
}

std::string atomsPath(const std::string& planPath)
{
    return std::filesystem::path(planPath).replace_extension(".atoms").string();
}

namespace
{

void checkFile(const PlanInput& file, PlanFiles how)
{
    std::error_code ignored;
    const bool there = std::filesystem::is_regular_file(file.path, ignored);
    if (!there && how == PlanFiles::Sizes) return;
    if (!there)
        throw Error(ErrorKind::Input, "cannot find " + file.path +
                                          ", which the plan was made of [hint: it has to lie "
                                          "where it lay, seen from the plan]");
    if (std::filesystem::file_size(file.path, ignored) != file.bytes ||
        (how == PlanFiles::Hashes && sha256OfFile(file.path) != file.sha256))
        throw Error(ErrorKind::Input, file.path + " has changed since the plan was made "
                                                  "[hint: make a new one]");
}

} // namespace

CommandLine callOf(PlanManifest manifest, const std::string& path, PlanFiles files)
{
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const auto resolved = [&](const std::string& file) { return (folder / file).string(); };
    for (PlanInput& file : manifest.files) file.path = resolved(file.path);
    manifest.input = resolved(manifest.input);
    std::vector<std::string> read = {manifest.input};
    for (auto& [name, values] : manifest.options) {
        const Option* option = findOption(BricksPlan, name);
        if (!option || !option->file) continue;
        for (std::string& value : values) {
            const std::string_view named = option->file(value);
            if (named.empty()) continue;
            read.push_back(resolved(std::string(named)));
            value.replace(std::size_t(named.data() - value.data()), named.size(), read.back());
        }
    }
    for (const std::string& file : read)
        if (std::none_of(manifest.files.begin(), manifest.files.end(),
                         [&](const PlanInput& known) { return known.path == file; }))
            throw Error(ErrorKind::Input, "the plan is damaged: it has no hash of " + file);
    if (manifest.version != MOLSURF_VERSION)
        throw Error(ErrorKind::Input, "the plan was made by version " + manifest.version +
                                          ", this is " MOLSURF_VERSION);
    for (const PlanInput& file : manifest.files) checkFile(file, files);
    CommandLine call;
    call.verb = BricksPlan;
    call.input = manifest.input;
    setOptions(manifest.options, call);
    completeSurface(call);
    checkPlan(manifest.plan, call.options);
    if (!restsInClosedForm(call.options)) call.options.evolution.steps = manifest.plan.steps;
    checkWay(InBricks, call.options);
    return call;
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

int brick(const CommandLine& call)
{
    failIfStream(call.input, "the file of a plan");
    const PlanManifest manifest = readManifest(call.input);
    const std::size_t count = manifest.plan.bricks.size();
    if (call.brick > count)
        throw Error(ErrorKind::Usage, "bricks run: expected a number from 1 to " +
                                          std::to_string(count) + ", got " +
                                          std::to_string(call.brick));
    const std::string id = sha256OfFile(call.input), path = brickPath(call.input, call.brick);
    if (!call.force && isDone(path, id, call.brick)) {
        if (!call.quiet) printLine(path + " is done already");
        return 0;
    }
    CommandLine build = callOf(manifest, call.input, PlanFiles::Sizes);
    build.outputs = {{path, findFormat("vdb")}};
    build.force = true;
    build.quiet = call.quiet;
    build.inputs = {call.input, atomsPath(call.input)};
    prepareOutputs(build);
    Terminal terminal(call.progress);
    const Clock::time_point start = Clock::now();
    checkCost(manifest.plan.bricks[call.brick - 1], limitsOf(call));
    const AtomsFile atoms(atomsPath(call.input));
    if (sha256OfText(atoms.index()) != manifest.atomsIndex)
        throw Error(ErrorKind::Input,
                    atomsPath(call.input) + " belongs to another plan [hint: make a new one]");
    checkExtent(manifest.plan, atoms.extent());
    std::shared_ptr<const SparseField> coarse;
    computeBrick([&](const openvdb::BBoxd& space) { return atoms.within(space); }, build.options,
                 manifest.plan, call.brick, id, path, true, coarse, terminal);
    terminal.erase();
    if (!call.quiet) {
        const PlannedBrick& planned = manifest.plan.bricks[call.brick - 1];
        printLine(path + formatted(": %.2f s, %s of memory (%s planned)", secondsSince(start),
                                   sizeText(double(peakMemory())).c_str(),
                                   sizeText(double(planned.bytes)).c_str()));
    }
    return 0;
}

} // namespace molsurf::tool
