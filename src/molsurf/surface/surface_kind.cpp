// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/surface_kind.h"

#include "molsurf/error.h"
#include "molsurf/flow/evolve.h"

#include <algorithm>
#include <string>

namespace molsurf
{

bool isUnion(SurfaceKind kind)
{
    return kind != SurfaceKind::Variational && kind != SurfaceKind::Gaussian;
}

double offsetOf(const SurfaceOptions& options)
{
    return options.kind == SurfaceKind::Variational || options.kind == SurfaceKind::SolventExcluded
               ? options.probe
               : 0.0;
}

double grownBy(const SurfaceOptions& options)
{
    return options.kind == SurfaceKind::VanDerWaals ? 0.0 : options.probe;
}

bool isClosedForm(const SurfaceOptions& options)
{
    return isUnion(options.kind) && options.minWall == 0.0;
}

bool isBoundary(const SurfaceOptions& options)
{
    return isClosedForm(options) && offsetOf(options) == 0.0;
}

bool hasClosedForm(const SurfaceOptions& options)
{
    return isClosedForm(options) && !options.split && options.surfaceOf.empty() &&
           !options.fillCavities && options.fields.empty() && !options.curvatureTotals;
}

double splineWidthOf(const SurfaceOptions& options)
{
    return splineWidthVox * options.voxel * (1 << options.splineLevel);
}

BandWidths widthsOf(const SurfaceOptions& options)
{
    const double width = splineWidthOf(options), offset = offsetOf(options);
    const double grown = 0.5 * options.minWall;
    return {offset + width + grown, std::max(width - offset, options.voxel) + grown};
}

void failNothingLeft(const char* stage, SurfaceKind kind)
{
    throw Error(ErrorKind::Numeric, std::string(stage) +
                                        ": nothing of the molecule is left at this resolution" +
                                        (kind == SurfaceKind::Variational
                                             ? " [hint: a smaller `voxel`, `lambda` or `epsilon`]"
                                             : " [hint: a smaller `voxel`]"));
}

GaussianOptions gaussianOptions(const SurfaceOptions& options)
{
    // Stencils reach a voxel beyond the band, along diagonals.
    const double h = options.voxel, reach = (bandWidthVox + 1.5) * h;
    if (options.kind == SurfaceKind::Gaussian) return {0.0, 0.0, options.blobbiness, h, reach};
    return {options.probe, options.epsilon, 0.0, h, reach};
}

} // namespace molsurf
