// SPDX-License-Identifier: MPL-2.0
#include "molsurf/bricks.h"

#include "molsurf/bricks/merged_bricks.h"
#include "molsurf/bricks/plan_bricks.h"
#include "molsurf/color/palette.h"
#include "molsurf/io/output_file.h"

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
    checkBrickOptions(options);
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
    computeBrick(colored, options, plan, number, libraryPlan, path, true, coarse, progress);
}

Report mergeBricks(const std::vector<std::string>& bricks, const BrickPlan& plan,
                   const SurfaceOptions& options, const std::string& vdb, const std::string& ply,
                   Progress* listener)
{
    checkOptions(options);
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    const MergedBricks merged(bricks, libraryPlan, plan.atoms, options);
    if (!vdb.empty()) {
        OutputFile file(vdb, true);
        merged.writeVdb(openvdb::MetaMap(), file, progress);
        file.commit();
    }
    if (!ply.empty()) {
        OutputFile file(ply, true);
        merged.writePly(file, progress);
        file.commit();
    }
    return merged.report();
}

} // namespace molsurf
