// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/speed.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

// Where the speed acts, in voxels: fully up to `inner`, not at all beyond `outer`.
constexpr float inner = 1.5f, outer = float(flowWidthVox);

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

/// Sums over the voxels of a leaf near the interface, by their place in the row.
struct RowSums {
    alignas(64) float area[8] = {};         // delta(phi) |grad phi| h^3: the weight [Å^2]
    alignas(64) float energy[8] = {};       // weighted metric
    alignas(64) float normal[3][8] = {};    // weighted normal
    alignas(64) float along[8] = {};        // weighted n.(x - phi n), x from the leaf's first voxel
    alignas(64) float displacement[8] = {}; // weighted size of the step
    alignas(64) float speed[8] = {};        // largest F [1/Å]
    alignas(64) float stiffness[8] = {};    // largest P [1/Å^2]
    alignas(64) float unresolvedGaps[8] = {};
};

double sumOf(const float* values)
{
    double sum = 0.0;
    for (int z = 0; z < 8; ++z) sum += values[z];
    return sum;
}

MOLSURF_KERNEL void stepRows(const float* __restrict phiBlock, const float* __restrict psiBlock,
                             const LeafCurvature& __restrict shape, const LeafMask& active, float h,
                             const Weights weights, const StepSize size, RowSums& __restrict sums,
                             float* __restrict next)
{
    using Block = LeafBlock<float, 1>;
    const float inverse = 1.0f / h, limit = longestStep * h, h3 = h * h * h;
    const float newton = size.preconditioned ? relaxation : 0.0f;
    const float time = size.preconditioned ? 0.0f : size.time;
    for (int row = 0; row < 64; ++row) {
        const int bits = active.row(row);
        const int first = (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        const float *p = phiBlock + first, *q = psiBlock + first;
        if (bits == 0) {
            for (int z = 0; z < 8; ++z) next[8 * row + z] = p[z];
            continue;
        }
        const float x = h * float(row / 8), y = h * float(row % 8);
        for (int z = 0; z < 8; ++z) {
            const int v = 8 * row + z;
            const float phi = p[z];
            const float nx = shape.normal[0][v], ny = shape.normal[1][v], nz = shape.normal[2][v];
            const Derivatives d = derivatives<1>(q + z, inverse);
            const Metric m = metricAtFoot(q[z], d, nx, ny, nz, phi, weights);

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
            const float on = bits & rowBits[z] ? 1.0f : 0.0f;
            next[v] = phi + on * cutoff * shape.slope[v] * step;

            const float u = smaller(distance / 1.5f, 1.0f);
            const float delta = (1.0f + cosPi(u)) * (inverse / 3.0f) * shape.slope[v];
            const float near = u < 1.0f ? on : 0.0f, close = distance < 1.0f ? on : 0.0f;
            const float weight = near * h3 * delta;
            sums.area[z] += weight;
            sums.energy[z] += weight * m.w;
            sums.normal[0][z] += weight * nx;
            sums.normal[1][z] += weight * ny;
            sums.normal[2][z] += weight * nz;
            const float along = x * nx + y * ny + h * float(z) * nz - phi;
            sums.along[z] += weight * along;
            sums.displacement[z] += weight * std::abs(step);
            sums.speed[z] = larger(sums.speed[z], close * std::abs(F));
            sums.stiffness[z] = larger(sums.stiffness[z], close * P);
            sums.unresolvedGaps[z] += shape.slope[v] < 0.5f ? close : 0.0f;
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
    unresolvedGaps += other.unresolvedGaps;
    return *this;
}

StepSums flowStep(const LeafBlock<float, 1>& phi, const LeafBlock<float, 1>& psi,
                  const LeafCurvature& shape, const LeafMask& active, const openvdb::Vec3d& corner,
                  float voxel, const Weights& weights, const StepSize& size, float* next)
{
    RowSums rows;
    stepRows(phi.values, psi.values, shape, active, voxel, weights, size, rows, next);
    StepSums sums;
    sums.area = sumOf(rows.area);
    sums.energy = sumOf(rows.energy);
    const openvdb::Vec3d normal(sumOf(rows.normal[0]), sumOf(rows.normal[1]),
                                sumOf(rows.normal[2]));
    sums.volume = (corner.dot(normal) + sumOf(rows.along)) / 3.0;
    sums.displacement = sumOf(rows.displacement);
    sums.maxSpeed = *std::max_element(rows.speed, rows.speed + 8);
    sums.maxSecond = *std::max_element(rows.stiffness, rows.stiffness + 8);
    sums.unresolvedGaps = std::size_t(sumOf(rows.unresolvedGaps));
    return sums;
}

} // namespace molsurf
