// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/analysis/measures/smooth_gradients.h"
#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_forces.h"
#include "molsurf/kernel/balls/boundary_check.h"
#include "molsurf/kernel/balls/power_cells.h"
#include "molsurf/kernel/mesh/check_arrays.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

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

namespace
{

BallGradients closedGradients(const std::vector<Ball>& balls, const SurfaceSpec& spec,
                              const Progress& progress)
{
    const BallBoundary boundary = ballBoundary(balls, probeOf(spec), progress);
    const BoundaryMeasure measure = checkedMeasure(boundary, progress);
    const double probe = offsetOf(spec);
    if (probe == 0.0) return unionGradients(boundary, measure, balls.size());
    const ExcludedMeasure excluded = measureExcluded(boundary, measure, probe, false, progress);
    return excludedGradients(boundary, measure, excluded.pulls, probe, balls.size());
}

/// Refuses surfaces that do not follow the atoms smoothly.
void checkGradients(const BallSet& atoms, const SurfaceSpec& spec)
{
    const char* wrong = spec.fillCavities         ? "without `fillCavities`"
                        : spec.minThickness > 0.0 ? "without `minThickness`"
                                                  : nullptr;
    if (wrong) throw Error(ErrorKind::Usage, std::string("forces: expected a surface ") + wrong);
    if (isGaussian(rowOf(spec.kind)))
        throw Error(ErrorKind::Usage, "forces: expected `surface` variational, ses, sas, vdw or "
                                      "smooth-sas, got gaussian");
    if (hasFlow(spec.kind) && !restsInClosedForm(spec))
        throw Error(ErrorKind::Usage, "forces: expected a surface that rests in closed form: "
                                      "`lambda` at most 0.024, without `flow` and `steps`");
    if (!atoms.placement.isWhole())
        throw Error(ErrorKind::Usage,
                    "forces: expected all atoms, without `bySymmetry` and `instances`");
}

} // namespace

MolecularSurface::Gradients surfaceGradients(const BallSet& atoms, const SurfaceSpec& spec,
                                             const Mesh& mesh, const Progress& progress)
{
    checkGradients(atoms, spec);
    if (atoms.balls.empty()) return {};
    checkFinite(atoms.balls);
    checkArrays(mesh);
    if (!isUnion(spec.kind) && mesh.normals.size() != mesh.positions.size())
        throw Error(ErrorKind::Usage, "forces: expected a mesh with normals");
    BallGradients found = isUnion(spec.kind) ? closedGradients(atoms.balls, spec, progress)
                                             : smoothGradients(atoms, spec, mesh, progress);
    return {std::move(found.volume), std::move(found.area), std::move(found.besideGap),
            std::move(found.besideRidge)};
}

} // namespace molsurf
