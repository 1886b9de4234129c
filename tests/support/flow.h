// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The stages up to the evolved level set, as the pipeline joins them.

#include "molsurf/flow/evolve.h"
#include "molsurf/flow/initial_surface.h"
#include "molsurf/flow/refine.h"
#include "molsurf/levelset/gaussian_sum.h"
#include "molsurf/spline/spline.h"

#include <utility>
#include <vector>

namespace molsurf::test
{

struct Evolved {
    NarrowBand band;
    EvolutionReport report;
    Spline spline; ///< of phi
};

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
