// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/whole_run.h"

#include "molsurf/balls/placed_ball.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/closed_form.h"
#include "molsurf/surface/label_surface.h"
#include "molsurf/surface/pose_error.h"
#include "molsurf/surface/surface_kind.h"
#include "molsurf/surface/surface_run.h"

#include <utility>

namespace molsurf
{

namespace
{

/// The surface of balls in their order.
WholeSurface runAsTheyAre(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    SurfaceRun run(atoms, options, Scope(), progress);
    run.toMesh();
    run.measure();
    run.describeCurvature();
    run.takeClosedForm();
    run.remesh();
    run.curvatures();
    run.integrateCurvature();
    run.grids();
    run.freeFields();
    run.labels();
    std::vector<double> areas = run.takeAreas();
    return {run.finish(), std::move(areas)};
}

} // namespace

WholeSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const BallSet ordered = inSpatialOrder(atoms);
    WholeSurface made = runAsTheyAre(ordered, options, progress);
    if (dependsOnPose(options)) estimatePoseError(ordered, options, progress, made.surface.report);
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    for (std::vector<double>* values : {&made.areas, &made.surface.ballValues}) {
        std::vector<double> back(values->size());
        for (std::size_t i = 0; i < values->size(); ++i) back[std::size_t(order[i])] = (*values)[i];
        *values = std::move(back);
    }
    return made;
}

WholeSurface runWithoutGrid(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    WholeSurface made;
    MolecularSurface& result = made.surface;
    Stopwatch watch(result.report);
    progress.update("areas", 0.0);
    ClosedForm measured = measureClosedForm(atoms.balls, options, progress);
    result.report.surface.kind = nameOf(options.kind);
    describePieces(measured, false, result.report.surface);
    result.report.surface.cuspLength = measured.cuspLength;
    if (atoms.labels && atoms.labels->values)
        result.ballValues.assign(atoms.labels->values->valueOf.begin(),
                                 atoms.labels->values->valueOf.end());
    made.areas = labelSurface(atoms, options, std::move(measured.ballAreas), 0.0, progress, result);
    watch.stop("areas");
    return made;
}

} // namespace molsurf
