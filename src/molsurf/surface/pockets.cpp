// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/pockets.h"

#include "molsurf/core/words.h"
#include "molsurf/pockets/find_pockets.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/surface_run.h"

namespace molsurf
{

void addPockets(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                MolecularSurface& result)
{
    Stopwatch watch(result.report);
    progress.update("pockets", 0.0);
    const Wanted::PocketRule& asked = options.pocket;
    if (options.voxel > 0.5 * asked.probeIn)
        result.report.warnings.push_back(
            formatted("`voxel` %g: pockets that are narrow are lost on voxels above half of "
                      "`probeIn` [hint: `voxel` %g]",
                      options.voxel, 0.5 * asked.probeIn));
    Pockets found = findPockets(atoms.balls, asked, options.voxel, atoms.pocketAt, progress);
    result.report.pockets = PocketsReport{asked.probeIn, asked.probeOut, asked.cut,
                                          asked.neck,    options.voxel,  std::move(found.list)};
    const openvdb::GridPtrVec grids = {found.ids, found.depths};
    for (const auto& grid : grids)
        if (hasField(options.fields, grid->getName())) result.fields.push_back(grid);
    watch.stop("pockets");
}

} // namespace molsurf
