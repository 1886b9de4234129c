// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "outputs.h"
#include "sha256.h"
#include "stop.h"
#include "verbs.h"
#include "write_result.h"

#include "molsurf/bricks/brick_file.h"
#include "molsurf/bricks/merge_mesh.h"
#include "molsurf/bricks/merge_vdb.h"
#include "molsurf/bricks/plan_file.h"
#include "molsurf/core/error.h"
#include "molsurf/flow/evolve.h"
#include "molsurf/io/write_report.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

namespace molsurf::tool
{

namespace
{

std::vector<BrickFile> openBricks(const std::vector<std::string>& paths, const std::string& id)
{
    std::string missing;
    std::size_t count = 0;
    std::error_code ignored;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        if (std::filesystem::exists(paths[k], ignored)) continue;
        if (++count <= 10) missing += (missing.empty() ? "" : ", ") + std::to_string(k + 1);
    }
    if (count > 0)
        throw Error(ErrorKind::Input, "merge: of " + std::to_string(paths.size()) + " bricks " +
                                          std::to_string(count) + " are missing: " + missing +
                                          (count > 10 ? ", ..." : ""));
    std::vector<BrickFile> bricks;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        bricks.emplace_back(paths[k]);
        if (bricks.back().header().plan != id || bricks.back().header().number != k + 1)
            throw Error(ErrorKind::Input, paths[k] + " belongs to another plan");
    }
    return bricks;
}

// Groups with the areas of their parts, in proportion to the whole area.
void reportGroups(const std::vector<BrickFile>& bricks, Report& report)
{
    std::size_t rest = report.atoms;
    double sum = 0.0;
    for (const BrickFile& brick : bricks) {
        const std::vector<GroupReport>& part = brick.header().sums.groups;
        if (report.groups.empty() && !part.empty()) {
            report.groups = part;
            for (GroupReport& group : report.groups) {
                group.area = 0.0;
                group.volume = std::numeric_limits<double>::quiet_NaN(); // not summed by bricks
                rest -= group.atoms;
            }
        }
        for (std::size_t g = 0; g < part.size(); ++g) {
            report.groups[g].area += part[g].area;
            sum += part[g].area;
        }
    }
    if (report.groups.empty()) return;
    for (GroupReport& group : report.groups) group.area *= report.surface.area / sum;
    report.groups.back().atoms = rest;
    if (rest == 0 && report.groups.back().area == 0.0) report.groups.pop_back();
}

// The history of the flow: sums over the bricks, and the stopping rule as of its last step.
std::optional<EvolutionReport> evolutionOf(const std::vector<BrickFile>& bricks,
                                           const EvolveOptions& options, double voxel)
{
    EvolutionReport all;
    bool any = false;
    std::vector<double> moved;
    const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
        to.resize(std::max(to.size(), from.size()), 0.0);
        for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
    };
    for (const BrickFile& brick : bricks) {
        const auto& part = brick.header().sums.evolution;
        if (!part) continue;
        any = true;
        all.steps = std::max(all.steps, part->steps);
        add(part->energy, all.energy);
        add(part->area, all.area);
        add(part->volume, all.volume);
        std::vector<double> displacement = part->meanDisplacement;
        for (std::size_t i = 0; i < displacement.size(); ++i) displacement[i] *= part->area[i];
        add(displacement, moved);
        all.maxSpeed.resize(std::max(all.maxSpeed.size(), part->maxSpeed.size()), 0.0);
        for (std::size_t i = 0; i < part->maxSpeed.size(); ++i)
            all.maxSpeed[i] = std::max(all.maxSpeed[i], part->maxSpeed[i]);
        all.creviceVoxels += part->creviceVoxels;
    }
    if (!any) return {};
    for (std::size_t i = 0; i < moved.size(); ++i)
        all.meanDisplacement.push_back(all.area[i] > 0.0 ? moved[i] / all.area[i] : 0.0);
    judge(options, voxel, all);
    return all;
}

} // namespace

void mergeBricks(const Call& call, const BrickPlan& plan, const std::vector<std::string>& paths,
                 const std::string& id, Terminal& terminal, Clock::time_point start, Report& report)
{
    const std::vector<BrickFile> bricks = openBricks(paths, id);
    terminal.update("merge", 0.0);
    const MergedMesh mesh(bricks);
    report.surface = mesh.report();
    report.surface.kind = nameOf(call.options.kind);
    if (mesh.triangles() == 0)
        throw Error(ErrorKind::Numeric,
                    "merge: nothing of the molecule is left at this resolution [hint: a smaller "
                    "--voxel, --lambda or --epsilon]");
    if (!report.surface.closed)
        report.warnings.push_back("merge: the bricks do not fit everywhere: the mesh has gaps");
    report.evolution = evolutionOf(bricks, call.options.evolution, call.options.voxel);
    const MergedSize size = sizeOfMerged(bricks);
    report.activeVoxels = size.activeVoxels;
    report.gridBytes = size.bytes;
    beginReport(call, report);
    report.atoms = plan.atoms;
    report.voxel = call.options.voxel;
    for (const BrickFile& brick : bricks) {
        for (const auto& [stage, time] : brick.header().sums.seconds) {
            auto found = std::find_if(report.seconds.begin(), report.seconds.end(),
                                      [&](const auto& s) { return s.first == stage; });
            if (found == report.seconds.end())
                found = report.seconds.insert(report.seconds.end(), {stage, 0.0});
            found->second += time;
        }
    }
    reportGroups(bricks, report);
    const std::string creator = "vdb_molsurf " MOLSURF_VERSION;
    writeOutputs(
        call, terminal,
        [&](const Output& output, OutputFile& file) {
            if (output.format == Format::Vdb) {
                writeMergedVdb(bricks, call.options.voxel, creator, vdbMetadata(call, report), file,
                               terminal);
            } else if (output.format == Format::Ply) {
                mesh.writePly(file, terminal);
            } else {
                writeReport(report, file);
            }
        },
        [&](double writeSeconds) {
            report.seconds.emplace_back("write", writeSeconds);
            report.seconds.emplace_back("total", secondsSince(start));
            report.peakMemoryBytes = peakMemory();
        },
        false);
    terminal.erase();
}

int merge(const Call& call, Clock::time_point start)
{
    const PlanManifest manifest = readManifest(call.input);
    Call build = callOf(manifest);
    build.outputs = call.outputs;
    build.force = call.force;
    build.quiet = call.quiet;
    build.command = call.command;
    prepareOutputs(build);
    openvdb::initialize();
    const auto limit = limitThreads(call);
    Terminal terminal(call.progress);
    std::vector<std::string> paths;
    for (std::size_t k = 1; k <= manifest.plan.bricks.size(); ++k)
        paths.push_back(brickPath(call.input, k));
    Report report;
    report.warnings = build.warnings;
    mergeBricks(build, manifest.plan, paths, sha256OfFile(call.input), terminal, start, report);
    if (!call.quiet) {
        for (const std::string& warning : report.warnings) say("warning: " + warning);
        say(summary(report));
    }
    return endOf(report);
}

} // namespace molsurf::tool
