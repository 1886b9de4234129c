// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/balls/ball_forces.h"
#include "molsurf/balls/boundary_check.h"
#include "molsurf/balls/power_cells.h"
#include "molsurf/error.h"
#include "molsurf/surface/check_balls.h"
#include "molsurf/surface/surface_kind.h"

#include <string>
#include <utility>

namespace molsurf
{

namespace
{

/// Smaller facets come of rounding, where cells of more than four balls meet [Å^2].
constexpr double leastContact = 1e-6;

} // namespace

std::vector<double> exposedAreas(const std::vector<Ball>& balls, double probe,
                                 const Progress& progress)
{
    if (balls.empty()) return {};
    checkFinite(balls);
    const BallBoundary boundary = ballBoundary(balls, probe, progress);
    return areasOfBalls(boundary, checkedMeasure(boundary, progress), balls.size());
}

std::vector<ContactArea> contactAreas(const std::vector<Ball>& balls, double probe,
                                      const Progress& progress)
{
    checkFinite(balls);
    std::vector<Ball> grown = balls;
    for (Ball& ball : grown) ball.radius += probe;
    std::vector<ContactArea> out;
    for (const PowerFacet& facet : powerFacets(grown, progress)) {
        if (facet.area < leastContact) continue;
        out.push_back({{std::size_t(facet.balls[0]), std::size_t(facet.balls[1])},
                       facet.area,
                       facet.distance});
    }
    return out;
}

MolecularSurface::Gradients surfaceGradients(const std::vector<Ball>& balls,
                                             const SurfaceSpec& spec, const Progress& progress)
{
    if (!isClosedForm(spec))
        throw Error(ErrorKind::Usage, std::string("forces: expected `surface` ses, sas or vdw") +
                                          (spec.minWall > 0.0 ? " without `minWall`" : ", got ") +
                                          (spec.minWall > 0.0 ? "" : nameOf(spec.kind)));
    if (spec.fillCavities)
        throw Error(ErrorKind::Usage, "forces: expected a surface without `fillCavities`");
    if (balls.empty()) return {};
    checkFinite(balls);
    const BallBoundary boundary = ballBoundary(balls, probeOf(spec), progress);
    const BoundaryMeasure measure = checkedMeasure(boundary, progress);
    const double probe = offsetOf(spec);
    BallGradients found =
        probe == 0.0
            ? unionGradients(boundary, measure, balls.size())
            : excludedGradients(boundary, measure,
                                measureExcluded(boundary, measure, probe, false, progress).pulls,
                                probe, balls.size());
    return {std::move(found.volume), std::move(found.area)};
}

} // namespace molsurf
