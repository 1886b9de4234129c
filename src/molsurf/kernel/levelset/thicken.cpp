// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/thicken.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf
{

using openvdb::Coord;

namespace
{

/// Slope of the distance below which a voxel is in the middle. At a wall's own middle it is 0, at
/// the nearest voxel 0.5 at most, by central differences.
constexpr float middleSlope = 0.7f;

float valueAt(const SparseField& S, std::size_t n, const Coord& voxel)
{
    const Coord at = voxel - S.table.origin(n);
    const auto side = [](int i) { return i < 0 ? -1 : i >= leafDim ? 1 : 0; };
    const int d = 9 * (side(at[0]) + 1) + 3 * (side(at[1]) + 1) + side(at[2]) + 1;
    const std::int32_t m = S.table.neighbours(n)[std::size_t(d)];
    const auto v = openvdb::FloatTree::LeafNodeType::coordToOffset(voxel);
    // Beyond the band the value does not count: no voxel there is thin.
    return m == noLeaf ? 1e6f : S.leaf(std::size_t(m))[v];
}

/// Voxels of leaf n in the middle of what is thinner than a wall: less than wall/2 deep, with a
/// small slope of S by central differences.
std::vector<Coord> middleOf(const SparseField& S, std::size_t n, double wall)
{
    std::vector<Coord> out;
    S.table.active(n).forEach([&](int v) {
        const float depth = -S.leaf(n)[v];
        if (depth <= 0.0f || depth >= float(0.5 * wall)) return;
        const Coord at = S.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
        float slope = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            Coord low = at, high = at;
            --low[axis];
            ++high[axis];
            const float d = (valueAt(S, n, high) - valueAt(S, n, low)) / float(2.0 * S.voxelSize);
            slope += d * d;
        }
        if (slope < middleSlope * middleSlope) out.push_back(at);
    });
    return out;
}

/// A voxel on the surface comes to lie inside, by a thousandth of a voxel. Where S is 0 at a voxel,
/// vertices of the mesh may fall together there.
float offSurface(float S, double voxelSize)
{
    const float least = float(1e-3 * voxelSize);
    return std::abs(S) < least ? -least : S;
}

} // namespace

void thickenWalls(DistanceBand& S, double wall, double width, const Progress& progress)
{
    LeafTable& table = S.phi.table;
    const double h = S.phi.voxelSize;
    std::vector<std::vector<Coord>> middle(table.size());
    parallelFor(table.size(), progress,
                [&](std::size_t n) { middle[n] = middleOf(S.phi, n, wall); });

    const double radius = 0.5 * wall / h, reach = radius + width / h; // [voxel]
    const int leaves = int(std::ceil(reach / leafDim));
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const Coord origin = table.origin(n);
        const openvdb::Vec3d mid = origin.asVec3d() + 0.5 * (leafDim - 1);
        const double leafReach = 0.5 * std::sqrt(3.0) * (leafDim - 1) + reach;
        std::vector<openvdb::Vec3f> near; // middles within reach, from the origin [voxel]
        const int w = 2 * leaves + 1;     // leaves along an edge of the cube that may have some
        for (int k = 0; k < w * w * w; ++k) {
            const auto step = [&](int i) { return leafDim * (i % w - leaves); };
            const std::int32_t m =
                table.find(origin.offsetBy(step(k / w / w), step(k / w), step(k)));
            if (m == noLeaf) continue;
            for (const Coord& c : middle[std::size_t(m)]) {
                if ((c.asVec3d() - mid).lengthSqr() < leafReach * leafReach)
                    near.emplace_back((c - origin).asVec3s());
            }
        }
        float* phi = S.phi.leaf(n);
        if (!near.empty()) {
            table.active(n).forEach([&](int v) {
                const openvdb::Vec3f at(float(v >> 6), float(v >> 3 & 7), float(v & 7));
                float least = float(reach * reach);
                for (const openvdb::Vec3f& c : near) least = std::min(least, (at - c).lengthSqr());
                const float ball = float(h) * (std::sqrt(least) - float(radius)); // its distance
                if (ball < phi[v]) {
                    phi[v] = ball;
                    S.kinks.active(n).set(v);
                }
                phi[v] = offSurface(phi[v], h);
            });
        }
        table.active(n) &= within(phi, float(width));
    });
}

} // namespace molsurf
