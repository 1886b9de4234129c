// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/run.h"

#include "molsurf/balls/placed_ball.h"
#include "molsurf/color/curvature_colors.h"
#include "molsurf/color/palette.h"
#include "molsurf/core/quiet_progress.h"
#include "molsurf/error.h"
#include "molsurf/selection/subset.h"
#include "molsurf/surface/check_balls.h"
#include "molsurf/surface/closed_form.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/interfaces.h"
#include "molsurf/surface/label_surface.h"
#include "molsurf/surface/match_volume.h"
#include "molsurf/surface/parts.h"
#include "molsurf/surface/pose_error.h"
#include "molsurf/surface/surface_kind.h"
#include "molsurf/surface/surface_run.h"
#include "molsurf/surface/unit_mesh.h"
#include "molsurf/surface/unit_run.h"
#include "molsurf/surface/whole_only.h"

#include <algorithm>
#include <utility>

namespace molsurf
{

namespace
{

/// The surface of all balls.
MolecularSurface runWhole(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    SurfaceRun run(atoms, options, Scope(), progress);
    run.toMesh();
    run.measure();
    run.curvatures();
    run.describeCurvature();
    run.integrateCurvature();
    run.takeClosedForm();
    run.grids();
    run.freeFields();
    run.labels();
    return run.finish();
}

/// What is known of the surface of all balls in closed form.
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
    result.ballAreas = std::move(measured.ballAreas);
    if (atoms.labels && atoms.labels->values)
        result.ballValues.assign(atoms.labels->values->valueOf.begin(),
                                 atoms.labels->values->valueOf.end());
    labelSurface(atoms, options, 0.0, progress, result);
    watch.stop("areas");
    return result;
}

/// The surface of all balls, which are computed in spatial order.
MolecularSurface runInOrder(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const BallSet ordered = inSpatialOrder(atoms);
    MolecularSurface result = runWhole(ordered, options, progress);
    if (dependsOnPose(options)) estimatePoseError(ordered, options, progress, result.report);
    if (!options.ballAreas) result.ballAreas.clear(); // known for groups
    if (result.ballAreas.empty()) return result;
    const std::vector<std::int32_t> order = spatialOrder(atoms.balls);
    for (std::vector<double>* values : {&result.ballAreas, &result.ballValues}) {
        std::vector<double> back(values->size());
        for (std::size_t i = 0; i < values->size(); ++i) back[std::size_t(order[i])] = (*values)[i];
        *values = std::move(back);
    }
    return result;
}

/// Areas of atoms on a surface that is made for them alone.
std::vector<double> areasApart(const BallSet& atoms, const SurfaceOptions& options,
                               Progress& progress)
{
    if (atoms.placement.unit && !isBoundary(options))
        throw Error(ErrorKind::Usage, "areas of atoms by symmetry: expected a surface in "
                                      "closed form [hint: `surface` sas or vdw]");
    if (!isClosedForm(options)) {
        QuietProgress quiet(progress);
        return makePrototypes(atoms, options, &quiet).ballAreas;
    }
    std::vector<double> areas = measureClosedForm(atoms.balls, options, progress).ballAreas;
    areas.resize(atoms.own());
    return areas;
}

/// Adds what is known of balls and groups: areas, contacts, interfaces.
void addAreas(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
              MolecularSurface& result)
{
    if (!options.ballAreas && !options.contacts && !options.interfaces) return;
    SurfaceOptions shown = options;
    shown.kind = options.areasOf.value_or(options.kind);
    shown.areasOf.reset();
    result.report.areasOf = nameOf(shown.kind);
    if (options.ballAreas && (shown.kind != options.kind || result.ballAreas.empty())) {
        SurfaceOptions alone = shown;
        alone.fields.clear();
        alone.contacts = alone.interfaces = alone.curvatureTotals = false;
        result.ballAreas = areasApart(atoms, alone, progress);
    }
    if (options.interfaces) measureInterfaces(atoms, shown, progress, result.report);
    if (options.contacts) result.contacts = contactAreas(atoms.balls, probeOf(shown), progress);
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
                             Progress* progress)
{
    MolecularSurface result = makePrototypes(atoms, options, progress);
    if (atoms.placement.isWhole()) return result;
    const Progress nobody;
    result.mesh = meshOfWhole(atoms, result, progress ? *progress : nobody);
    result.shared.clear();
    return result;
}

MolecularSurface makePrototypes(const BallSet& atoms, const SurfaceOptions& options,
                                Progress* listener)
{
    Progress nobody;
    Progress& progress = listener ? *listener : nobody;
    checkOptions(options);
    checkColors(atoms, options.color);
    if (options.matchVolume && !atoms.resolutions.empty()) {
        BallSet matched = atoms;
        SurfaceOptions once = options;
        once.matchVolume = false;
        progress.update("match", 0.0);
        matchVolumes(matched, once, progress);
        return makePrototypes(matched, once, &progress);
    }
    if (atoms.placement.prototypes() > 1 && !options.split) {
        SurfaceOptions each = options;
        each.split = true;
        return makePrototypes(atoms, each, &progress);
    }
    checkBalls(atoms.balls, options, Pieces::One, availableMemory());
    if ((options.ofParts() || options.interfaces) &&
        (!atoms.labels || atoms.labels->groups.empty())) {
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
    }
    const bool colored = std::any_of(options.fields.begin(), options.fields.end(),
                                     [](auto& name) { return findField(name)->ofColors; });
    const char* shown = colored ? curvatureNameOf(options.color) : nullptr;
    const bool helps = shown && !hasField(options.fields, shown);
    SurfaceOptions wanted = options;
    if (helps) wanted.fields.push_back(shown);
    const bool valued = atoms.labels && atoms.labels->values; // means of values need areas
    if (options.areasOf.value_or(options.kind) != options.kind && !valued) wanted.ballAreas = false;
    MolecularSurface result;
    if (options.ballAreas) checkWay(ByAtom, options);
    if (atoms.placement.unit) {
        wanted.ballAreas = false;
        result = runUnit(inSpatialOrder(atoms), wanted, progress);
    } else if (!options.grid) {
        result = runWithoutGrid(atoms, wanted, progress);
    } else if (options.ofParts()) {
        result = runParts(atoms, wanted, progress);
    } else {
        result = runInOrder(atoms, wanted, progress);
    }
    openvdb::GridPtrVec colors;
    if (shown && hasField(options.fields, "Cd"))
        colors = curvatureColors(options.color, atoms.coloring, result.mesh, result.fields);
    if (helps) {
        const auto isShown = [&](auto& grid) { return grid->getName().rfind(shown, 0) == 0; };
        result.fields.erase(std::remove_if(result.fields.begin(), result.fields.end(), isShown),
                            result.fields.end());
    }
    result.fields.insert(result.fields.end(), colors.begin(), colors.end());
    Report& report = result.report;
    report.atoms = atoms.whole();
    report.voxel = options.voxel;
    if (atoms.beads > 0) report.coarse = CoarseReport{atoms.beads, atoms.beadAtoms};
    for (const ResolutionGroup& group : atoms.resolutions) {
        report.resolutions.push_back(
            {group.rule.select, group.rule.resolution, group.balls, group.level});
    }
    addAreas(atoms, options, progress, result);
    if (options.halfFloats) saveAsHalf(result.grids());
    return result;
}

} // namespace molsurf
