// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "cli/option_table.h"
#include "input_files.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/scale/bricks/atoms_file.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/scale/bricks/plan_file.h"
#include "molsurf/show/io/temporary_file.h"

#include <algorithm>
#include <filesystem>

namespace molsurf::tool
{

std::string costText(const PlannedBrick& cost)
{
    return formatted("about %.3g voxels, %s of memory at most, %.3g s on one core",
                     double(cost.voxels), sizeText(double(cost.bytes)).c_str(), cost.seconds);
}

std::vector<std::string> describePlan(const BrickPlan& plan)
{
    PlannedBrick all;
    all.bytes = peakMemory(); // reading has one of its own
    for (const PlannedBrick& brick : plan.bricks) {
        all.voxels += brick.voxels;
        all.bytes = std::max(all.bytes, brick.bytes);
        all.seconds += brick.seconds;
    }
    return {counted(plan.atoms, "atom", "atoms") + ", " +
            counted(plan.bricks.size(), "brick", "bricks") + ", " + costText(all)};
}

namespace
{

// A path as it is found from the folder of the plan, wherever the bricks are computed.
std::string fromPlan(const CommandLine& call, const std::string& path)
{
    namespace fs = std::filesystem;
    if (fs::path(path).is_absolute()) return path;
    return fs::absolute(path)
        .lexically_normal()
        .lexically_relative(fs::absolute(call.outputs[0].path).lexically_normal().parent_path())
        .string();
}

// The options that say what surface is wanted; those that name files do so from the plan.
GivenOptions planned(const CommandLine& call)
{
    GivenOptions options;
    for (const auto& [name, values] : call.given) {
        const Option* option = findOption(BricksPlan, name);
        if (!option || !option->get) continue;
        std::vector<std::string>& kept = options[name]; // of a switch it is empty
        for (std::string value : values) {
            const std::string_view path = option->file ? option->file(value) : "";
            if (!path.empty())
                value.replace(std::size_t(path.data() - value.data()), path.size(),
                              fromPlan(call, std::string(path)));
            kept.push_back(std::move(value));
        }
    }
    return options;
}

} // namespace

int plan(CommandLine call)
{
    std::vector<std::string> planFiles = {call.input};
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->get) planFiles.push_back(file.path);
    for (const std::string& path : planFiles) failIfStream(path, "a file, which bricks read again");
    const std::string atomsFile = atomsPath(call.outputs[0].path);
    InputFiles(call).refuse(atomsFile);
    checkWritable(atomsFile, call.force);
    prepareOutputs(call, {temporaryName(atomsFile)});
    call.labels.names = false;         // bricks use none
    call.atoms.assembly.folded = true; // atoms of one copy, with the motions of all
    Terminal terminal(call.progress);
    Report report;
    PlanManifest manifest;
    BallSet atoms = readBalls(call, terminal, report);
    manifest.version = MOLSURF_VERSION;
    manifest.input = fromPlan(call, call.input);
    manifest.options = planned(call);
    manifest.voxel = call.options.voxel;
    for (const std::string& path : planFiles)
        manifest.files.push_back(
            {fromPlan(call, path), sha256OfFile(path), std::filesystem::file_size(path)});
    // Bricks run in processes of their own, and read their atoms from disk.
    manifest.plan = planBricks(atoms, call.options,
                               {std::size_t(call.bricks), call.memory, false, true}, terminal);
    colorBalls(call.options, terminal, atoms); // the bricks' atoms are written with their colours
    terminal.erase();

    OutputFiles files;
    files.push_back(std::make_unique<OutputFile>(atomsFile, call.force));
    manifest.atomsIndex =
        sha256OfText(writeAtoms(atoms, extentOf(manifest.plan), *files[0], terminal));
    files.push_back(std::make_unique<OutputFile>(call.outputs[0].path, call.force));
    writeManifest(manifest, *files[1]);
    commitUndisturbed(files);
    if (!call.quiet) {
        for (const std::string& line : describePlan(manifest.plan)) printLine(line);
        if (manifest.plan.bricks.size() < std::size_t(call.bricks))
            printLine("fewer bricks than asked for: smaller ones would be little but overlap");
    }
    return 0;
}

} // namespace molsurf::tool
