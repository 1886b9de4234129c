// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/closed_form.h"

#include "molsurf/kernel/balls/excluded_measure.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

namespace molsurf
{

namespace
{

/// The bounds of meshTolerance() with the creases and faces of the solvent-excluded surface. Toric
/// and concave faces bend by the probe radius. A contact face of a ball of radius r = R - probe has
/// the share (r/R)^2 of the area A of its patch, so its A/r is A r/R^2.
MeshTolerance excludedTolerance(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                const ExcludedMeasure& excluded, double probe, double voxel)
{
    const ExcludedAreas areas = excluded.totalAreas();
    double bends = (areas.toric + areas.concave) / probe;
    for (std::size_t p = 0; p < boundary.patches.size(); ++p) {
        const double R = boundary.patches[p].radius, r = R - probe;
        bends += measure.patchAreas[p] * r / (R * R);
    }
    const double creases = 2.0 * (excluded.creaseLength + cuspLengthOf(boundary, probe));
    return {voxel * (creases + 1.5 * bends), 0.4 * voxel * voxel * (creases + bends)};
}

} // namespace

bool isMeasured(const SurfaceSpec& spec)
{
    // A cavity of the mesh may be open to the outside where probes touch each other.
    const bool filled = spec.fillCavities && offsetOf(spec) > 0.0;
    return isClosedForm(spec) && !filled;
}

ClosedForm measureClosedForm(const BallBoundary& boundary, const SurfaceSpec& spec,
                             std::size_t areasOf, const Progress& progress)
{
    BoundaryMeasure measure = checkedMeasure(boundary, progress);
    ClosedForm out;
    const double probe = offsetOf(spec);
    if (probe == 0.0) {
        if (areasOf > 0) out.ballAreas = areasOfBalls(boundary, measure, areasOf);
        out.tolerance = meshTolerance(boundary, measure, spec.voxel);
        out.pieces = std::move(measure.pieces);
        return out;
    }
    ExcludedMeasure excluded = measureExcluded(boundary, measure, probe, areasOf > 0, progress);
    if (areasOf > 0) out.ballAreas = areasOfBalls(boundary, excluded, areasOf);
    out.cuspLength = cuspLengthOf(boundary, probe);
    out.tolerance = excludedTolerance(boundary, measure, excluded, probe, spec.voxel);
    out.pieces = std::move(excluded.pieces);
    out.topologyKnown = excluded.topologyKnown;
    return out;
}

ClosedForm measureClosedForm(const std::vector<Ball>& balls, const SurfaceSpec& spec,
                             const Progress& progress)
{
    if (balls.empty()) return {};
    checkFinite(balls);
    return measureClosedForm(ballBoundary(balls, probeOf(spec), progress), spec, balls.size(),
                             progress);
}

double cuspLengthOf(const BallBoundary& boundary, double probe)
{
    double length = 0.0;
    for (const Arc& arc : boundary.arcs)
        if (arc.radius < probe) length += 2.0 * arc.half * arc.radius;
    return length;
}

} // namespace molsurf
