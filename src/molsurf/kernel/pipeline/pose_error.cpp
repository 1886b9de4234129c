// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/pose_error.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/pipeline/surface_run.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The balls, turned about their middle and shifted. Axis and shift are arbitrary, so that nothing
/// lies on the grid as before.
/// @param[in] angle  [rad]
BallModel turned(const BallModel& model, double angle)
{
    openvdb::BBoxd box;
    for (const Ball& ball : model.balls) box.expand(ball.center);
    const openvdb::math::Quat<double> turn(Vec3d(0.36, 0.48, 0.8), angle);
    const openvdb::Mat3d axes(turn);
    const Vec3d middle = box.getCenter(), shift(0.17, 0.29, 0.41);
    BallModel out;
    out.balls = model.balls;
    out.decays = model.decays;
    for (Ball& ball : out.balls) ball.center = middle + axes * (ball.center - middle) + shift;
    return out;
}

double areaOf(const BallModel& model, const SurfaceSpec& spec, double voxel, Progress& progress)
{
    SurfaceRun run(model, {withVoxel(spec, voxel), measuresAlone()}, Scope(), progress);
    run.toMesh();
    run.measure();
    return run.result().report.surface.area;
}

/// The area on voxels of twice the edge, or of the same for a molecule that they cannot show.
double coarserArea(const BallModel& model, const SurfaceSpec& spec, Progress& progress)
{
    try {
        return areaOf(model, spec, std::min(2.0 * spec.voxel, maxVoxel), progress);
    } catch (const Error&) {
        return areaOf(model, spec, spec.voxel, progress);
    }
}

} // namespace

bool dependsOnPose(const SurfaceSpec& spec)
{
    // measured: bench/rotations.py vdb_molsurf FILE --lambda 0.04 of 1D66, 1BNA and 1A8O: areas
    // within 0.2 %, and within 1.5 % at 0.045.
    constexpr double parting = 0.04;
    const EvolveOptions& flow = spec.evolution;
    return hasFlow(spec.kind) && makesNewtonSteps(flow) && !flow.steps && flow.lambda > parting;
}

void estimatePoseError(const BallModel& model, const SurfaceSpec& spec, Progress& progress,
                       Report& report)
{
    // measured: half of the largest difference of six poses of 1D66, 1BNA, 1A8O and 5PTI at lambda
    // 0.07, 0.1 and 0.3 is below this many times that of one of them and the farther run in 68 of
    // 72 cases.
    constexpr double factor = 1.5;
    if (!report.evolution) return;
    Stopwatch watch(report);
    QuietProgress quiet(progress);
    double error = 0.0;
    for (const double angle : {1.1, 2.3}) {
        const double area = coarserArea(turned(model, angle), spec, quiet);
        error = std::max(error, factor * std::abs(1.0 - area / report.surface.area));
    }
    double& known = report.evolution->areaError;
    known = std::isnan(known) ? error : std::max(known, error);
    report.warnings.push_back(formatted(
        "`lambda` %g: the place of the molecule on the grid changes the area by about %.2g %% "
        "[hint: `lambda` 0.04 depends less on it]",
        spec.evolution.lambda, 100.0 * known));
    watch.stop("poses");
}

} // namespace molsurf
