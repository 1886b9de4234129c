// SPDX-License-Identifier: MPL-2.0
#include "molsurf/evolution/speed.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

// Where the speed acts, in voxels: fully up to `inner`, not at all beyond `outer`.
constexpr float inner = 1.5f, outer = 2.25f;

// Fraction of a Newton step, and the longest step in voxels: an interface that moves less than half
// a voxel cannot jump over a voxel.
constexpr float relaxation = 0.8f, longestStep = 0.4f;

// The part of the stiffness that keeps explicit diffusion stable, and the one that keeps it
// positive where the metric is flat [1/Å^2].
constexpr float diffusion = 1.0f / 0.12f, leastStiffness = 0.02f;

/// cos(pi t) for |t| <= 1, error below 2e-5: 1 - 2 sin^2(pi t/2) by Taylor.
inline __attribute__((always_inline)) float cosPi(float t)
{
    const float x = 1.57079633f * t, x2 = x * x;
    const float s =
        x * (1.0f + x2 * (-1.0f / 6.0f +
                          x2 * (1.0f / 120.0f + x2 * (-1.0f / 5040.0f + x2 * (1.0f / 362880.0f)))));
    return 1.0f - 2.0f * s * s;
}

/// The values of a step at each voxel of a leaf, before they are summed; rows without an active
/// voxel stay unset.
struct LeafStep {
    alignas(64) float weight[leafSize];       // delta(phi) |grad phi| [1/Å]
    alignas(64) float w[leafSize];            // metric
    alignas(64) float displacement[leafSize]; // of the interface, outward negative [Å]
    alignas(64) float speed[leafSize];        // F [1/Å]
    alignas(64) float stiffness[leafSize];    // P [1/Å^2]
};

MOLSURF_KERNEL void stepRows(const float* __restrict phiBlock, const float* __restrict psiBlock,
                             const LeafCurvature& __restrict shape, const LeafMask& active, float h,
                             const Weights weights, const StepSize size, LeafStep& __restrict out,
                             float* __restrict next)
{
    using Block = LeafBlock<float, 1>;
    const float inverse = 1.0f / h, limit = longestStep * h;
    const float newton = size.preconditioned ? relaxation : 0.0f;
    const float time = size.preconditioned ? 0.0f : size.time;
    for (int row = 0; row < 64; ++row) {
        if (active.row(row) == 0) continue;
        const int first = (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        const float *p = phiBlock + first, *q = psiBlock + first;
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float phi = p[z];
            const Derivatives d = derivatives<1>(q + z, inverse);
            const Metric m = metricAtFoot(q[z], d, shape.normal[0][v], shape.normal[1][v],
                                          shape.normal[2][v], phi, weights);

            // Principal curvatures k at the voxel are k/(1 - k phi) at the foot. The denominator is
            // kept positive where the level set is not resolved.
            const float k = clamped(shape.mean[v], -2.0f * inverse, 2.0f * inverse);
            const float K = clamped(shape.gauss[v], -inverse * inverse, 0.25f * k * k);
            const float denominator = larger(1.0f - k * phi + K * phi * phi, 0.2f);
            const float kappa = (k - 2.0f * K * phi) / denominator;

            const float F = m.w * kappa + m.normal;
            const float P = m.second + leastStiffness + diffusion * m.w * inverse * inverse;
            const float step = clamped(newton * F / P + time * F, -limit, limit);

            const float distance = std::abs(phi) * inverse;
            const float t = clamped((distance - inner) / (outer - inner), 0.0f, 1.0f);
            const float cutoff = 1.0f - t * t * (3.0f - 2.0f * t);
            next[v] = phi + cutoff * shape.slope[v] * step;

            const float u = smaller(distance / 1.5f, 1.0f);
            const float delta = (1.0f + cosPi(u)) * (inverse / 3.0f) * shape.slope[v];
            out.weight[v] = u < 1.0f ? delta : 0.0f;
            out.w[v] = m.w;
            out.displacement[v] = step;
            out.speed[v] = F;
            out.stiffness[v] = P;
        }
    }
}

} // namespace

StepSums& StepSums::operator+=(const StepSums& other)
{
    energy += other.energy;
    area += other.area;
    volume += other.volume;
    displacement += other.displacement;
    maxSpeed = std::max(maxSpeed, other.maxSpeed);
    maxSecond = std::max(maxSecond, other.maxSecond);
    crevices += other.crevices;
    return *this;
}

StepSums flowStep(const LeafBlock<float, 1>& phi, const LeafBlock<float, 1>& psi,
                  const LeafCurvature& shape, const LeafMask& active, const openvdb::Vec3d& corner,
                  float voxel, const Weights& weights, const StepSize& size, float* next)
{
    LeafStep step;
    stepRows(phi.values, psi.values, shape, active, voxel, weights, size, step, next);

    (~active).forEach([&](int v) { next[v] = *phi.at(v >> 6, v >> 3 & 7, v & 7); });
    LeafMask near;
    active.forEach([&](int v) { near.set(v, step.weight[v] > 0.0f); });

    StepSums sums;
    const double h3 = double(voxel) * voxel * voxel;
    near.forEach([&](int v) {
        const float value = *phi.at(v >> 6, v >> 3 & 7, v & 7);
        const double weight = h3 * step.weight[v];
        const openvdb::Vec3d x = corner + double(voxel) * openvdb::Vec3d(v >> 6, v >> 3 & 7, v & 7);
        const openvdb::Vec3d n(shape.normal[0][v], shape.normal[1][v], shape.normal[2][v]);
        sums.energy += weight * step.w[v];
        sums.area += weight;
        sums.volume += weight * (x - double(value) * n).dot(n) / 3.0;
        sums.displacement += weight * std::abs(step.displacement[v]);
        if (std::abs(value) >= voxel) return;
        sums.maxSpeed = std::max(sums.maxSpeed, std::abs(step.speed[v]));
        sums.maxSecond = std::max(sums.maxSecond, step.stiffness[v]);
        sums.crevices += shape.slope[v] < 0.5f;
    });
    return sums;
}

} // namespace molsurf
