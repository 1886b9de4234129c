// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/evolve.h"

#include "molsurf/error.h"
#include "molsurf/kernel/flow/interface_motion.h"
#include "molsurf/kernel/flow/newton_step.h"
#include "molsurf/kernel/flow/paper_step.h"
#include "molsurf/kernel/flow/relax_fronts.h"
#include "molsurf/kernel/levelset/reinitialize.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace molsurf
{

namespace
{

/// Of the interface of a protein, the root mean square of its mean curvature [1/Å].
constexpr double interfaceCurvature = 0.5;

/// The length over which a step of the surface smooths: of the gradient regulariser, whatever the
/// slope of psi is; of the other one at a slope of 1/Å, and less than that where it is steeper [Å].
double stiffLength(const EvolveOptions& options)
{
    return std::sqrt(0.5 * options.lambda);
}

/// Whether the surface gains energy by closing pockets and gaps from their ends, like a soap film:
/// fronts then move on when all else rests.
bool hasFronts(const EvolveOptions& options)
{
    constexpr double noticeable = 0.11; // [Å]
    return stiffLength(options) > noticeable;
}

/// Whether fronts move so far that they, and not gaps as psi decides them, make the topology.
bool frontsDecide(const EvolveOptions& options)
{
    constexpr double far = 0.15; // [Å]
    return stiffLength(options) > far;
}

int sweepsFor(const EvolveOptions& options, double voxelSize)
{
    const double sweeps = std::ceil(3.0 * stiffLength(options) / voxelSize) + 2.0;
    return int(std::min(sweeps, 8.0));
}

/// How many times as coarse as half an Å voxels are, 1 at least: the stencils' error of the
/// curvature grows as h^2, and moves the interface by a way that grows as h in voxels.
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
        reinitialize(band.phi, {bandWidthVox * h, 1}, progress, next);
        updateBand(band, source, openvdb::CoordBBox::inf(), next, progress);
    }
    return report;
}

/// The root mean square of the ways in a step and the way of 99.9 % of the interface at rest
/// [voxel].
struct Rest {
    double rms, tail;
};

/// How many steps as long as the last one are allowed for in the options' tolerance: from one step
/// it is not known how fast they shrink, and fronts go on for some steps.
double stepsToRest(const EvolveOptions& options, const EvolutionReport& report)
{
    if (report.steps <= 1) return 4.0;
    return hasFronts(options) ? 3.0 : 1.0;
}

/// Bounds of the last step of a report; no flow comes nearer to rest than the noise of
/// its grid.
Rest restOf(const EvolveOptions& options, double voxelSize, const EvolutionReport& report)
{
    constexpr double noise = 0.001; // [voxel]
    const double coarse = coarseness(voxelSize);
    const double rms =
        std::max(options.tolerance / stepsToRest(options, report), noise * coarse * coarse);
    return {rms, std::max(tailOfTolerance * rms, tailOfGrid * coarse)};
}

/// Fronts move alone once 99 % of the interface move by less than this in a step [voxel]. After so
/// many of their steps evolve() lets none move alone again; the last settle() may go beyond.
constexpr double calmBulk = 0.08;
constexpr int mostFrontSteps = 240;

/// Lets the fronts that a flow has left move to rest, while the rest of the interface stays.
/// @param[in] motion  of the last step
/// @return whether a leaf still moved, so that settle() made steps
bool settleFronts(NarrowBand& band, const PsiSource& source, const NewtonOptions& steps,
                  const InterfaceMotion& motion, EvolutionReport& report, Progress& progress)
{
    constexpr float frontWay = 0.2f; // of an interface that moves, in the last step [voxel]
    const float limit = frontWay * float(coarseness(band.phi.voxelSize));
    // The band may have gained leaves since that step, so that they are found by their places.
    std::vector<float> largest(band.phi.table.size(), 0.0f);
    for (std::size_t n = 0; n < motion.table().size(); ++n)
        largest[std::size_t(band.phi.table.find(motion.table().origin(n)))] = motion.largest()[n];
    const Settling settling = settle(band, source, steps, std::move(largest), limit, progress);
    if (settling.steps > 0) {
        // Leaves that moved end beside leaves that did not: repair the distance across the borders.
        LeafField next(band.phi.table.size());
        for (int i = 0; i < 2; ++i) {
            reinitialize(band.phi, {bandWidthVox * band.phi.voxelSize, 1, Repair::Errors}, progress,
                         next);
            updateBand(band, source, openvdb::CoordBBox::inf(), next, progress);
        }
    }
    report.frontSteps += settling.steps;
    report.restlessFronts = settling.awake;
    return settling.steps > 0;
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
    return options.flow != Flow::Paper && options.steps != 0 && options.maxSteps != 0;
}

bool restsInClosedForm(const EvolveOptions& options)
{
    return options.flow == Flow::Rest && makesNewtonSteps(options) && !options.steps &&
           options.splineLevel == 0 && !hasFronts(options);
}

bool decidesGaps(const EvolveOptions& options)
{
    return makesNewtonSteps(options) && !frontsDecide(options);
}

