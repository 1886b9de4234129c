// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/gaussian_sum.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// A term that stays e^-12 = 6e-6 of the largest one moves psi = 0 by less than 1e-5 eps.
constexpr float negligible = 12.0f;

/// The lowest psi that matters: at a distance of D outside, psi = -2 ln 2 D/eps - ...; the band of
/// a surface ends long before.
constexpr float lowestPsi = -60.0f;

/// A sum below this may have lost terms to underflow.
constexpr float smallestSum = 1e-30f;

/// Adds four terms, each a product of three one-dimensional exponentials, to the sums of a leaf.
MOLSURF_KERNEL void accumulate(const float (*ex)[8], const float (*ey)[8], const float (*ez)[8],
                               float* sum)
{
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            const float w0 = ex[0][x] * ey[0][y], w1 = ex[1][x] * ey[1][y];
            const float w2 = ex[2][x] * ey[2][y], w3 = ex[3][x] * ey[3][y];
            float* row = sum + 64 * x + 8 * y;
            for (int z = 0; z < 8; ++z) {
                row[z] += (w0 * ez[0][z] + w1 * ez[1][z]) + (w2 * ez[2][z] + w3 * ez[3][z]);
            }
        }
    }
}

/// out[k] = exp(-decay ((k - centre)^2 - nearest^2)) for k = 0..7.
MOLSURF_KERNEL void exponentials(float decay, float centre, float nearest2, float factor,
                                 float* out)
{
    for (int k = 0; k < 8; ++k) {
        const float d = float(k) - centre;
        out[k] = factor * fastExp(decay * (nearest2 - d * d));
    }
}

/// psi = top + ln sum, no lower than the lowest that matters.
MOLSURF_KERNEL void takeLogarithms(float top, float* sum)
{
    for (int v = 0; v < leafSize; ++v) {
        const float psi = top + fastLog(larger(sum[v], smallestSum));
        sum[v] = larger(psi, lowestPsi);
    }
}

/// The origins of all leaves within a number of leaves of those given by their place among leaves.
std::vector<Coord> leavesWithin(std::vector<Coord> places, int reach, const Progress& progress)
{
    tbb::parallel_sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<Coord> blocks;
    for (const Coord& place : places) blocks.push_back(place & ~(leafDim - 1));
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    LeafTable coarse(std::move(blocks));
    for (const Coord& place : places) {
        coarse.active(coarse.find(place))
            .set(openvdb::FloatTree::LeafNodeType::coordToOffset(place));
    }
    for (; reach > 0; reach -= leafDim) {
        coarse = dilated(coarse, std::min(reach, leafDim), Spread::Cube, progress);
    }
    std::vector<Coord> origins;
    for (std::size_t n = 0; n < coarse.size(); ++n) {
        coarse.active(n).forEach([&](int v) {
            const Coord place = coarse.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            origins.emplace_back(place.x() * leafDim, place.y() * leafDim, place.z() * leafDim);
        });
    }
    return origins;
}

float distanceToLeaf(float centre)
{
    return std::max({0.0f, -centre, centre - 7.0f});
}

} // namespace

GaussianExtent extentOf(const std::vector<Ball>& balls, const GaussianOptions& options,
                        const std::vector<Decay>& decays)
{
    const float largest = largestRadius(balls);
    GaussianExtent extent{largest, largest + options.probe, options.epsilon};
    if (options.blobbiness > 0.0)
        extent.maxTolerance = M_LN2 * extent.maxGrownRadius / options.blobbiness;
    double slowest = 1e30;
    for (std::size_t i = 0; i < decays.size(); ++i) {
        const double R = balls[i].radius + options.probe;
        const double rate = decays[i].rate > 0.0f ? double(decays[i].rate) : options.rate(R);
        if (decays[i].rate > 0.0f) slowest = std::min(slowest, rate);
        const double square = R * R + decays[i].level / rate;
        extent.maxGrownRadius = std::max(extent.maxGrownRadius, std::sqrt(std::max(square, 0.0)));
    }
    if (slowest < 1e30) {
        extent.maxTolerance =
            std::max(extent.maxTolerance, M_LN2 / (slowest * extent.maxGrownRadius));
    }
    return extent;
}

