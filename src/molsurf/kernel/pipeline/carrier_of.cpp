// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/carrier_of.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/smooth_level_function.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf
{

std::vector<double> slopesOf(const std::vector<Ball>& balls, const GaussianOptions& options,
                             const std::vector<Decay>& decays)
{
    std::vector<double> slopes; // psi = C (R^2 - r^2) has the slope 2 C R at r = R
    slopes.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const double R = balls[i].radius + options.probe;
        const bool own = !decays.empty() && decays[i].rate > 0.0f;
        slopes.push_back(2.0 * R * (own ? double(decays[i].rate) : options.rate(R)));
    }
    return slopes;
}

// The mean of the balls' slopes s_i, at each voxel weighted by their terms e_i of the sum. As psi
// is ln sum e_i, the mean is most exp(psi' - psi), where psi' has the terms e_i s_i / most: levels
// raised by ln(s_i / most).
SlopeField slopeField(const BallModel& model, const SurfaceSpec& spec,
                      const std::optional<GaussianExtent>& extent, const PsiOnLeaves& psi,
                      const Bumps& bumps, const Progress& progress)
{
    const LeafTable& table = psi.table;
    GaussianOptions gaussian = gaussianOptions(spec);
    std::vector<Decay> decays = hasFlow(spec.kind) ? model.decays : std::vector<Decay>();
    const std::vector<double> slopes = slopesOf(model.balls, gaussian, decays);
    const auto ends = std::minmax_element(slopes.begin(), slopes.end());
    const double least = *ends.first, most = *ends.second;
    if (most - least < 1e-4 * most) return SlopeField(float(most));
    gaussian.extent = extent ? extent : extentOf(model.balls, gaussian, decays);
    decays.resize(model.balls.size());
    for (std::size_t i = 0; i < slopes.size(); ++i)
        decays[i].level += float(std::log(slopes[i] / most));
    GaussianSum sum(model.balls, gaussian, decays);
    sum.setBumps(bumps);
    LeafField field = sum.evaluate(table, progress).values;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        float* value = field.leaf(n); // of the weighted sum; then the slope
        const float* own = psi.values.leaf(n);
        for (int v = 0; v < leafSize; ++v)
            value[v] =
                std::clamp(float(most) * std::exp(value[v] - own[v]), float(least), float(most));
    });
    return SlopeField(std::move(field));
}

SparseField carrierOf(const BallModel& model, const SurfaceSpec& spec,
                      const std::optional<GaussianExtent>& extent, const NarrowBand& band,
                      const Bumps& bumps, const Progress& progress)
{
    const SlopeField slope =
        slopeField(model, spec, extent, {band.phi.table, band.psi}, bumps, progress);
    const EvolveOptions& evolution = spec.evolution;
    const bool valley = hasFlow(spec.kind) && evolution.regularizer == Regularizer::Gradient;
    return smoothCarrier(band.phi,
                         {band.psi, slope, !hasFlow(spec.kind), valley ? evolution.lambda : 0.0},
                         bandWidthVox * band.phi.voxelSize, progress);
}

} // namespace molsurf
