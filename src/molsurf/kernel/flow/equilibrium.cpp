// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/equilibrium.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/flow/edge_crossings.h"
#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/stencil.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

constexpr double restReach = 0.75; // [Å]

/// How far from its foot a voxel's derivatives give the level [Å]: up to there all stencils lie in
/// the band. The change to the flat level beyond shows in the curvature of fine voxels if it is
/// nearer, and in the energy of coarse ones if it is farther.
/// measured: final_energy of 1CRN, 1A8O, 4HHB, 4AT1, 1EHZ, lambda 0.003 to 0.02, 0.5 and 0.25 Å,
/// and mean_curvature of one atom at 0.5, 0.25 and 0.125 Å, with 0.5, 0.75 and 1 Å
double farFrom(double voxel)
{
    return std::max(voxel, std::min((restBandVox(voxel) - 1) * voxel, restReach));
}

/// The slope of psi counts for at least this share of that of a flat interface: in crevices psi is
/// flat, and nothing holds the interface there.
constexpr float leastSlopeShare = 0.2f;

// In crevices and on creases of psi the level is bounded: e^v, as times that of a flat interface,
// and the curvature that acts on it [1/Å].
constexpr double lowestLevel = 0.3, highestLevel = 2.0, sharpest = 3.0;

/// The curvature of the level set of a function, and m = n . Hess n, from its derivatives.
struct Bending {
    float curvature, second;
};

MOLSURF_INLINE Bending bendingOf(const Derivatives& d, float inverse)
{
    const float norm2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-12f;
    const float m = (d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                     2.0f * (d.x * d.y * d.xy + d.y * d.z * d.yz + d.x * d.z * d.xz)) /
                    norm2;
    const float k = (m - d.xx - d.yy - d.zz) / std::sqrt(norm2);
    return {clamped(k, -inverse, inverse), m};
}

/// The root e^v at a foot. With (1 + q') = `bottom` it is that of alpha e^2 - 2 beta e - gamma = 0.
MOLSURF_INLINE float rootAtFoot(float slope, float kappa, float m, const Weights& weights)
{
    const float q = weights.gradient * slope * slope;
    const float bottom = 1.0f + larger(q + weights.gradient * m, 0.0f);
    const float alpha = 2.0f * slope * bottom - kappa * (1.0f + q);
    const float beta = slope - kappa, gamma = kappa * (1.0f + weights.area);
    return (beta + std::sqrt(larger(beta * beta + alpha * gamma, 0.0f))) / larger(alpha, 0.5f);
}

/// levelsAtRest() for a leaf, without a mean: fixed-point iteration, twice, of the level and the
/// foot on it, where the derivatives of psi are taken to first order.
MOLSURF_KERNEL void levelRows(const float* __restrict block, const float* __restrict slopes,
                              float voxel, const Weights weights, float* __restrict levels)
{
    using Block = LeafBlock<float, 1>;
    constexpr float any = 1e30f; // level
    constexpr float limit = float(sharpest);
    const float near = float(farFrom(double(voxel)));
    const float inverse = 1.0f / voxel;
    for (int row = 0; row < 64; ++row) {
        const float* p =
            block + (row / 8 + 1) * Block::strideX + (row % 8 + 1) * Block::strideY + 1;
        for (int z = 0; z < 8; ++z) {
            const Derivatives d = derivatives<1>(p + z, inverse);
            const Bending bending = bendingOf(d, inverse);
            const float norm2 = d.x * d.x + d.y * d.y + d.z * d.z + 1e-12f, m = bending.second;
            const float root = std::sqrt(larger(norm2 - 2.0f * m * p[z], 0.25f * norm2));
            const float distance = -2.0f * p[z] / (std::sqrt(norm2) + root); // to psi = 0, outward
            const float scale = -1.0f / std::sqrt(norm2), k = bending.curvature;
            const float a = slopes[8 * row + z];
            const float bottom = 1.0f + weights.gradient * a * a, flat = -fastLog(bottom);
            const float leastSlope2 = leastSlopeShare * leastSlopeShare * a * a;
            float level = flat;
            for (int round = 0; round < 2; ++round) { // the second one at the foot of its level
                const float way = distance - level * scale, t = way * scale;
                const float x = d.x - t * (d.xx * d.x + d.xy * d.y + d.xz * d.z);
                const float y = d.y - t * (d.xy * d.x + d.yy * d.y + d.yz * d.z);
                const float w = d.z - t * (d.xz * d.x + d.yz * d.y + d.zz * d.z);
                const float kappa = clamped(k / larger(1.0f - 0.5f * k * way, 0.3f), -limit, limit);
                const float slope = std::sqrt(larger(x * x + y * y + w * w, leastSlope2));
                const float e = bottom * rootAtFoot(slope, kappa, m, weights);
                level = flat + fastLog(clamped(e, float(lowestLevel), float(highestLevel)));
            }
            // One voxel farther than `near` the level is that of a flat interface.
            const float off = clamped((std::abs(distance) - near) * inverse, 0.0f, 1.0f);
            const float mixed = level + off * off * (3.0f - 2.0f * off) * (flat - level);
            // At the rim stencils see no neighbours: no level there puts a voxel on the other side.
            const float half = 0.5f * p[z];
            const float low = distance > voxel ? half : -any, high = distance < -voxel ? half : any;
            levels[8 * row + z] = clamped(mixed, low, high); // nested choices would not vectorise
        }
    }
}

