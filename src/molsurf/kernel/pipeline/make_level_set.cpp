// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel.h"
#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/pose_error.h"
#include "molsurf/kernel/pipeline/surface_run.h"

#include <cstddef>
#include <cstdint>

namespace molsurf
{

namespace
{

/// The balls in spatial order, so that nothing depends on that of the caller.
BallModel ordered(const BallModel& model, const std::vector<std::int32_t>& order)
{
    BallModel out;
    for (const std::int32_t i : order) {
        out.balls.push_back(model.balls[std::size_t(i)]);
        if (!model.decays.empty()) out.decays.push_back(model.decays[std::size_t(i)]);
    }
    return out;
}

} // namespace

LevelSetSurface makeLevelSet(const BallModel& model, const SurfaceSpec& spec,
                             const KernelProducts& products, Progress* listener)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    checkBalls(model.balls, spec, Pieces::One, availableMemory());
    const std::vector<std::int32_t> order = spatialOrder(model.balls);
    const BallModel balls = ordered(model, order);
    SurfaceRun run(balls, {spec, products}, Scope(), progress);
    run.toMeasures();
    run.finishMesh();
    run.result().fields = run.fields();
    run.freeFields();
    LevelSetSurface made = run.finish();
    if (dependsOnPose(spec)) estimatePoseError(balls, spec, progress, made.report);
    made.ballAreas = inCallersOrder(made.ballAreas, order);
    return made;
}

} // namespace molsurf
