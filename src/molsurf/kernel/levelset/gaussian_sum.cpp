// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/gaussian_sum.h"

#include "molsurf/kernel/core/parallel.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// Dilation of a set of leaves: the origins of all within `reach` leaves of some, along each axis.
/// @param[in] places  of the leaves, counted in leaves; any order, with repeats
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

/// 1, 2, 3, ...
std::uint64_t numberOfSum()
{
    static std::atomic<std::uint64_t> last{0};
    return ++last;
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
        const double square = R * R + decays[i].level / rate; // rate (r^2 - R^2) = level at r
        extent.maxGrownRadius = std::max(extent.maxGrownRadius, std::sqrt(std::max(square, 0.0)));
    }
    if (slowest < 1e30) { // GaussianOptions::rate() solved for epsilon
        extent.maxTolerance =
            std::max(extent.maxTolerance, M_LN2 / (slowest * extent.maxGrownRadius));
    }
    return extent;
}

double GaussianExtent::cutoff(double reach) const
{
    const double R = maxGrownRadius, rim = R + 2.0 * maxTolerance + reach; // felt in the band
    const double slowest = M_LN2 / (maxTolerance * R); // the least rate: its term falls off last
    return std::sqrt(std::max(rim * rim, R * R + double(negligible) / slowest));
}

GaussianSum::GaussianSum(const std::vector<Ball>& balls, const GaussianOptions& options,
                         const std::vector<Decay>& decays)
    : number_(numberOfSum()), options_(options),
      extent_(options.extent ? *options.extent : extentOf(balls, options, decays)),
      index_(balls, {1.25, options.probe, 2.0, extent_.maxRadius}), bumps_(options.voxelSize)
{
    const double h = options.voxelSize;
    lists_.resize(index_.size());
    for (std::size_t k = 0; k < index_.size(); ++k) {
        const Ball& ball = index_.ball(k);
        const Decay decay = decays.empty() ? Decay() : decays[std::size_t(index_.indexOf(k))];
        const double R = ball.radius + options.probe;
        const double C = decay.rate > 0.0f ? double(decay.rate) : options.rate(R);
        lists_.x[k] = ball.center.x();
        lists_.y[k] = ball.center.y();
        lists_.z[k] = ball.center.z();
        lists_.decay[k] = float(C * h * h);
        lists_.level[k] = float(C * R * R) + decay.level;
        // Beyond these a term is hardly felt at the rim of the band, and negligible where psi = 0.
        lists_.rim[k] = float((R + 2.0 * extent_.maxTolerance) / h);
        lists_.felt[k] = float(std::sqrt(R * R + (double(negligible) + decay.level) / C));
        lists_.felt2[k] = float((R * R + (double(negligible) + decay.level) / C) / (h * h));
    }
}

/// The terms of a leaf and what is made of them; it keeps its memory from leaf to leaf.
struct GaussianSum::Leaf {
    GaussianTerms terms;
    GaussianBounds bounds;
    GaussianTables tables;

    void sum(float* psi) { sumTerms(terms, bounds, tables, psi); }
};

GaussianSum::Leaf& GaussianSum::leafAt(const Coord& origin, double reach) const
{
    thread_local Leaf leaf;
    const double h = options_.voxelSize;
    const GaussianLeaf place(origin, h, reach / h);
    const Vec3d low = origin.asVec3d() * h, high = low + Vec3d((leafDim - 1) * h);
    leaf.terms.count = 0;
    // A smaller ball is felt less far, from its boundary too.
    const double gap = extent_.cutoff(reach) - extent_.maxRadius;
    index_.forEachRun(low, high, gap, [&](std::int32_t begin, std::int32_t end) {
        addTerms(lists_, begin, end, place, leaf.terms);
    });
    boundTerms(leaf.terms, leaf.bounds);
    return leaf;
}

const GaussianTerms& GaussianSum::termsAt(const Coord& origin, double reach) const
{
    return leafAt(origin, reach).terms;
}

