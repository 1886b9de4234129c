// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/color/curvature_colors.h"
#include "molsurf/error.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/check_balls.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/interfaces.h"
#include "molsurf/surface/match_volume.h"
#include "molsurf/surface/parts.h"
#include "molsurf/surface/surface_run.h"
#include "molsurf/surface/unit_run.h"

namespace molsurf
{

namespace
{

/// The surface of all balls.
MolecularSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                          WarmStart* warm)
{
    SurfaceRun run(atoms, options, Scope(), progress);
    run.density();
    run.flow(warm);
    run.distance();
    run.spline();
    run.levelSet();
    run.mesh();
    if (run.fillCavities()) {
        run.spline();
        run.levelSet();
        run.mesh();
    }
    run.measure();
    run.curvatures();
    run.describeCurvature();
    run.takeClosedForm();
    run.grids();
    run.freeFields();
    run.labels();
    return run.finish();
}

} // namespace

MolecularSurface makeSurface(const std::vector<Ball>& balls, const SurfaceOptions& options,
                             Progress* progress)
{
    BallSet atoms;
    atoms.balls = balls;
    return makeSurface(atoms, options, progress);
}

MolecularSurface makeSurface(const BallSet& atoms, const SurfaceOptions& options,
                             Progress* listener, WarmStart* warm)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    checkOptions(options);
    if (options.matchVolume && !atoms.resolutions.empty()) {
        BallSet matched = atoms;
        SurfaceOptions once = options;
        once.matchVolume = false;
        progress.update("match", 0.0);
        matchVolumes(matched, once, progress);
        return makeSurface(matched, once, &progress, warm);
    }
    checkBalls(atoms.balls, options, Pieces::One, availableMemory());
    const bool whole = !options.split && options.surfaceOf.empty();
    if ((!whole || options.interfaces) && (!atoms.labels || atoms.labels->groups.empty())) {
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
    }
    const char* shown = hasField(options.fields, "Cd") ? curvatureNameOf(options.color) : nullptr;
    const bool helps = shown && !hasField(options.fields, shown);
    SurfaceOptions wanted = options;
    if (helps) wanted.fields.push_back(shown);
    MolecularSurface result;
    if (atoms.unit) {
        result = runUnit(inSpatialOrder(atoms), wanted, progress);
    } else if (whole) {
        result = runWhole(inSpatialOrder(atoms), wanted, progress, warm);
    } else {
        result = runParts(atoms, wanted, progress);
    }
    if (shown) addCurvatureColors(options.color, !helps, result.mesh, result.fields);
    Report& report = result.report;
    report.atoms = atoms.unit ? atoms.unit->balls * atoms.instances.size() : atoms.balls.size();
    report.voxel = options.voxel;
    if (atoms.beads > 0) report.coarse = CoarseReport{atoms.beads, atoms.beadAtoms};
    for (const ResolutionGroup& group : atoms.resolutions) {
        report.resolutions.push_back(
            {group.rule.select, group.rule.resolution, group.balls, group.level});
    }
    if (options.interfaces) measureInterfaces(atoms, options, progress, report);
    if (options.halfFloats) {
        if (result.surface) result.surface->setSaveFloatAsHalf(true);
        for (const auto& field : result.fields) field->setSaveFloatAsHalf(true);
    }
    return result;
}

} // namespace molsurf
