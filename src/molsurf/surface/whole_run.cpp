// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/whole_run.h"

#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/kernel/pipeline/closed_form.h"
#include "molsurf/kernel/pipeline/pose_error.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/label_surface.h"
#include "molsurf/surface/product_table.h"

#include <algorithm>
#include <utility>

namespace molsurf
{

namespace
{

/// The grid of the curvature that grids of colours show, if the fields lack it.
openvdb::GridPtrVec curvatureShown(const SurfaceOptions& options, SurfaceRun& run,
                                   Progress& progress)
{
    const char* shown = curvatureNameOf(options.color);
    const bool ofGrids = std::any_of(options.fields.begin(), options.fields.end(),
                                     [](auto& name) { return findField(name)->ofColors; });
    if (!shown || !ofGrids || hasField(options.fields, shown)) return {};
    return curvatureGrids(*run.result().surface, run.currentSpline(), {shown}, progress);
}

/// The surface of balls in their order.
MolecularSurface runAsTheyAre(const BallSet& atoms, const SurfaceOptions& options,
                              Progress& progress)
{
    KernelProducts products = options;
    products.ballAreas = options.ballAreas || (atoms.labels && !atoms.labels->groups.empty());
    products.needs = needsOf(atoms, options);
    SurfaceRun run(atoms, {options, products}, Scope(), progress);
    run.toMeasures();
    std::vector<double> areas; // of the mesh before its triangles are made anew
    if (options.meshEdge > 0.0 && products.ballAreas && !run.knowsAreas())
        areas = areasOnMesh(atoms, run.result().mesh, run.result().report.surface.area,
                            run.labelReach(), progress);
    run.finishMesh();
    run.result().fields = run.fields();
    openvdb::GridPtrVec shown = curvatureShown(options, run, progress);
    run.freeFields();
    MolecularSurface result = run.finish();
    result.shown = std::move(shown);
    if (!result.ballAreas.empty()) areas = std::move(result.ballAreas);
    Stopwatch watch(result.report);
    progress.update("color", 0.0);
    result.ballAreas =
        labelSurface(atoms, options, std::move(areas), run.labelReach(), progress, result);
    watch.stop("color");
    return result;
}

} // namespace

MolecularSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const BallSet ordered = inSpatialOrder(atoms);
    MolecularSurface made = runAsTheyAre(ordered, options, progress);
    if (dependsOnPose(options)) estimatePoseError(ordered, options, progress, made.report);
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    for (std::vector<double>* values : {&made.ballAreas, &made.ballValues})
        *values = inCallersOrder(*values, order);
    return made;
}

MolecularSurface runWithoutGrid(const BallSet& atoms, const SurfaceOptions& options,
                                Progress& progress)
{
    MolecularSurface result;
    Stopwatch watch(result.report);
    progress.update("areas", 0.0);
    ClosedForm measured = measureClosedForm(atoms.balls, options, progress);
    result.report.surface.kind = nameOf(options.kind);
    describePieces(measured, false, result.report.surface);
    result.report.surface.cuspLength = measured.cuspLength;
    if (atoms.labels && atoms.labels->values)
        result.ballValues.assign(atoms.labels->values->valueOf.begin(),
                                 atoms.labels->values->valueOf.end());
    result.ballAreas =
        labelSurface(atoms, options, std::move(measured.ballAreas), 0.0, progress, result);
    watch.stop("areas");
    return result;
}

Products measuresOfWhole()
{
    Products wanted;
    static_cast<KernelProducts&>(wanted) = measuresAlone();
    wanted.meshLabels = false;
    return wanted;
}

} // namespace molsurf
