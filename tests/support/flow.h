// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages up to the evolved level set, as the pipeline joins them.

#include "molsurf/kernel/flow/equilibrium.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/flow/initial_surface.h"
#include "molsurf/kernel/flow/refine.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/spline/spline.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace molsurf::test
{

struct Evolved {
    NarrowBand band; ///< in closed form phi is the carrier
    EvolutionReport report;
    Spline spline; ///< of phi
};

/// The interface at rest in closed form.
/// @param[in] offset  that is added to the way from psi to its level, outward [Å]: 0 is rest
/// @param[out] last   null, or takes the ways to rest
inline Evolved restOf(const GaussianSum& field, SparseField psi, double epsilon,
                      const EvolveOptions& options, double offset, Displacements* last)
{
    const Progress progress;
    const Weights weights = weightsOf(options);
    const float slope = float(2.0 * M_LN2 / epsilon);
    const SlopeField slopes(slope);
    LeafField levels = levelsAtRest(psi, slopes, weights, progress);
    for (std::size_t n = 0; n < psi.table.size(); ++n)
        for (int v = 0; v < leafSize; ++v) levels.leaf(n)[v] -= float(offset) * slope;
    const Displacements ways = waysToRest(psi, {levels, slopes}, field, weights, {}, progress);
    if (last) *last = ways;
    Evolved out;
    checkConvergence(ways, options, psi.voxelSize, out.report);
    out.band.psi = copied(psi.values);
    carryLevels({levels, slopes}, bandWidthVox * psi.voxelSize, psi, progress);
    out.band.phi = std::move(psi);
    out.spline = {prefilter(out.band.phi, progress)};
    return out;
}

/// @param[out] last  null, or takes the displacements of the last step
inline Evolved evolveBalls(const std::vector<Ball>& balls, double epsilon, double voxel,
                           const EvolveOptions& options, Displacements* last = nullptr)
{
    GaussianOptions gaussian;
    gaussian.epsilon = epsilon;
    gaussian.voxelSize = voxel;
    gaussian.reach = (bandWidthVox + 1.5) * voxel;
    GaussianSum field(balls, gaussian);
    Progress progress;
    Evolved out;
    if (startsOnCoarserVoxels(options, voxel)) {
        const Evolved coarse = evolveBalls(balls, epsilon, 2.0 * voxel, coarseFlow(options));
        out.band.phi = refined(coarse.band.phi, openvdb::CoordBBox::inf(), progress);
        out.band.psi = field.evaluate(out.band.phi.table, progress).values;
    } else {
        if (restsInClosedForm(options))
            return restOf(field, field.band(restBandVox(voxel), progress), epsilon, options, 0.0,
                          last);
        SparseField psi = field.band(bandWidthVox, progress);
        out.band.phi =
            initialSurface(psi, bandWidthVox * voxel,
                           makesNewtonSteps(options) ? weightsOf(options) : Weights{}, progress);
        out.band.psi = std::move(psi.values);
    }
    const auto source = [&](const openvdb::Coord& origin, float* psi) {
        field.evaluate(origin, gaussian.reach, psi);
    };
    out.report = evolve(out.band, source, options, progress, {}, 0, last);
    out.spline = {prefilter(out.band.phi, progress)};
    return out;
}

} // namespace molsurf::test
