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

/// Middles of walls, by the leaf that they lie in, and the leaves that have some.
struct Middles {
    std::vector<std::vector<Coord>> ofLeaf;
    std::vector<std::size_t> leaves;
};

Middles middlesOf(const SparseField& S, double wall, const Progress& progress)
{
    Middles out;
    out.ofLeaf.resize(S.table.size());
    parallelFor(S.table.size(), progress,
                [&](std::size_t n) { out.ofLeaf[n] = middleOf(S, n, wall); });
    for (std::size_t n = 0; n < out.ofLeaf.size(); ++n)
        if (!out.ofLeaf[n].empty()) out.leaves.push_back(n);
    return out;
}

/// The middles of which one is the nearest to a voxel of a leaf, and is within reach [voxel].
/// @return their places from the leaf's first voxel
std::vector<openvdb::Vec3f> middlesNear(const Middles& middles, const LeafTable& table,
                                        std::size_t n, double reach)
{
    const Coord origin = table.origin(n);
    const openvdb::Vec3d mid(0.5 * (leafDim - 1));
    const double halfLeaf = 0.5 * std::sqrt(3.0) * (leafDim - 1);
    double far = halfLeaf + reach; // from the middle of the leaf
    const int leaves = int(std::ceil(reach / leafDim)), w = 2 * leaves + 1;
    std::vector<openvdb::Vec3f> near;
    const auto add = [&](std::size_t m) {
        const openvdb::Vec3d from((table.origin(m) - origin).asVec3d());
        const double along = std::max({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])});
        if (along > leafDim * leaves || from.length() - halfLeaf > far) return;
        for (const Coord& c : middles.ofLeaf[m]) {
            const openvdb::Vec3d x = (c - origin).asVec3d();
            const double away = (x - mid).length();
            if (away >= far) continue;
            near.emplace_back(x);
            // No voxel is farther from its nearest one than the leaf's middle and half a leaf.
            far = std::min(far, away + 2.0 * halfLeaf + 1e-3);
        }
    };
    // Leaves of the cube that may have some, or all that have some, whichever are fewer.
    if (std::pow(double(w), 3) < double(middles.leaves.size())) {
        for (int k = 0; k < w * w * w; ++k) {
            const auto step = [&](int i) { return leafDim * (i % w - leaves); };
            const std::int32_t m =
                table.find(origin.offsetBy(step(k / w / w), step(k / w), step(k)));
            if (m != noLeaf) add(std::size_t(m));
        }
    } else {
        for (const std::size_t m : middles.leaves) add(m);
    }
    const auto isFar = [&](const openvdb::Vec3f& x) {
        return (openvdb::Vec3d(x) - mid).length() > far;
    };
    near.erase(std::remove_if(near.begin(), near.end(), isFar), near.end());
    return near;
}

} // namespace

void thickenWalls(DistanceBand& S, double wall, double width, const Progress& progress)
{
    LeafTable& table = S.phi.table;
    const double h = S.phi.voxelSize;
    const Middles middles = middlesOf(S.phi, wall, progress);
    const double radius = 0.5 * wall / h, reach = radius + width / h; // [voxel]
    parallelFor(table.size(), progress, [&](std::size_t n) {
        const std::vector<openvdb::Vec3f> near = middlesNear(middles, table, n, reach);
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