/// Means along the axes of a block, with the weights (w, 1 - 2 w, w).
/// @param[in,out] block  of a leaf; lost
MOLSURF_KERNEL void meanRows(float* __restrict block, float weight, float* __restrict out)
{
    using Block = LeafBlock<float, 1>;
    constexpr int dim = Block::dim, size = dim * dim * dim, X = Block::strideX, Y = Block::strideY;
    alignas(64) float mean[size];
    const float own = 1.0f - 2.0f * weight;
    for (int i = X; i < size - X; ++i)
        mean[i] = own * block[i] + weight * (block[i - X] + block[i + X]);
    for (int i = X + Y; i < size - X - Y; ++i)
        block[i] = own * mean[i] + weight * (mean[i - Y] + mean[i + Y]);
    for (int row = 0; row < 64; ++row) {
        const float* v = block + (row / 8 + 1) * X + (row % 8 + 1) * Y + 1;
        for (int z = 0; z < 8; ++z) out[8 * row + z] = own * v[z] + weight * (v[z - 1] + v[z + 1]);
    }
}

MOLSURF_KERNEL void carryRows(const float* __restrict levels, const float* __restrict slope,
                              float limit, float* __restrict psi)
{
    for (int v = 0; v < leafSize; ++v)
        psi[v] = clamped((levels[v] - psi[v]) / slope[v], -limit, limit);
}

/// Derivatives of v between two voxels.
PsiJet between(const Derivatives& a, const Derivatives& b, double t)
{
    const auto mean = [t](float from, float to) { return from + t * (to - from); };
    const double xy = mean(a.xy, b.xy), xz = mean(a.xz, b.xz), yz = mean(a.yz, b.yz);
    return {0.0,
            {mean(a.x, b.x), mean(a.y, b.y), mean(a.z, b.z)},
            {mean(a.xx, b.xx), xy, xz, xy, mean(a.yy, b.yy), yz, xz, yz, mean(a.zz, b.zz)}};
}

/// (w' + w kappa)/P where psi has this jet, on a level set of psi - v [Å].
/// @param[in] v      derivatives of v there
/// @param[in] slope  of a flat interface [1/Å]
double wayToRest(const PsiJet& psi, const PsiJet& v, double slope, const Weights& weights)
{
    const openvdb::Vec3d down = v.gradient - psi.gradient; // outward
    const openvdb::Mat3d H = v.hessian - psi.hessian;
    const double length = std::max(down.length(), 1e-6);
    const openvdb::Vec3d n = down / length;
    const double kappa = (H(0, 0) + H(1, 1) + H(2, 2) - n.dot(H * n)) / length;
    const double e = std::exp(std::min(psi.psi, 2.0)), g = 1.0 - e;
    const double slope2 = psi.gradient.lengthSqr(), lambda = weights.gradient;
    const double w = g * g + lambda * e * e * slope2 + double(weights.area);
    const openvdb::Vec3d gradW =
        2.0 * e *
        (lambda * e * (slope2 * psi.gradient + psi.hessian * psi.gradient) - g * psi.gradient);
    const double share = double(leastSlopeShare) * slope;
    return (n.dot(gradW) + w * kappa) / (2.0 * e * std::max(slope2, share * share));
}

} // namespace

int restBandVox(double voxel)
{
    constexpr double most = 6.0; // which spline coefficients at the interface no longer feel
    return int(std::clamp(std::ceil(restReach / voxel) + 1.0, double(bandWidthVox), most));
}

LeafField levelsAtRest(const SparseField& psi, const SlopeField& slope, const Weights& weights,
                       const Progress& progress)
{
    const float h = float(psi.voxelSize);
    LeafField levels(psi.table.size());
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        LeafBlock<float, 1> block;
        block.gather(psi, n);
        levelRows(block.values, slope.leaf(n), h, weights, levels.leaf(n));
    });
    // The interface holds together over sqrt(lambda/2), which the formula leaves out: a light mean
    // of the levels has less energy than none. measured: as farFrom(), with 0, 0.1 and 0.125 Å
    constexpr float length = 0.1f, most = 0.08f; // [Å], weight
    const float weight = smaller(length * length / (h * h), most);
    LeafField means(psi.table.size());
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        LeafBlock<float, 1> block;
        block.gather(psi.table, levels, n);
        meanRows(block.values, weight, means.leaf(n));
    });
    return means;
}

