// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/nearest_seeds.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/nearest_point.h"
#include "molsurf/kernel/spline/spline.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;

namespace
{

/// The voxels that may lie in the result: the interface voxels, dilated by `steps` on one side.
/// After every four steps, voxels of the other side are dropped.
/// @param[in] wrong  voxels of the other side, by leaf of `table`
LeafTable reachable(const LeafTable& table, const std::vector<LeafMask>& interface,
                    const std::vector<LeafMask>& wrong, int steps, const Progress& progress)
{
    LeafTable out = table;
    for (std::size_t n = 0; n < table.size(); ++n) out.active(n) = interface[n];
    while (steps > 0) {
        const int now = std::min(steps, 4);
        steps -= now;
        out = dilated(out, now, Spread::Ball, progress);
        parallelFor(out.size(), progress, [&](std::size_t n) {
            const std::int32_t m = table.find(out.origin(n));
            if (m != noLeaf) out.active(n) &= ~wrong[m] | interface[m];
        });
    }
    return out;
}

/// The voxels of a leaf that touch the next one on a way of leaves.
LeafMask touching(const Coord& way)
{
    LeafMask out;
    for (int v = 0; v < leafSize; ++v) {
        const int place[3] = {v >> 6, v >> 3 & 7, v & 7};
        bool on = true;
        for (int a = 0; a < 3; ++a) on = on && (way[a] == 0 || place[a] == (way[a] > 0 ? 7 : 0));
        out.set(v, on);
    }
    return out;
}

/// Flood fill: finds the leaves inside, among those of a domain that a level set lacks. No
/// interface crosses them: the majority of the touching voxels of the level set's leaves decides.
/// @param[in] inner  the voxels inside, by leaf of `table`
std::vector<char> innerLeaves(const LeafTable& domain, const LeafTable& table,
                              const std::vector<LeafMask>& inner, const Progress& progress)
{
    struct Neighbour {
        Coord offset; // to there
        LeafMask own; // of its voxels, those that touch
    };
    std::vector<Neighbour> about;
    for (int k = 0; k < 27; ++k) {
        const Coord way(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
        if (k == centreNeighbour) continue;
        about.push_back({Coord(way.x() * leafDim, way.y() * leafDim, way.z() * leafDim),
                         touching(Coord(-way.x(), -way.y(), -way.z()))});
    }
    std::vector<char> out(domain.size()), known(domain.size());
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        if (table.find(domain.origin(n)) != noLeaf) return;
        int sum = 0;
        for (const Neighbour& next : about) {
            const std::int32_t m = table.find(domain.origin(n) + next.offset);
            if (m == noLeaf) continue;
            sum += 2 * (inner[std::size_t(m)] & next.own).count() - next.own.count();
        }
        out[n] = sum > 0;
        known[n] = sum != 0;
    });
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < domain.size(); ++n)
        if (known[n]) found.push_back(n);
    for (std::size_t i = 0; i < found.size(); ++i) { // those farther away, step by step
        for (const std::int32_t m : domain.neighbours(std::int32_t(found[i]))) {
            if (m == noLeaf || known[std::size_t(m)] ||
                table.find(domain.origin(std::size_t(m))) != noLeaf)
                continue;
            out[std::size_t(m)] = out[found[i]];
            known[std::size_t(m)] = true;
            found.push_back(std::size_t(m));
        }
    }
    return out;
}

} // namespace

NearestSeeds nearestSeeds(SparseField phi, const BandWidths& width, double level,
                          const openvdb::CoordBBox& box, const Progress& progress)
{
    std::vector<LeafMask> inner(phi.table.size()), outer(phi.table.size());
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        inner[n] = lessThan(phi.leaf(n), 0.0f);
        outer[n] = ~inner[n];
    });
    const std::vector<LeafMask> interface = interfaceVoxels(phi.table, inner, progress);
    std::vector<std::size_t> begins;
    NearestSeeds near;
    near.coefficients = prefilter(phi, progress);
    phi.values = LeafField();
    const LeafTable& table = near.coefficients.table;
    // Half of them are enough for a level that lies deep inside. Near the interface each sheet of a
    // wall or gap of one voxel needs its own.
    std::vector<LeafMask> seeded = interface;
    if (level < -2.0 * phi.voxelSize)
        for (std::size_t n = 0; n < table.size(); ++n) seeded[n] &= inner[n];
    near.seeds = findSeeds(near.coefficients, seeded, begins, progress);
    if (near.seeds.empty()) return near;

    const auto steps = [&](double w) { return int(std::ceil(w / phi.voxelSize)); };
    near.domain =
        clipped(joined(reachable(table, interface, outer, steps(width.inside), progress),
                       reachable(table, interface, inner, steps(width.outside), progress)),
                box);
    const LeafTable& domain = near.domain;
    const LeafPoints points = pointsOf(table, near.seeds, std::move(begins), progress);
    const double reach = std::max(width.inside, width.outside) / phi.voxelSize + 1.0;
    near.index = SeedIndex(domain.size());
    tbb::enumerable_thread_specific<NearestScratch> scratches;
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        std::fill_n(near.index.leaf(n), leafSize, noSeed);
        nearestPoints(points, domain.origin(n), domain.active(n), reach, scratches.local(),
                      near.index.leaf(n));
    });

    const std::vector<char> innerLeaf = innerLeaves(domain, table, inner, progress);
    near.inside.resize(domain.size());
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        const std::int32_t m = table.find(domain.origin(n));
        near.inside[n] = m != noLeaf    ? inner[std::size_t(m)]
                         : innerLeaf[n] ? ~LeafMask()
                                        : LeafMask();
    });
    return near;
}

} // namespace molsurf
