// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/surface_kind.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/flow/equilibrium.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/levelset/round_ridges.h"

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

const char* nameOf(Regularizer regularizer)
{
    return regularizer == Regularizer::Gradient ? "gradient" : "area";
}

const char* nameOf(Flow flow)
{
    return flow == Flow::Rest ? "rest" : flow == Flow::Newton ? "newton" : "paper";
}

const KindRow& rowOf(SurfaceKind kind)
{
    return kindTable()[std::size_t(kind)];
}

const char* nameOf(SurfaceKind kind)
{
    return rowOf(kind).word;
}

std::string kindMeant(const std::string& typed)
{
    std::string word = lowered(typed);
    if (const std::size_t end = word.rfind("surface"); end != std::string::npos && end > 1)
        word.resize(end - 1); // "vdw-surface"
    const std::string other =
        meaningOf(word, {{"connolly ms msms excluded molecular solvent-excluded edtsurf", "ses"},
                         {"sasa accessible solvent-accessible asa lee-richards", "sas"},
                         {"vdws van-der-waals vanderwaals spacefill cpk spheres", "vdw"},
                         {"gauss quicksurf blob blobby metaball metaballs", "gaussian"},
                         {"smooth skin default tms", "variational"},
                         {"mesh triangles", "-o FILE.ply, the mesh of any kind"}});
    if (!other.empty()) return meant(other) + " (more hints: vdb_molsurf help surface)";
    std::vector<std::string> words;
    for (const KindRow& row : kindTable()) words.push_back(row.word);
    return didYouMean(word, words);
}

double probeOf(const SurfaceSpec& spec)
{
    return rowOf(spec.kind).hasProbe ? spec.probe : 0.0;
}

double offsetOf(const SurfaceSpec& spec)
{
    return rowOf(spec.kind).hasOffset ? spec.probe + spec.inset : 0.0;
}

bool isClosedForm(const SurfaceSpec& spec)
{
    return isUnion(spec.kind) && spec.minThickness == 0.0;
}

bool isBoundary(const SurfaceSpec& spec)
{
    return isClosedForm(spec) && offsetOf(spec) == 0.0;
}

double splineWidthOf(const SurfaceSpec& spec)
{
    return splineWidthVox * spec.voxel * (1 << spec.splineLevel);
}

BandWidths widthsOf(const SurfaceSpec& spec)
{
    const double width = splineWidthOf(spec), offset = offsetOf(spec);
    const double grown = 0.5 * spec.minThickness;
    return {offset + width + grown, std::max(width - offset, spec.voxel) + grown};
}

double growthOf(const SurfaceSpec& spec)
{
    const KindRow& row = rowOf(spec.kind);
    return row.isUnion || !row.hasOffset ? probeOf(spec) : 0.0;
}

std::vector<Ball> asMeshed(std::vector<Ball> balls, const SurfaceSpec& spec)
{
    for (Ball& ball : balls) ball.radius += growthOf(spec);
    return balls;
}

void failNothingLeft(const char* stage, SurfaceKind kind)
{
    throw Error(ErrorKind::Numeric,
                std::string(stage) + ": nothing of the molecule is left at this resolution" +
                    (hasFlow(kind) ? " [hint: a smaller `voxel`, `lambda` or `epsilon`]"
                                   : " [hint: a smaller `voxel`]"));
}

bool maybeTooCoarse(const std::vector<Ball>& balls, const SurfaceSpec& spec)
{
    // Random molecules with voxels up to 0.7 radii come out whole.
    return spec.voxel > 0.7 * double(largestRadius(balls));
}

void failIfTooCoarse(const std::string& what, const std::vector<Ball>& balls,
                     const SurfaceSpec& spec)
{
    const double radius = double(largestRadius(balls));
    if (balls.empty() || spec.voxel <= radius) return;
    constexpr double smallest = 0.05; // voxel that can be asked for [Å]
    const std::string hint =
        0.5 * radius >= smallest ? formatted(" [hint: a `voxel` of %.2g]", 0.5 * radius) : "";
    throw Error(ErrorKind::Numeric,
                what.substr(0, what.find(" [hint")) +
                    formatted(": voxels of %.3g Å are too large for the balls", spec.voxel) + hint);
}

EvolveOptions flowOptions(const SurfaceSpec& spec)
{
    EvolveOptions evolution = spec.evolution;
    evolution.splineLevel = spec.splineLevel;
    // The closed form is at rest to 0.005 Å, and to 0.017 h^2 [1/Å] on voxels up to 1 Å, where the
    // tolerance stands for 2 Å: checkConvergence(). What asks for more gets steps.
    constexpr double finest = 0.0025, byVoxel = 0.0085; // the latter [1/Å^2]
    const double voxel = std::min(1.0, spec.voxel);
    const double least = std::max(finest, byVoxel * voxel * voxel);
    if (evolution.flow == Flow::Rest && evolution.tolerance < least) evolution.flow = Flow::Newton;
    return evolution;
}

bool restsInClosedForm(const SurfaceSpec& spec)
{
    return hasFlow(spec.kind) && restsInClosedForm(flowOptions(spec));
}

int psiBandVox(const SurfaceSpec& spec)
{
    return restsInClosedForm(spec) ? restBandVox(spec.voxel) : bandWidthVox;
}

std::optional<GapRule> gapRuleOf(const SurfaceSpec& spec)
{
    if (!hasFlow(spec.kind) || !decidesGaps(spec.evolution)) return {};
    const Weights weights = weightsOf(spec.evolution);
    return GapRule{weights.gradient, weights.area};
}

bool decidesWalls(const SurfaceSpec& spec)
{
    constexpr double leastOffset = 1.5; // [voxel]
    return hasFlow(spec.kind) && decidesGaps(spec.evolution) &&
           offsetOf(spec) >= leastOffset * spec.voxel && ridgeReach(spec.voxel) > 0;
}

SurfaceSpec ofKind(SurfaceSpec spec, SurfaceKind kind)
{
    spec.kind = kind;
    return spec;
}

SurfaceSpec withVoxel(SurfaceSpec spec, double voxel)
{
    spec.voxel = voxel;
    return spec;
}

KernelProducts measuresAlone()
{
    KernelProducts products;
    products.energy = false;
    products.needs.levelSet = products.needs.statistics = products.needs.passages = false;
    return products;
}

GaussianOptions gaussianOptions(const SurfaceSpec& spec)
{
    // Stencils reach a voxel beyond the band, along diagonals.
    const double h = spec.voxel;
    const double reach = (psiBandVox(spec) + 1.5) * h;
    if (isGaussian(rowOf(spec.kind))) return {0.0, 0.0, spec.blobbiness, h, reach};
    return {spec.probe, spec.epsilon, 0.0, h, reach};
}

} // namespace molsurf