void GaussianSum::evaluate(const Coord& origin, double reach, float* psi) const
{
    leafAt(origin, reach).sum(psi);
    bumps_.addTo(origin, psi);
}

const JetTerms& GaussianSum::jetTermsAt(const Vec3d& x) const
{
    struct Near {
        std::uint64_t sum = 0; // 0: none
        Coord cell;
        JetTerms terms;
    };
    // A direct-mapped cache of 4^3 cells of 1 Å: points on their way to a critical point go to and
    // fro between cells.
    thread_local std::array<Near, 64> known;
    const Coord cell = Coord::floor(x);
    Near& near = known[std::size_t(16 * (cell.x() & 3) + 4 * (cell.y() & 3) + (cell.z() & 3))];
    if (near.sum == number_ && near.cell == cell) return near.terms;
    const Vec3d low = cell.asVec3d(), half(0.5);
    near.terms.clear();
    index_.forEachRun(low, low + 2.0 * half, extent_.cutoff(0.0) - extent_.maxRadius,
                      [&](std::int32_t begin, std::int32_t end) {
                          near.terms.addNear(lists_, begin, end, options_.voxelSize, low + half,
                                             half.length());
                      });
    near.terms.fillUp();
    near.sum = number_;
    near.cell = cell;
    return near.terms;
}

PsiJet GaussianSum::jet(const Vec3d& x) const
{
    return jetTermsAt(x).jetAt(x);
}

PsiJet GaussianSum::sharpenedJet(const Vec3d& x, double times) const
{
    return jetTermsAt(x).sharpened(times).jetAt(x);
}

bool GaussianSum::isCovered(const Vec3d& x, double more) const
{
    return index_.anyNear(x, x, options_.probe - more, [&](const Ball& ball) {
        const double deep = ball.radius + options_.probe - more;
        return deep > 0.0 && (x - Vec3d(ball.center)).lengthSqr() < deep * deep;
    });
}

double GaussianSum::roomAt(const Vec3d& x, double most) const
{
    double room = most;
    index_.forEachNear(x, x, options_.probe + most, [&](const Ball& ball, std::int32_t) {
        room = std::min(room, (x - Vec3d(ball.center)).length() - ball.radius - options_.probe);
    });
    return room;
}

std::size_t GaussianSum::productCount(const Coord& origin, double reach) const
{
    float psi[leafSize];
    Leaf& leaf = leafAt(origin, reach);
    leaf.sum(psi);
    std::size_t listed = 0;
    for (const std::size_t count : leaf.tables.counts) listed += count;
    return listed * (leafSize / 8);
}

SparseField GaussianSum::evaluate(LeafTable table, const Progress& progress) const
{
    SparseField psi{std::move(table), LeafField(), options_.voxelSize};
    psi.values = LeafField(psi.table.size());
    parallelFor(psi.table.size(), progress,
                [&](std::size_t n) { evaluate(psi.table.origin(n), options_.reach, psi.leaf(n)); });
    return psi;
}