namespace
{

/// Beyond this distance a term is negligible where psi = 0, and hardly felt at the rim of the band.
double cutoff2(double R, double C, double level, double reach, double tolerance)
{
    const double rim = R + reach + 2.0 * tolerance;
    return std::max(rim * rim, R * R + (negligible + level) / C);
}

} // namespace

double GaussianExtent::cutoff(double reach) const
{
    const double slowest = M_LN2 / (maxTolerance * maxGrownRadius);
    return std::sqrt(cutoff2(maxGrownRadius, slowest, 0.0, reach, maxTolerance));
}

GaussianSum::GaussianSum(const std::vector<Ball>& balls, const GaussianOptions& options,
                         std::vector<Decay> decays)
    : balls_(balls), options_(options), decays_(std::move(decays)),
      extent_(options.extent ? *options.extent : extentOf(balls, options, decays_)),
      index_(balls, {1.25, options.probe, 2.0, extent_.maxRadius})
{
}

void GaussianSum::gatherTerms(const Coord& origin, double reach, std::vector<Term>& terms) const
{
    const double h = options_.voxelSize;
    const Vec3d low = origin.asVec3d() * h;
    const openvdb::Vec3f first(low), last(low + Vec3d(7.0 * h));
    const double inverse = 1.0 / h, farthest = extent_.cutoff(reach);
    // More than rounding at 10^6 Å takes; the exact test follows.
    const float farthest2 = float((farthest + 0.25) * (farthest + 0.25));

    // The smallest value of each term in the leaf bounds psi from below, its largest from above.
    terms.clear();
    float floor = 2.0f * lowestPsi;
    // A smaller ball is felt less far, from its boundary too.
    const double gap = farthest - extent_.maxRadius;
    index_.forEachNear(low, low + Vec3d(7.0 * h), gap, [&](const Ball& ball, int i) {
        float apart2 = 0.0f;
        for (int a = 0; a < 3; ++a) {
            const float d =
                larger(larger(first[a] - ball.center[a], ball.center[a] - last[a]), 0.0f);
            apart2 += d * d;
        }
        if (apart2 > farthest2) return;
        const openvdb::Vec3f c = openvdb::Vec3f((Vec3d(ball.center) - low) * inverse);
        const float R = ball.radius + float(options_.probe);
        const float C = float(rate(std::size_t(i), R));
        const float level = decays_.empty() ? 0.0f : decays_[std::size_t(i)].level;
        Term t{c.x(), c.y(), c.z(), C * float(h * h), C * R * R + level, 0.0f};
        float nearest2 = 0.0f, most2 = 0.0f;
        for (const float x : {t.x, t.y, t.z}) {
            const float n = distanceToLeaf(x), f = std::max(std::abs(x), std::abs(x - 7.0f));
            nearest2 += n * n;
            most2 += f * f;
        }
        t.exponent = t.level - t.decay * nearest2;
        if (nearest2 * h * h > cutoff2(R, C, level, reach, extent_.maxTolerance)) return;
        floor = std::max(floor, t.level - t.decay * most2);
        terms.push_back(t);
    });
    terms.erase(std::remove_if(terms.begin(), terms.end(),
                               [&](const Term& t) { return t.exponent < floor - negligible; }),
                terms.end());
}

std::size_t GaussianSum::termCount(const Coord& origin, double reach) const
{
    std::vector<Term> terms;
    gatherTerms(origin, reach, terms);
    return terms.size();
}