bool startsOnCoarserVoxels(const EvolveOptions& options, double voxelSize)
{
    return makesNewtonSteps(options) && frontsDecide(options) && 2.0 * voxelSize <= coarseVoxel &&
           options.splineLevel == 0;
}

EvolveOptions coarseFlow(const EvolveOptions& options)
{
    constexpr double tolerance = 0.006; // what still moves there takes many steps of finer voxels
    constexpr int maxSteps = 100;
    EvolveOptions coarse = options;
    coarse.tolerance = std::min(tolerance, options.tolerance);
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
    const bool fronts = hasFronts(options);
    const NewtonOptions steps{weightsOf(options), sweepsFor(options, h), frontsDecide(options),
                              options.splineLevel};
    NewtonSteps newton(steps);

    EvolutionReport report;
    LeafField before;
    std::vector<double> rms, tails;
    while (report.steps < maxSteps) {
        const InterfaceSums sums = newton.step(band, region, before, progress);
        record(sums, region.whole(), report);
        report.maxSpeed.push_back(sums.maxSpeed);
        ++report.steps;
        progress.update("evolve", double(report.steps) / maxSteps);
        InterfaceMotion motion(newton.table(), region, h);
        reinitialize(band.phi, {bandWidthVox * h, steps.repairs(), Repair::Errors, motion.watch()},
                     progress, before);
        updateBand(band, source, region.grown(halo), before, progress);

        const Displacements moved = motion.sum();
        report.meanDisplacement.push_back(moved.mean() * h);
        judge(moved, options, h, report);
        if (last) *last = moved;
        rms.push_back(report.displacementRms);
        tails.push_back(report.displacementTail);
        if (fixed) continue;
        if (fronts && region.whole() && report.frontSteps < mostFrontSteps &&
            moved.quantile(0.99) < calmBulk &&
            settleFronts(band, source, steps, motion, report, progress)) {
            newton = NewtonSteps(steps);
            rms.clear();
            tails.clear();
            continue;
        }
        if (report.converged || (mayGiveUp && stalled(rms, tails, report))) break;
    }
    before = LeafField(); // its memory serves the sums
    record(newton.sums(band, region, progress), region.whole(), report);
    estimateAreaError(options, report);
    return report;
}

void estimateAreaError(const EvolveOptions& options, EvolutionReport& report)
{
    // The change of the area is the integral of curvature times way. Ways of opposite signs cancel
    // in that of a step, and need not in those that follow.
    const std::size_t n = report.area.size();
    if (n < 2 || report.area[n - 1] == 0.0) return;
    const double change = std::abs(1.0 - report.area[n - 2] / report.area[n - 1]);
    report.areaError = stepsToRest(options, report) *
                       std::max(change, interfaceCurvature * report.displacementRms);
}

namespace
{

/// Whether coarse voxels hold no interface that is nearer to rest than this one. A chord from voxel
/// to voxel lies h^2 H / 8 inside of an arc of curvature H. Two interfaces that part the same
/// voxels cross the same cells, and are no farther apart than the diagonal of one; a quantile is
/// known to an eighth.
bool isAllThatVoxelsHold(const Displacements& ways, double voxelSize)
{
    constexpr double coarse = 0.75; // voxels from which on chords count [Å]
    if (voxelSize <= coarse) return false;
    const double sag = voxelSize * voxelSize * interfaceCurvature / 8.0;
    const double diagonal = std::sqrt(3.0) * voxelSize;
    return ways.rms() * voxelSize < sag && ways.quantile(0.999) * voxelSize < 1.125 * diagonal;
}

} // namespace

void checkConvergence(const Displacements& ways, const EvolveOptions& options, double voxelSize,
                      EvolutionReport& report)
{
    // measured: vdb_molsurf FILE --lambda 0.02 -o x.json of 1CRN, 4AT1, 1A8O, 4HHB, 1EHZ, 1AOI and
    // 1HZH, voxels of 0.25 to 2 Å: up to 0.017 h^2 [1/Å] and 0.005 Å, and 0.1 Å at the tail.
    constexpr double lengthOfTolerance = 2.0, fine = 1.0; // [Å]
    const double coarse = std::max(1.0, voxelSize / fine);
    const double unit = lengthOfTolerance * coarse * coarse;
    report.displacementRms = ways.rms() * voxelSize;
    report.displacementTail = ways.quantile(0.999) * voxelSize;
    report.unsettledShare = ways.shareAbove(0.1);
    report.areaError = interfaceCurvature * report.displacementRms;
    report.toleranceMet =
        std::max(report.displacementRms, report.displacementTail / tailOfTolerance) / unit;
    const bool asked = options.tolerance < EvolveOptions().tolerance; // nearer than by default
    report.converged =
        report.toleranceMet < options.tolerance || (!asked && isAllThatVoxelsHold(ways, voxelSize));
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
    const Rest rest = restOf(options, voxelSize, report);
    report.converged = last.rms() < rest.rms && last.quantile(0.999) < rest.tail;
    report.toleranceMet =
        stepsToRest(options, report) * std::max(last.rms(), last.quantile(0.999) / tailOfTolerance);
}

} // namespace molsurf
