// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/run.h"

#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/surface/match_volume.h"
#include "molsurf/surface/parts.h"
#include "molsurf/surface/product_table.h"
#include "molsurf/surface/unit_mesh.h"
#include "molsurf/surface/unit_run.h"
#include "molsurf/surface/whole_run.h"

#include <utility>

namespace molsurf
{

namespace
{

MolecularSurface run(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const bool parts = options.ofParts() || atoms.placement.prototypes() > 1;
    if (atoms.placement.unit && !parts) return runUnit(inSpatialOrder(atoms), options, progress);
    if (!options.grid) return runWithoutGrid(atoms, options, progress);
    if (parts) return runParts(atoms, options, progress);
    return runWhole(atoms, options, progress);
}

/// The copies of the parts of a mesh that motions make.
std::vector<Report::Copy> copiesOf(const Placement& placement, const Mesh& mesh)
{
    std::vector<Report::Copy> copies;
    for (const Instance& instance : placement.instances) {
        for (const std::size_t part : partsOfCopy(placement, mesh, instance)) {
            Report::Copy& copy = copies.emplace_back();
            copy.part = part;
            copy.name = instance.name;
            for (std::size_t row = 0; row < 3; ++row) {
                const auto& r = instance.rotation[row];
                copy.matrix[row] = {r[0], r[1], r[2], instance.translation[int(row)]};
            }
            copy.matrix[3] = {0.0, 0.0, 0.0, 1.0};
        }
    }
    return copies;
}

/// Describes what the surface was made of, and by which program.
void describeRun(const BallSet& atoms, const Mesh& mesh, Report& report)
{
    report.version = MOLSURF_VERSION;
    report.atoms = atoms.whole();
    const SelectionRecord& record = atoms.record;
    report.input = record.input;
    report.instances = copiesOf(atoms.placement, mesh);
    if (record.beads > 0) report.coarse = Report::Coarse{record.beads, record.beadAtoms};
    for (const ResolutionGroup& group : atoms.resolutions) {
        report.resolutions.push_back(
            {group.rule.select, group.rule.resolution, group.balls, group.level});
    }
}

/// Makes the surface of balls whose levels are matched.
MolecularSurface make(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    checkBalls(atoms.balls, options, options.grid ? Pieces::One : Pieces::NoGrid,
               availableMemory());
    checkProducts(atoms, options);
    MolecularSurface result = run(atoms, options, progress);
    describeRun(atoms, result.mesh, result.report);
    if (const std::string text = packingWarning(atoms.balls); !text.empty())
        result.report.warnings.push_back(text);
    result.report.voxel = options.voxel;
    makeProducts(atoms, options, progress, result);
    if (!needsOf(atoms, options).levelSet) result.surface.reset();
    for (const auto& grid : result.grids()) grid->setCreator("vdb_molsurf " MOLSURF_VERSION);
    return result;
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
    MolecularSurface result = makeUnitSurface(atoms, options, progress);
    if (atoms.placement.isWhole()) return result;
    const Progress nobody;
    result.mesh = meshOfWhole(atoms, result, progress ? *progress : nobody);
    result.shared.clear();
    return result;
}

MolecularSurface makeUnitSurface(const BallSet& atoms, const SurfaceOptions& options,
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
