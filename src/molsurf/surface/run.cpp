// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/run.h"

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
#include "molsurf/surface/pockets.h"
#include "molsurf/surface/pore.h"
#include "molsurf/surface/surface_kind.h"
#include "molsurf/surface/tunnels.h"
#include "molsurf/surface/unit_mesh.h"
#include "molsurf/surface/unit_run.h"
#include "molsurf/surface/whole_only.h"
#include "molsurf/surface/whole_run.h"

#include <algorithm>
#include <utility>

namespace molsurf
{

namespace
{

/// Whether there are several prototypes, each of which has a surface of its own.
bool ofPrototypes(const BallSet& atoms)
{
    return atoms.placement.prototypes() > 1;
}

/// The surface that areas are of.
SurfaceSpec areasShown(const SurfaceOptions& options)
{
    return ofKind(options, options.areasOf.value_or(options.kind));
}

/// Areas of atoms on a surface that is made only to measure them.
std::vector<double> areasApart(const BallSet& atoms, const SurfaceSpec& spec, Progress& progress)
{
    if (!isClosedForm(spec)) {
        QuietProgress quiet(progress);
        Wanted wanted = measuresAlone();
        wanted.ballAreas = true;
        return runWhole(atoms, {spec, wanted}, quiet).areas;
    }
    std::vector<double> areas = measureClosedForm(atoms.balls, spec, progress).ballAreas;
    areas.resize(atoms.own());
    return areas;
}

/// Checks that groups and areas of atoms can be had.
void checkWanted(const BallSet& atoms, const SurfaceOptions& options)
{
    if ((options.ofParts() || options.interfaces || ofPrototypes(atoms)) &&
        (!atoms.labels || atoms.labels->groups.empty()))
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
    for (const auto& [asked, option] : {std::pair(atoms.pore.has_value(), "`pore`"),
                                        std::pair(atoms.tunnelsFrom.has_value(), "`tunnelsFrom`")})
        if (asked && !atoms.placement.isWhole())
            throw Error(ErrorKind::Usage,
                        std::string(option) +
                            ": expected one surface, and not `instances` or `bySymmetry`");
    if (wantsPockets(options) && ofPrototypes(atoms))
        throw Error(ErrorKind::Usage, "`pockets`: expected one surface, and not `instances`");
    if (!options.ballAreas) return;
    checkWay(ByAtom, options);
    if (ofPrototypes(atoms))
        throw Error(ErrorKind::Usage, "areas of atoms: expected one surface, and not `split`");
    if (atoms.placement.unit && !isBoundary(areasShown(options)))
        throw Error(ErrorKind::Usage, "areas of atoms by symmetry: expected a surface in "
                                      "closed form [hint: `surface` sas or vdw]");
}

WholeSurface run(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    if (atoms.placement.unit) return {runUnit(inSpatialOrder(atoms), options, progress), {}};
    if (!options.grid) return runWithoutGrid(atoms, options, progress);
    if (options.ofParts() || ofPrototypes(atoms)) return {runParts(atoms, options, progress), {}};
    return runWhole(atoms, options, progress);
}

/// Makes the surface. If a grid shows its colours and these are of a curvature, the grid of that is
/// made, too, and Cd of it; one that was not asked for (`helps`) is taken out again.
WholeSurface colored(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const bool asked = std::any_of(options.fields.begin(), options.fields.end(),
                                   [](auto& name) { return findField(name)->ofColors; });
    const char* shown = asked ? curvatureNameOf(options.color) : nullptr;
    if (!shown) return run(atoms, options, progress);
    const bool helps = !hasField(options.fields, shown);
    Wanted wanted = options;
    if (helps) wanted.fields.push_back(shown);
    WholeSurface made = run(atoms, {options, wanted}, progress);
    openvdb::GridPtrVec colors, &fields = made.surface.fields;
    if (hasField(options.fields, "Cd"))
        colors = curvatureColors(options.color, atoms.coloring, made.surface.mesh, fields);
    if (helps) {
        const auto isShown = [&](auto& grid) { return grid->getName().rfind(shown, 0) == 0; };
        fields.erase(std::remove_if(fields.begin(), fields.end(), isShown), fields.end());
    }
    fields.insert(fields.end(), colors.begin(), colors.end());
    return made;
}

/// Describes what the surface was made of.
void describeAtoms(const BallSet& atoms, Report& report)
{
    report.atoms = atoms.whole();
    if (atoms.beads > 0) report.coarse = Report::Coarse{atoms.beads, atoms.beadAtoms};
    for (const ResolutionGroup& group : atoms.resolutions) {
        report.resolutions.push_back(
            {group.rule.select, group.rule.resolution, group.balls, group.level});
    }
}

/// Makes the surface of balls whose levels are matched.
MolecularSurface make(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    checkBalls(atoms.balls, options, Pieces::One, availableMemory());
    checkWanted(atoms, options);
    WholeSurface made = colored(atoms, options, progress);
    MolecularSurface& result = made.surface;
    describeAtoms(atoms, result.report);
    if (const std::string text = packingWarning(atoms.balls); !text.empty())
        result.report.warnings.push_back(text);
    result.report.voxel = options.voxel;
    const SurfaceSpec shown = areasShown(options);
    if (options.ballAreas || options.contacts || options.interfaces)
        result.report.areasOf = nameOf(shown.kind);
    if (options.ballAreas)
        result.ballAreas = shown.kind == options.kind && !made.areas.empty()
                               ? std::move(made.areas)
                               : areasApart(atoms, shown, progress);
    if (options.interfaces)
        measureInterfaces(atoms, shown, options.ballAreas, progress, result.report);
    if (wantsPockets(options)) addPockets(atoms, options, progress, result);
    if (atoms.pore) addPore(atoms, progress, result.report);
    if (atoms.tunnelsFrom) addTunnels(atoms, options, progress, result.report);
    if (options.contacts) result.contacts = contactAreas(atoms.balls, probeOf(shown), progress);
    if (options.halfFloats) saveAsHalf(result.grids());
    return std::move(result);
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
    if (!options.matchVolume || atoms.resolutions.empty()) return make(atoms, options, progress);
    BallSet matched = atoms;
    progress.update("match", 0.0);
    matchVolumes(matched, options, progress);
    return make(matched, options, progress);
}

} // namespace molsurf
