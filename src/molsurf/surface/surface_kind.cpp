// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/surface_kind.h"

#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/flow/evolve.h"
#include "molsurf/flow/rest.h"
#include "molsurf/levelset/round_ridges.h"
#include "molsurf/surface/whole_only.h"

#include <algorithm>
#include <string>

namespace molsurf
{

const std::vector<KindRow>& kindTable()
{
    using K = SurfaceKind;
    static const std::vector<KindRow> table = {
        // union, flow, probe, offset
        {K::Variational, "variational", "", false, true, true, true},
        {K::SolventExcluded, "ses", "solvent-excluded", true, false, true, true},
        {K::SolventAccessible, "sas", "solvent-accessible", true, false, true, false},
        {K::VanDerWaals, "vdw", "van der Waals", true, false, false, false},
        {K::Gaussian, "gaussian", "", false, false, false, false},
        {K::SmoothAccessible, "smooth-sas", "variational, where sas is", false, true, true, false}};
    return table;
}

const KindRow& rowOf(SurfaceKind kind)
{
    return kindTable()[std::size_t(kind)];
}

const char* nameOf(SurfaceKind kind)
{
    return rowOf(kind).word;
}

double probeOf(const SurfaceOptions& options)
{
    return rowOf(options.kind).hasProbe ? options.probe : 0.0;
}

double offsetOf(const SurfaceOptions& options)
{
    return rowOf(options.kind).hasOffset ? options.probe : 0.0;
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
    return missingIn(InClosedForm, options).empty();
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

double growthOf(const SurfaceOptions& options)
{
    const KindRow& row = rowOf(options.kind);
    return row.isUnion || !row.hasOffset ? probeOf(options) : 0.0;
}

double outwardOf(const SelectOptions::Coloring& coloring, const SurfaceOptions& options)
{
    const bool out = rowOf(options.kind).hasProbe && !rowOf(options.kind).hasOffset; // already
    return coloring.outward.value_or(out ? 0.0 : options.probe);
}

std::vector<Ball> asMeshed(std::vector<Ball> balls, const SurfaceOptions& options)
{
    for (Ball& ball : balls) ball.radius += growthOf(options);
    return balls;
}

void failNothingLeft(const char* stage, SurfaceKind kind)
{
    throw Error(ErrorKind::Numeric,
                std::string(stage) + ": nothing of the molecule is left at this resolution" +
                    (hasFlow(kind) ? " [hint: a smaller `voxel`, `lambda` or `epsilon`]"
                                   : " [hint: a smaller `voxel`]"));
}

void failIfTooCoarse(const std::string& what, const std::vector<Ball>& balls,
                     const SurfaceOptions& options)
{
    // Of random molecules those with voxels up to 0.7 radii come out whole.
    const double radius = double(largestRadius(balls));
    if (balls.empty() || options.voxel <= radius) return;
    constexpr double smallest = 0.05; // voxel that can be asked for [Å]
    const std::string hint =
        0.5 * radius >= smallest ? formatted(" [hint: a `voxel` of %.2g]", 0.5 * radius) : "";
    throw Error(ErrorKind::Numeric,
                what.substr(0, what.find(" [hint")) +
                    formatted(": voxels of %.3g Å are too large for the balls", options.voxel) +
                    hint);
}

EvolveOptions flowOptions(const SurfaceOptions& options)
{
    EvolveOptions evolution = options.evolution;
    evolution.splineLevel = options.splineLevel;
    return evolution;
}

bool restsInClosedForm(const SurfaceOptions& options)
{
    return hasFlow(options.kind) && restsInClosedForm(flowOptions(options));
}

int psiBandVox(const SurfaceOptions& options)
{
    return restsInClosedForm(options) ? restBandVox(options.voxel) : bandWidthVox;
}

bool decidesWalls(const SurfaceOptions& options)
{
    constexpr double leastOffset = 1.5; // [voxel]
    return hasFlow(options.kind) && decidesGaps(options.evolution) &&
           offsetOf(options) >= leastOffset * options.voxel && ridgeReach(options.voxel) > 0;
}

GaussianOptions gaussianOptions(const SurfaceOptions& options)
{
    // Stencils reach a voxel beyond the band, along diagonals.
    const double h = options.voxel;
    const double reach = (psiBandVox(options) + 1.5) * h;
    if (isGaussian(rowOf(options.kind))) return {0.0, 0.0, options.blobbiness, h, reach};
    return {options.probe, options.epsilon, 0.0, h, reach};
}

} // namespace molsurf