void GaussianSum::evaluate(const Coord& origin, double reach, float* psi) const
{
    thread_local std::vector<Term> terms;
    gatherTerms(origin, reach, terms);
    std::fill_n(psi, leafSize, 0.0f);
    if (terms.empty()) {
        std::fill_n(psi, leafSize, lowestPsi);
        return;
    }
    const FlushDenormals scope;
    // Every term is taken relative to the largest exponent in the leaf, so that none overflows.
    float top = terms[0].exponent;
    for (const Term& t : terms) top = std::max(top, t.exponent);

    for (std::size_t first = 0; first < terms.size(); first += 4) {
        alignas(64) float ex[4][8], ey[4][8], ez[4][8];
        for (int k = 0; k < 4; ++k) {
            if (first + k >= terms.size()) {
                std::fill_n(ex[k], 8, 0.0f);
                std::fill_n(ey[k], 8, 0.0f);
                std::fill_n(ez[k], 8, 0.0f);
                continue;
            }
            const Term& t = terms[first + k];
            const auto near2 = [](float c) { return distanceToLeaf(c) * distanceToLeaf(c); };
            exponentials(t.decay, t.x, near2(t.x), fastExp(t.exponent - top), ex[k]);
            exponentials(t.decay, t.y, near2(t.y), 1.0f, ey[k]);
            exponentials(t.decay, t.z, near2(t.z), 1.0f, ez[k]);
        }
        accumulate(ex, ey, ez, psi);
    }
    LeafMask lost;
    if (top + std::log(smallestSum) > lowestPsi) lost = lessThan(psi, smallestSum);
    takeLogarithms(top, psi);
    lost.forEach([&](int v) {
        // The products underflowed here: the largest exponent of the voxel itself is the scale.
        const float x = float(v >> 6), y = float(v >> 3 & 7), z = float(v & 7);
        const auto exponent = [&](const Term& t) {
            return t.level - t.decay * ((x - t.x) * (x - t.x) + (y - t.y) * (y - t.y) +
                                        (z - t.z) * (z - t.z));
        };
        float largest = exponent(terms[0]), sum = 0.0f;
        for (const Term& t : terms) largest = std::max(largest, exponent(t));
        for (const Term& t : terms) sum += std::exp(exponent(t) - largest);
        psi[v] = std::max(largest + std::log(sum), lowestPsi);
    });
}

SparseField GaussianSum::evaluate(LeafTable table, const Progress& progress) const
{
    SparseField psi{std::move(table), LeafField(), options_.voxelSize};
    psi.values = LeafField(psi.table.size());
    parallelFor(psi.table.size(), progress,
                [&](std::size_t n) { evaluate(psi.table.origin(n), options_.reach, psi.leaf(n)); });
    return psi;
}

LeafTable GaussianSum::band(int steps, const Progress& progress,
                            const openvdb::CoordBBox& box) const
{
    // Leaves that may hold a voxel with psi >= 0: those near a ball. In a table whose voxels stand
    // for leaves, they are the leaves of the centres, dilated. Where k terms meet, psi = 0 lies at
    // most eps/2 log2(k) outside the balls; k = 64 is more than any packing of atoms has.
    const double edge = leafDim * options_.voxelSize;
    std::vector<Coord> centres(balls_.size());
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        centres[i] = Coord::floor(Vec3d(balls_[i].center) / edge);
    }
    const int reach = int(std::ceil((extent_.ofZero() + options_.voxelSize) / edge));
    std::vector<Coord> origins = leavesWithin(centres, reach, progress);
    origins.erase(std::remove_if(origins.begin(), origins.end(),
                                 [&](const Coord& origin) { return !box.isInside(origin); }),
                  origins.end());
    LeafTable table(std::move(origins));

    std::vector<LeafMask> inside(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        alignas(64) float psi[leafSize];
        evaluate(table.origin(n), 2.0 * extent_.maxTolerance, psi);
        inside[n] = ~lessThan(psi, 0.0f);
    });
    // The inner voxels that have an outer one among their 26 neighbours.
    std::vector<LeafMask> outside(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) outside[n] = ~inside[n];
    parallelFor(table.size(), progress, [&](std::size_t n) {
        table.active(n) = inside[n] & dilatedMask(table, outside, n, true);
    });
    return clipped(dilated(pruned(table), steps, Spread::Ball, progress), box);
}

} // namespace molsurf