RestLevel levelAtRest(const PsiJet& psi, double least, const Weights& weights)
{
    const openvdb::Mat3d& H = psi.hessian;
    const double length = std::max(psi.gradient.length(), 1e-6);
    const openvdb::Vec3d up = psi.gradient / length;
    const double lambda = weights.gradient, area = weights.area;
    const double a = std::max(length, least), m = up.dot(H * up);
    const double curvature = (m - H(0, 0) - H(1, 1) - H(2, 2)) / length;
    const double kappa = std::clamp(curvature, -sharpest, sharpest);
    const double q = lambda * a * a, more = std::max(q + lambda * m, 0.0);
    const double alpha = 2.0 * a * (1.0 + more) - kappa * (1.0 + q), beta = a - kappa;
    const double gamma = kappa * (1.0 + area);
    const double root = std::sqrt(std::max(beta * beta + alpha * gamma, 0.0));
    const double found = (beta + root) / std::max(alpha, 0.5);
    const double e = std::clamp(found, lowestLevel / (1.0 + q), highestLevel / (1.0 + q));
    RestLevel out{std::log(e), curvature};
    // By implicit differentiation of alpha e^2 - 2 beta e - gamma, whose derivative by e is 2 root.
    const double steep = 2.0 * root * e;
    if (root < 1e-3 || e != found) return out;
    const double isMore = more > 0.0 ? 1.0 : 0.0;
    if (length > least) {
        const double alphaBySlope =
            2.0 * (1.0 + more) + 4.0 * lambda * a * a * isMore - 2.0 * kappa * lambda * a;
        out.bySlope = -(alphaBySlope * e * e - 2.0 * e) / steep;
    }
    out.bySecond = -2.0 * a * lambda * isMore * e * e / steep;
    if (std::abs(curvature) < sharpest)
        out.byKappa = -(-(1.0 + q) * e * e + 2.0 * e - (1.0 + area)) / steep;
    return out;
}

namespace
{

/// Of how many leaves one is looked at. Powers of two: a brick, which has fewer leaves, looks at
/// those of the whole among others.
std::size_t sampleOfRest(std::size_t leaves)
{
    constexpr std::size_t few = 64, most = 16;
    std::size_t every = 1;
    while (every < most && leaves >= few * every) every *= 2;
    return every;
}

/// Of how many cells of 1 Å one is looked at: a sum makes its list of terms once a cell, and small
/// voxels have more places in it than voxels of 1 Å.
int sampleOfCells(double voxelSize)
{
    int every = 4;
    while (every > 1 && every * voxelSize * voxelSize > 1.0) every /= 2;
    return every;
}

/// Whether a place is in one of these cells.
bool isInSample(const openvdb::Vec3d& x, int every)
{
    const openvdb::Coord cell = openvdb::Coord::floor(x);
    return ((cell.x() + 2 * cell.y() + 3 * cell.z()) & (every - 1)) == 0;
}

} // namespace

Displacements waysToRest(const SparseField& psi, const RestingLevels& rest, const GaussianSum& sum,
                         const Weights& weights, const Region& region, const Progress& progress)
{
    const LeafTable& table = psi.table;
    const float h = float(psi.voxelSize), inverse = 1.0f / h;
    const std::size_t every = sampleOfRest(table.size());
    const int everyCell = every > 1 ? sampleOfCells(psi.voxelSize) : 1;
    std::vector<std::size_t> leaves;
    for (std::size_t n = 0; n < table.size(); ++n) {
        const openvdb::Coord& origin = table.origin(n);
        // By its place, so that a brick looks at the leaves of the whole.
        const std::size_t place =
            std::size_t(std::abs((origin.x() + origin.y() * 5 + origin.z() * 11) / leafDim));
        if (place % every == 0 && region.owned.isInside(origin)) leaves.push_back(n);
    }
    return parallelSum<Displacements>(leaves.size(), progress, [&](std::size_t i) {
        const std::size_t n = leaves[i];
        const openvdb::Coord origin = table.origin(n);
        Displacements ways;
        LeafBlock<float, 2> v, phi;
        v.gather(table, rest.levels, n);
        phi.gather(psi, n);
        for (std::size_t k = 0; k < std::size(v.values); ++k)
            phi.values[k] = v.values[k] - phi.values[k];
        thread_local EdgeCrossings crossings;
        crossings.find(phi, table.active(n));
        for (std::size_t k = 0; k < crossings.edges.size(); ++k) {
            const EdgeCrossings::Edge& edge = crossings.edges[k];
            const GaussianSum::Point& p = crossings.points[k];
            const openvdb::Vec3d x =
                (origin.asVec3d() + openvdb::Vec3d(p.x, p.y, p.z)) * psi.voxelSize;
            if (!isInSample(x, everyCell)) continue;
            const float* at = v.values + edge.from;
            const PsiJet ofLevel = between(derivatives<2>(at, inverse),
                                           derivatives<2>(at + edge.step, inverse), edge.t);
            const PsiJet jet = sum.jetWithBumps(x);
            const double way = wayToRest(jet, ofLevel, rest.slope.leaf(n)[edge.voxel], weights);
            ways.add(float(std::abs(way)) * inverse);
        }
        return ways;
    });
}

void carryLevels(const RestingLevels& rest, double width, SparseField& psi,
                 const Progress& progress)
{
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        carryRows(rest.levels.leaf(n), rest.slope.leaf(n), float(2.0 * width), psi.leaf(n));
    });
}

} // namespace molsurf