GaussianSum::Candidates GaussianSum::candidates(const Progress& progress,
                                                const openvdb::CoordBBox& box) const
{
    // Leaves that may hold a voxel with psi >= 0: those near the centre of a ball. Where k terms
    // meet, psi = 0 lies at most eps/2 log2(k) outside the balls: 3 eps for k = 64, more than any
    // packing of atoms has.
    const double edge = leafDim * options_.voxelSize;
    std::vector<Coord> centres(index_.size());
    for (std::size_t i = 0; i < index_.size(); ++i) {
        centres[i] = Coord::floor(Vec3d(index_.ball(i).center) / edge);
    }
    const int reach = int(std::ceil((extent_.ofZero() + options_.voxelSize) / edge));
    std::vector<Coord> origins = leavesWithin(centres, reach, progress);
    origins.erase(std::remove_if(origins.begin(), origins.end(),
                                 [&](const Coord& origin) { return !box.isInside(origin); }),
                  origins.end());
    Candidates out;
    out.table = LeafTable(std::move(origins));

    // The sums of leaves that their bounds do not decide are kept: the band has most of them.
    const LeafTable& table = out.table;
    out.inside.resize(table.size());
    out.sums = LeafField(table.size());
    out.places.assign(table.size(), -1);
    std::atomic<std::int32_t> summed{0};
    parallelFor(table.size(), progress, [&](std::size_t n) {
        Leaf& leaf = leafAt(table.origin(n), options_.reach);
        // If rounding decides, psi is 0 within rounding at the voxel of the bound alone.
        if (leaf.bounds.most(leaf.terms.count) < 0.0f) return;
        if (leaf.bounds.least() > 0.0f) {
            out.inside[n] = ~LeafMask();
            return;
        }
        out.places[n] = summed++;
        float* psi = out.sums.leaf(std::size_t(out.places[n]));
        leaf.sum(psi);
        out.inside[n] = ~lessThan(psi, 0.0f);
    });
    return out;
}

SparseField GaussianSum::searched(const Candidates& leaves, const Progress& progress) const
{
    const double h = options_.voxelSize;
    std::vector<Coord> origins;
    for (std::size_t n = 0; n < leaves.table.size(); ++n)
        if (leaves.places[n] >= 0) origins.push_back(leaves.table.origin(n));
    SparseField psi{LeafTable(std::move(origins)), LeafField(), h};
    psi.values = LeafField(psi.table.size());
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        const Coord& origin = psi.table.origin(n);
        const std::int32_t place = leaves.places[std::size_t(leaves.table.find(origin))];
        std::copy_n(leaves.sums.leaf(std::size_t(place)), leafSize, psi.leaf(n));
    });
    return psi;
}

void GaussianSum::addBumps(Candidates& leaves, const Progress& progress) const
{
    std::atomic<std::int32_t> summed{0};
    for (const std::int32_t place : leaves.places) summed += place >= 0;
    parallelFor(leaves.table.size(), progress, [&](std::size_t n) {
        const Coord& origin = leaves.table.origin(n);
        if (!bumps_.reach(origin)) return;
        std::int32_t& place = leaves.places[n];
        const bool known = place >= 0;
        if (!known) place = summed++;
        float* values = leaves.sums.leaf(std::size_t(place));
        known ? bumps_.addTo(origin, values) : evaluate(origin, options_.reach, values);
        leaves.inside[n] = ~lessThan(values, 0.0f);
    });
}

SparseField GaussianSum::band(int steps, const Progress& progress, const openvdb::CoordBBox& box,
                              const BumpsFor& bumpsFor)
{
    Candidates leaves = candidates(progress, box);
    if (bumpsFor) {
        bumps_ = bumpsFor(searched(leaves, progress));
        addBumps(leaves, progress);
    }
    // The inner voxels that have an outer one among their 26 neighbours.
    LeafTable& table = leaves.table;
    std::vector<LeafMask> outside(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) outside[n] = ~leaves.inside[n];
    parallelFor(table.size(), progress, [&](std::size_t n) {
        table.active(n) = leaves.inside[n] & dilatedMask(table, outside, n, true);
    });

    SparseField psi{clipped(dilated(pruned(table), steps, Spread::Ball, progress), box),
                    LeafField(), options_.voxelSize};
    psi.values = LeafField(psi.table.size());
    parallelFor(psi.table.size(), progress, [&](std::size_t n) {
        const Coord& origin = psi.table.origin(n);
        const std::int32_t m = table.find(origin);
        const std::int32_t place = m == noLeaf ? -1 : leaves.places[std::size_t(m)];
        if (place < 0) {
            evaluate(origin, options_.reach, psi.leaf(n));
        } else {
            std::copy_n(leaves.sums.leaf(std::size_t(place)), leafSize, psi.leaf(n));
        }
    });
    return psi;
}

} // namespace molsurf
