// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bricks.h"

#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/scale/bricks/merged_bricks.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/commit.h"

#include <optional>

namespace molsurf
{

namespace
{

constexpr const char* libraryPlan = "library"; // plans of a program have a name of their own

} // namespace

void makeBrick(const BallSet& balls, const SurfaceOptions& options, const BrickPlan& plan,
               std::size_t number, const std::string& path, Progress* listener)
{
    checkOptions(options);
    checkWay(InBricks, options);
    if (number == 0 || number > plan.bricks.size())
        throw Error(ErrorKind::Usage, "brick: expected a number from 1 to " +
                                          std::to_string(plan.bricks.size()) + ", got " +
                                          std::to_string(number));
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    BallSet colored = balls;
    if (options.color != ColorBy::Nothing && colored.colors.empty())
        colored.colors = ballColors(balls, options.color, progress);
    std::shared_ptr<const SparseField> coarse;
    checkExtent(plan, Influence(balls, options).extent());
    const auto near = [&](const openvdb::BBoxd& space) { return ballsIn(colored, space); };
    computeBrick(near, options, plan, number, libraryPlan, path, true, coarse, progress);
}

Report mergeBricks(const std::vector<std::string>& bricks, const BrickPlan& plan,
                   const SurfaceOptions& options, const std::string& vdb, const std::string& ply,
                   Progress* listener)
{
    checkOptions(options);
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    const MergedBricks merged(bricks, libraryPlan, plan, options, true);
    std::optional<OutputFile> grids, mesh;
    std::vector<OutputFile*> files;
    if (!vdb.empty()) {
        files.push_back(&grids.emplace(vdb, true));
        merged.writeVdb(openvdb::MetaMap(), *grids, progress);
    }
    if (!ply.empty()) {
        files.push_back(&mesh.emplace(ply, true));
        merged.writePly(*mesh, progress);
    }
    commit(files);
    return merged.report();
}

} // namespace molsurf
