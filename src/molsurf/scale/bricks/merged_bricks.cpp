// SPDX-License-Identifier: MPL-2.0
#include "molsurf/scale/bricks/merged_bricks.h"

#include "molsurf/error.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/scale/bricks/merge_vdb.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

namespace molsurf
{

namespace
{

/// Whether two bricks hold the same kinds of things.
bool fits(const BrickHeader& a, const BrickHeader& b)
{
    const auto same = [](const auto& x, const auto& y, const auto& equal) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(), equal);
    };
    return same(a.grids, b.grids,
                [](const StoredGrid& x, const StoredGrid& y) {
                    return x.name == y.name && x.type == y.type && x.gridClass == y.gridClass &&
                           x.background == y.background && x.half == y.half;
                }) &&
           same(a.sums.groups, b.sums.groups,
                [](const Report::Group& x, const Report::Group& y) {
                    return x.name == y.name && x.atoms == y.atoms;
                }) &&
           a.sums.evolution.has_value() == b.sums.evolution.has_value() &&
           (!a.sums.evolution || a.sums.evolution->steps == b.sums.evolution->steps);
}

std::vector<BrickFile> openBricks(const std::vector<std::string>& paths, const std::string& id,
                                  const BrickPlan& plan, bool meshed)
{
    if (paths.empty() || paths.size() != plan.bricks.size())
        throw Error(ErrorKind::Input, "merge: " + std::to_string(paths.size()) +
                                          " files for a plan of " +
                                          std::to_string(plan.bricks.size()) + " bricks");
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
        bricks.emplace_back(paths[k], plan.bricks[k].box);
        if (bricks.back().header().plan != id || bricks.back().header().number != k + 1)
            throw Error(ErrorKind::Input, paths[k] + " belongs to another plan");
        if (!fits(bricks.back().header(), bricks.front().header()))
            throw Error(ErrorKind::Input,
                        paths[k] + ": its grids or groups are others than those of " + paths[0] +
                            " [hint: run the bricks again with `force`]");
        if (meshed && !bricks.back().header().meshed()) bricks.back().refuse("holds no mesh");
    }
    return bricks;
}

/// Sums the areas of groups over bricks, and scales them to the area of the whole. The last one is
/// that of no group, whose atoms are the rest; without any it is dropped.
void addGroups(const std::vector<BrickFile>& bricks, Report& report)
{
    std::size_t rest = report.atoms;
    double sum = 0.0;
    for (const BrickFile& brick : bricks) {
        const std::vector<Report::Group>& part = brick.header().sums.groups;
        if (report.groups.empty() && !part.empty()) {
            report.groups = part;
            for (Report::Group& group : report.groups) {
                group.area = 0.0;
                group.volume = std::numeric_limits<double>::quiet_NaN(); // not summed by bricks
                if (group.atoms > rest) brick.refuse("has groups of more atoms than the plan");
                rest -= group.atoms;
            }
        }
        for (std::size_t g = 0; g < part.size(); ++g) {
            report.groups[g].area += part[g].area;
            if (report.groups[g].color.empty()) report.groups[g].color = part[g].color;
            sum += part[g].area;
        }
    }
    if (report.groups.empty()) return;
    if (sum > 0.0)
        for (Report::Group& group : report.groups) group.area *= report.surface.area / sum;
    report.groups.back().atoms = rest;
    if (rest == 0 && report.groups.back().area == 0.0) report.groups.pop_back();
}

/// The history of the flow: sums over the bricks (of displacements means, weighted by area), and
/// the stopping rule as of its last step.
std::optional<EvolutionReport> evolutionOf(const std::vector<BrickFile>& bricks,
                                           const EvolveOptions& options, double voxel)
{
    EvolutionReport all;
    all.finalEnergy = 0.0;
    bool any = false;
    std::vector<double> moved;
    Displacements last;
    const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
        to.resize(std::max(to.size(), from.size()), 0.0);
        for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
    };
    for (const BrickFile& brick : bricks) {
        const auto& part = brick.header().sums.evolution;
        if (!part) continue;
        any = true;
        all.finalEnergy += part->finalEnergy;
        last += brick.header().sums.displacements;
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
        all.unresolvedGapVoxels += part->unresolvedGapVoxels;
    }
    if (!any) return {};
    for (std::size_t i = 0; i < moved.size(); ++i)
        all.meanDisplacement.push_back(all.area[i] > 0.0 ? moved[i] / all.area[i] : 0.0);
    if (restsInClosedForm(options)) {
        checkConvergence(last, options, voxel, all);
    } else {
        judge(last, options, voxel, all);
        estimateAreaError(options, all);
    }
    return all;
}

} // namespace

MergedBricks::MergedBricks(const std::vector<std::string>& paths, const std::string& id,
                           const BrickPlan& plan, const SurfaceOptions& options, bool meshed)
    : bricks_(openBricks(paths, id, plan, meshed)), mesh_(bricks_)
{
    report_.surface = mesh_.report();
    report_.surface.kind = nameOf(options.kind);
    if (isClosedForm(options)) dropTopology(report_.surface);
    if (mesh_.triangles() == 0) failNothingLeft("merge", options.kind);
    if (!report_.surface.closed)
        report_.warnings.push_back("merge: the bricks do not fit everywhere: the mesh has gaps");
    report_.evolution = evolutionOf(bricks_, options.evolution, options.voxel);
    const MergedSize size = sizeOfMerged(bricks_);
    report_.activeVoxels = size.activeVoxels;
    report_.gridBytes = size.bytes;
    report_.atoms = plan.atoms;
    report_.voxel = options.voxel;
    for (const BrickFile& brick : bricks_)
        for (const auto& [stage, seconds] : brick.header().sums.seconds)
            report_.addSeconds(stage, seconds);
    addGroups(bricks_, report_);
}

void MergedBricks::writeVdb(const openvdb::MetaMap& metadata, OutputFile& file,
                            const Progress& progress) const
{
    writeMergedVdb(bricks_, report_.voxel, "vdb_molsurf " MOLSURF_VERSION, metadata, file,
                   progress);
}

void MergedBricks::writePly(OutputFile& file, const Progress& progress) const
{
    mesh_.writePly(file, progress);
}

} // namespace molsurf
