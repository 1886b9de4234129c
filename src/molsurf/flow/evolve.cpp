// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/evolve.h"

#include "molsurf/error.h"
#include "molsurf/flow/newton_step.h"
#include "molsurf/flow/paper_step.h"
#include "molsurf/flow/settle.h"
#include "molsurf/levelset/reinitialize.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace molsurf
{

namespace
{

/// The length over which a step of the surface smooths: of the gradient regulariser, whatever the
/// slope of psi is; of the other one at a slope of 1/Å, and less than that where it is steeper [Å].
double stiffLength(const EvolveOptions& options)
{
    return std::sqrt(0.5 * options.lambda);
}

/// Whether fronts move far: with a large lambda the surface gains energy by closing pockets and
/// gaps from their ends, like a soap film.
bool hasFronts(const EvolveOptions& options)
{
    constexpr double noticeable = 0.15; // [Å]
    return stiffLength(options) > noticeable;
}

int sweepsFor(const EvolveOptions& options, double voxelSize)
{
    const double sweeps = std::ceil(3.0 * stiffLength(options) / voxelSize) + 2.0;
    return int(std::min(sweeps, 8.0));
}

/// How many times the options' tolerance is meant [voxel]: above 0.5 Å the stencils' error of the
/// curvature, which grows as h^2, moves the interface by a way that grows as h in voxels.
double coarseness(double voxelSize)
{
    constexpr double fine = 0.5; // [Å]
    return std::max(1.0, voxelSize / fine);
}

/// Adds the sums of an interface to a report.
/// @throws Error(ErrorKind::Numeric) if they are not finite, or nothing is left of a whole surface
void record(const InterfaceSums& sums, bool whole, EvolutionReport& report)
{
    const std::string where = "evolve: step " + std::to_string(report.steps);
    if (!std::isfinite(sums.energy))
        throw Error(ErrorKind::Numeric, where + ": the energy is not a number");
    if (sums.area == 0.0 && whole)
        throw Error(ErrorKind::Numeric,
                    where + ": nothing is left of the surface [hint: a smaller `lambda`]");
    report.energy.push_back(sums.energy);
    report.area.push_back(sums.area);
    report.volume.push_back(sums.volume);
    report.unresolvedGapVoxels = sums.unresolvedGaps;
}

/// The paper's scheme, on a whole surface.
EvolutionReport evolveAsPaper(NarrowBand& band, const PsiSource& source,
                              const EvolveOptions& options, Progress& progress)
{
    const double h = band.phi.voxelSize;
    const bool fixed = options.steps.has_value();
    const int maxSteps = options.steps.value_or(options.maxSteps.value_or(defaultPaperSteps));
    EvolutionReport report;
    LeafField next(band.phi.table.size());
    for (;;) {
        double moved = 0.0;
        const InterfaceSums sums =
            paperStep(band, weightsOf(options), options.splineLevel, next, moved, progress);
        record(sums, true, report);
        report.converged = double(sums.maxSpeed) < paperSpeed;
        if ((report.converged && !fixed) || report.steps == maxSteps) break;
        report.meanDisplacement.push_back(moved * h);
        report.maxSpeed.push_back(sums.maxSpeed);
        ++report.steps;
        progress.update("evolve", double(report.steps) / maxSteps);
        std::swap(band.phi.values, next);
        reinitialize(band.phi, bandWidthVox * h, 1, progress, next);
        updateBand(band, source, openvdb::CoordBBox::inf(), next, progress);
    }
    return report;
}

/// How many times the tolerance the displacements are to be below it: one step alone does not tell
/// how fast they shrink.
double rmsFactor(const EvolutionReport& report)
{
    return report.steps > 1 ? 1.0 : 4.0;
}

/// Lets the fronts that a flow has left move to rest.
void settleFronts(NarrowBand& band, const PsiSource& source, const NewtonOptions& steps,
                  const NewtonSteps& newton, EvolutionReport& report, Progress& progress)
{
    constexpr float calm = 0.3f, eager = 0.2f; // of a voxel: so far voxels go to and fro in gaps
    const float limit = (steps.eager ? eager : calm) * float(coarseness(band.phi.voxelSize));
    std::vector<float> largest(band.phi.table.size(), 0.0f);
    for (std::size_t n = 0; n < newton.table().size(); ++n)
        largest[std::size_t(band.phi.table.find(newton.table().origin(n)))] = newton.largest()[n];
    const Settling settling = settle(band, source, steps, std::move(largest), limit, progress);
    if (settling.steps > 0) { // the rims of what moved fit what stood beside it
        LeafField next(band.phi.table.size());
        for (int i = 0; i < 2; ++i) {
            reinitialize(band.phi, bandWidthVox * band.phi.voxelSize, 1, progress, next,
                         Repair::Errors);
            updateBand(band, source, openvdb::CoordBBox::inf(), next, progress);
        }
    }
    report.frontSteps = settling.steps;
    report.restlessFronts = settling.awake;
}

} // namespace

Weights weightsOf(const EvolveOptions& options)
{
    const float lambda = float(options.lambda);
    return options.regularizer == Regularizer::Gradient ? Weights{lambda, 0.0f}
                                                        : Weights{0.0f, lambda};
}

bool makesNewtonSteps(const EvolveOptions& options)
{
    return options.flow == Flow::Newton && options.steps != 0 && options.maxSteps != 0;
}

bool decidesGaps(const EvolveOptions& options)
{
    return makesNewtonSteps(options) && !hasFronts(options);
}

bool startsOnCoarserVoxels(const EvolveOptions& options, double voxelSize)
{
    return makesNewtonSteps(options) && hasFronts(options) && 2.0 * voxelSize <= coarseVoxel &&
           options.splineLevel == 0;
}

EvolveOptions coarseFlow(const EvolveOptions& options, double voxelSize)
{
    constexpr double tolerance = 0.006; // what still moves there takes many steps of finer voxels
    constexpr int maxSteps = 100;
    EvolveOptions coarse = options;
    coarse.tolerance = std::min(tolerance / coarseness(voxelSize), options.tolerance);
    coarse.steps.reset();
    coarse.maxSteps = maxSteps;
    return coarse;
}

EvolutionReport evolve(NarrowBand& band, const PsiSource& source, const EvolveOptions& options,
                       Progress& progress, const Region& region, int halo, Displacements* last)
{
    if (options.flow == Flow::Paper) return evolveAsPaper(band, source, options, progress);
    const double h = band.phi.voxelSize;
    const bool fixed = options.steps.has_value();
    const int maxSteps = options.steps.value_or(options.maxSteps.value_or(defaultSteps));
    const bool mayGiveUp = !options.maxSteps; // who asks for steps gets them
    const bool eager = hasFronts(options);
    const int reinitializations = eager ? 2 : 1; // long steps spoil the distance
    const NewtonOptions steps{weightsOf(options), sweepsFor(options, h), eager,
                              options.splineLevel};
    NewtonSteps newton(steps);

    EvolutionReport report;
    LeafField next(band.phi.table.size());
    std::vector<double> rms, tails;
    while (report.steps < maxSteps) {
        Displacements moves;
        const InterfaceSums sums = newton.step(band, region, next, moves, progress);
        record(sums, region.whole(), report);
        report.meanDisplacement.push_back(moves.meanStep() * h);
        report.maxSpeed.push_back(sums.maxSpeed);
        ++report.steps;
        progress.update("evolve", double(report.steps) / maxSteps);
        std::swap(band.phi.values, next);
        reinitialize(band.phi, bandWidthVox * h, reinitializations, progress, next, Repair::Errors);
        updateBand(band, source, region.grown(halo), next, progress);

        // The step that was solved for is made.
        judge(moves, options, h, report);
        if (last) *last = moves;
        rms.push_back(report.displacementRms);
        tails.push_back(report.displacementTail);
        if (!fixed && (report.converged || (mayGiveUp && stalled(rms, tails, report)))) break;
    }
    if (!fixed && region.whole() && report.converged)
        settleFronts(band, source, steps, newton, report, progress);
    record(newton.sums(band, region, progress), region.whole(), report);
    return report;
}

bool stalled(const std::vector<double>& rms, const std::vector<double>& tails,
             const EvolutionReport& report)
{
    constexpr std::size_t steps = 8;
    constexpr double change = 1e-3; // relative, of area and volume
    if (tails.size() <= steps) return false;
    const auto falls = [](const std::vector<double>& values) {
        const auto recent = values.end() - steps;
        return *std::min_element(recent, values.end()) <
               0.9 * *std::min_element(values.begin(), recent);
    };
    const auto changes = [](const std::vector<double>& values) {
        const auto [low, high] = std::minmax_element(values.end() - steps, values.end());
        return *high - *low > change * *high;
    };
    return !falls(rms) && !falls(tails) && !changes(report.area) && !changes(report.volume);
}

void judge(const Displacements& last, const EvolveOptions& options, double voxelSize,
           EvolutionReport& report)
{
    report.displacementRms = last.rms() * voxelSize;
    report.displacementTail = last.quantile(0.999) * voxelSize;
    report.unsettledShare = last.shareAbove(0.1);
    const double tolerance = options.tolerance * coarseness(voxelSize);
    report.converged = rmsFactor(report) * last.rms() < tolerance &&
                       last.quantile(0.999) < std::max(tailOfTolerance * tolerance, tailOfGrid);
}

double toleranceOf(const EvolutionReport& report, double voxelSize)
{
    return std::max(rmsFactor(report) * report.displacementRms,
                    report.displacementTail / tailOfTolerance) /
           (voxelSize * coarseness(voxelSize));
}

} // namespace molsurf
