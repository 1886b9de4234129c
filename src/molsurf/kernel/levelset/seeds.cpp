// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/seeds.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/jets.h"

#include <algorithm>
#include <utility>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

using Lanes = FootPoints::Lanes;

Seed seedOf(const FootPoints& feet, int lane, std::int32_t leaf)
{
    Seed seed;
    seed.leaf = leaf;
    for (int a = 0; a < 3; ++a) {
        seed.y[a] = feet.y[a][lane];
        seed.n[a] = feet.n[a][lane];
    }
    for (int i = 0; i < 6; ++i) seed.A[i] = feet.A[i][lane];
    seed.kappa = feet.kappa[lane];
    seed.gauss = feet.gauss[lane];
    return seed;
}

/// The closest points of voxels next to the interface, by Newton's method from the voxels
/// themselves. A point that would leave the ball of radius farthestSeed stays where it is.
/// @param[in] c       coefficients of phi/h
/// @param[in] voxels  `count` <= lanes voxels of the leaf
void closestPoints(const LeafBlock<float, 3>& c, const std::uint16_t* voxels, int count,
                   FootPoints& feet)
{
    alignas(64) Lanes x[3], move[3];
    JetLanes jets{};
    float step2[lanes];
    bool moves[lanes];
    for (int l = 0; l < lanes; ++l) {
        const int used = std::min(l, count - 1); // idle lanes repeat the last
        setLane(placeOf(voxels[used]), l, x);
        setLane(lane(x, l), l, feet.y);
        step2[l] = 1.0f;
        moves[l] = l < count;
    }
    constexpr int steps = 6;
    constexpr float small2 = 1e-5f; // squared step: the next is about this long
    for (int i = 0;; ++i) {
        jetsIn(c, feet.y, moves, jets);
        for (int l = 0; l < lanes; ++l) moves[l] = moves[l] && step2[l] >= small2;
        if (i == steps || std::none_of(moves, moves + lanes, [](bool on) { return on; })) break;
        shapeFrom(jets, feet);
        newtonSteps(jets, feet, x, move);
        for (int l = 0; l < lanes; ++l) {
            if (!moves[l]) continue;
            const Vec3f step = lane(move, l), next = lane(feet.y, l) + step;
            moves[l] = (next - lane(x, l)).lengthSqr() <= farthestSeed * farthestSeed;
            step2[l] = step.lengthSqr();
            if (moves[l]) setLane(next, l, feet.y);
        }
    }
    shapeFrom(jets, feet);
}

} // namespace

int listOf(const LeafMask& mask, std::uint16_t* voxels)
{
    int count = 0;
    mask.forEach([&](int v) { voxels[count++] = std::uint16_t(v); });
    return count;
}

std::vector<LeafMask> interfaceVoxels(const LeafTable& table, const std::vector<LeafMask>& inside,
                                      const Progress& progress)
{
    std::vector<LeafMask> outside(table.size()), out(table.size());
    for (std::size_t n = 0; n < table.size(); ++n) outside[n] = ~inside[n];
    parallelFor(table.size(), progress, [&](std::size_t n) {
        out[n] = ((inside[n] & dilatedMask(table, outside, n, false)) |
                  (outside[n] & dilatedMask(table, inside, n, false))) &
                 table.active(n);
    });
    return out;
}

PagedArray<Seed> findSeeds(const SparseField& coefficients, const std::vector<LeafMask>& interface,
                           std::vector<std::size_t>& begins, const Progress& progress)
{
    const LeafTable& table = coefficients.table;
    begins.assign(table.size() + 1, 0);
    for (std::size_t n = 0; n < table.size(); ++n) begins[n + 1] = begins[n] + interface[n].count();
    PagedArray<Seed> seeds(begins.back());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        if (!interface[n].any()) return;
        LeafBlock<float, 3> block;
        block.gather(coefficients, n);
        for (float& c : block.values) c *= float(1.0 / coefficients.voxelSize);
        std::uint16_t voxels[leafSize];
        const int count = listOf(interface[n], voxels);
        for (int first = 0; first < count; first += lanes) {
            const int used = std::min(lanes, count - first);
            FootPoints feet;
            closestPoints(block, voxels + first, used, feet);
            for (int l = 0; l < used; ++l)
                seeds[begins[n] + std::size_t(first + l)] = seedOf(feet, l, std::int32_t(n));
        }
    });
    return seeds;
}

LeafPoints pointsOf(const LeafTable& table, const PagedArray<Seed>& seeds,
                    std::vector<std::size_t> begins, const Progress& progress)
{
    LeafPoints points{table, std::move(begins), {}, {}, {}};
    for (auto* v : {&points.x, &points.y, &points.z}) v->resize(seeds.size() + LeafPoints::padding);
    parallelFor(table.size(), progress, [&](std::size_t n) {
        for (std::size_t i = points.begins[n]; i < points.begins[n + 1]; ++i) {
            points.x[i] = seeds[i].y.x();
            points.y[i] = seeds[i].y.y();
            points.z[i] = seeds[i].y.z();
        }
    });
    return points;
}

} // namespace molsurf
