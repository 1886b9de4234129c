// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/union_distance.h"

#include "molsurf/core/parallel.h"
#include "molsurf/grid/leaf_block.h"
#include "molsurf/levelset/kink.h"
#include "molsurf/levelset/part_tables.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// Everything near a leaf, relative to its centre, and the memory that its cubes take by turns.
struct Near {
    LeafParts parts;
    CubeParts cubeParts;
};

class Evaluator
{
public:
    Evaluator(const BallUnion& set, double voxelSize, const BandWidths& width,
              const Progress& progress)
        : boundary_(set.boundary), voxel_(voxelSize), inside_(width.inside),
          outside_(width.outside),
          tables_(set.boundary, set.balls, set.probe, 1.0001 * width.inside, progress)
    {
    }

    /// The leaves that may have a voxel of the band.
    std::vector<Coord> leaves(const openvdb::CoordBBox& box, const Progress& progress) const
    {
        const double edge = leafDim * voxel_;
        std::vector<std::vector<Coord>> found(boundary_.patches.size());
        parallelFor(found.size(), progress, [&](std::size_t i) {
            const Patch& p = boundary_.patches[i];
            const double far = p.radius + outside_, near = p.radius - inside_;
            const Coord first = Coord::floor((p.centre - Vec3d(far)) / edge);
            const Coord last = Coord::floor((p.centre + Vec3d(far)) / edge);
            for (int x = first.x(); x <= last.x(); ++x) {
                for (int y = first.y(); y <= last.y(); ++y) {
                    for (int z = first.z(); z <= last.z(); ++z) {
                        double least2 = 0.0, most2 = 0.0;
                        const Vec3d low = Coord(x, y, z).asVec3d() * edge - p.centre;
                        for (int k = 0; k < 3; ++k) {
                            const double a = low[k], b = low[k] + edge - voxel_;
                            const double n = a > 0.0 ? a : b < 0.0 ? b : 0.0;
                            least2 += n * n;
                            most2 += std::max(a * a, b * b);
                        }
                        if (least2 <= far * far && (near <= 0.0 || most2 >= near * near) &&
                            box.isInside(Coord(leafDim * x, leafDim * y, leafDim * z))) {
                            found[i].emplace_back(leafDim * x, leafDim * y, leafDim * z);
                        }
                    }
                }
            }
        });
        std::vector<Coord> all;
        for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
        tbb::parallel_sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

    /// @param[out] phi   of the leaf [Å]
    /// @param[out] part  index of the nearest part: patches, then arcs, then corners
    /// @return the voxels within the band
    LeafMask evaluate(const Coord& origin, Near& near, float* phi, std::int32_t* part) const
    {
        const double half = 0.5 * (leafDim - 1) * voxel_;
        tables_.gather(origin.asVec3d() * voxel_ + Vec3d(half), half, outside_ + voxel_,
                       near.parts);
        LeafMask active;
        for (int b = 0; b < 8; ++b) {
            constexpr int edge = VoxelCube::edge;
            const Coord corner(edge * (b >> 2), edge * (b >> 1 & 1), edge * (b & 1));
            VoxelCube cube;
            const float half = 0.5f * (leafDim - 1);
            cube.voxel = float(voxel_);
            cube.first = (Vec3f(corner.asVec3s()) - Vec3f(half)) * cube.voxel;
            evaluate(cube, near);
            for (int k = 0; k < VoxelCube::size; ++k) {
                const float distance = cube.distance[k];
                const Coord at = corner + VoxelCube::coord(k);
                const int v = 64 * at.x() + 8 * at.y() + at.z();
                phi[v] = std::clamp(distance, float(-inside_), float(outside_));
                part[v] = cube.part[k];
                active.set(v, distance > float(-inside_) && distance < float(outside_));
            }
        }
        return active;
    }

private:
    /// Finds distances and nearest parts of a cube.
    void evaluate(VoxelCube& cube, Near& near) const
    {
        const float beyond = float(outside_ + voxel_); // kinks look a voxel farther
        nearestBalls(cube, near.parts.balls, beyond, near.cubeParts);
        if (std::any_of(cube.distance, cube.distance + VoxelCube::size,
                        [&](float d) { return d < cube.rounding(); }))
            nearestParts(cube, near.parts, boundary_.caps, 1.0001f * float(inside_),
                         near.cubeParts);
    }

    const BallBoundary& boundary_;
    double voxel_, inside_, outside_;
    const PartTables tables_;
};

/// The boundary point nearest to a voxel.
struct Foot {
    std::int32_t part;
    bool inside; // whether the voxel is
    Vec3f y;     // from the voxel [Å]
    Vec3f n;     // unit normal of the distance there, outward
};

/// The foot of a voxel on the whole sphere or circle of its nearest part, or a corner. Only voxels
/// inside are nearest to an arc or to a corner.
Foot footOn(const BallBoundary& boundary, std::int32_t part, const Vec3d& x)
{
    const std::size_t patches = boundary.patches.size(), arcs = boundary.arcs.size();
    const std::size_t i = std::size_t(part);
    if (i < patches) {
        const Patch& patch = boundary.patches[i];
        const Vec3f w(x - patch.centre);
        const float distance = w.length(), radius = float(patch.radius);
        const Vec3f n = w / std::max(distance, 1e-6f * radius);
        return {part, distance < radius, (radius - distance) * n, n};
    }
    Vec3f y;
    if (i < patches + arcs) {
        const Arc& arc = boundary.arcs[i - patches];
        const Vec3f w(x - arc.centre), axis(arc.axis);
        const Vec3f u = w - w.dot(axis) * axis;
        y = float(arc.radius) / std::max(u.length(), 1e-6f) * u - w;
    } else {
        y = Vec3f(boundary.corners[i - patches - arcs].position - x);
    }
    return {part, true, y, y / std::max(y.length(), 1e-6f)};
}

/// Curvature of the boundary at the foot of x, along the tangential part of a vector: that of a
/// patch, or what an arc has of it [1/Å].
float curvatureAlong(const BallBoundary& boundary, const Foot& foot, const Vec3d& x,
                     const Vec3f& chord)
{
    const std::size_t patches = boundary.patches.size(), arcs = boundary.arcs.size();
    const std::size_t i = std::size_t(foot.part);
    if (i < patches) return 1.0f / float(boundary.patches[i].radius);
    if (i >= patches + arcs) return 0.0f;
    const Arc& arc = boundary.arcs[i - patches];
    const Vec3f u = (Vec3f(x - arc.centre) + foot.y) / float(arc.radius);
    const float along = chord.dot(Vec3f(arc.axis).cross(u)), across = chord.dot(foot.n);
    const float length2 = chord.lengthSqr() - across * across; // of the tangential part
    return length2 > 0.0f ? foot.n.dot(u) / float(arc.radius) * along * along / length2 : 0.0f;
}

bool isKinkBetween(const BallBoundary& boundary, const Vec3d& x, const Foot& a, const Vec3d& next,
                   const Foot& b)
{
    const float side = a.inside ? 1.0f : -1.0f;
    const Vec3f spread = side * (b.n - a.n);
    if (a.inside != b.inside || spread.lengthSqr() < kinkSpread * kinkSpread) return false;
    const Vec3f chord = Vec3f(next - x) + b.y - a.y;
    return isKink(chord, spread,
                  std::max(side * curvatureAlong(boundary, a, x, chord),
                           side * curvatureAlong(boundary, b, next, chord)));
}

/// Whether the nearest part of a voxel is an arc about whose axis two voxels may have feet far
/// apart.
bool isNearAxis(const BallBoundary& boundary, std::int32_t part, const Vec3d& x, double voxelSize)
{
    const std::size_t i = std::size_t(part) - boundary.patches.size();
    if (std::size_t(part) < boundary.patches.size() || i >= boundary.arcs.size()) return false;
    const Vec3d w = x - boundary.arcs[i].centre;
    const double height = w.dot(boundary.arcs[i].axis);
    return w.lengthSqr() - height * height < 2.0 * voxelSize * voxelSize;
}

/// The voxels of a leaf with a kink between them and the next voxel along an axis.
/// @param[in] part  index of the nearest part of each voxel of the table
LeafMask kinksOf(const BallBoundary& boundary, const LeafTable& table,
                 const LeafArray<std::int32_t>& part, double voxelSize, std::size_t n)
{
    LeafMask kinks;
    LeafBlock<std::int32_t, 1> block;
    block.gather(table, part, n);
    constexpr int strides[3] = {block.strideX, block.strideY, block.strideZ};
    table.active(n).forEach([&](int v) {
        const Coord local(v >> 6, v >> 3 & 7, v & 7);
        const std::int32_t* p = block.at(local.x(), local.y(), local.z());
        if (p[0] < 0) return;
        const Vec3d x = (table.origin(n) + local).asVec3d() * voxelSize;
        const bool alone = !isNearAxis(boundary, p[0], x, voxelSize);
        std::optional<Foot> foot;
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t next = p[strides[axis]];
            if (next < 0 || (next == p[0] && alone)) continue;
            if (!foot) foot = footOn(boundary, p[0], x);
            Vec3d beside = x;
            beside[axis] += voxelSize;
            const Foot other = footOn(boundary, next, beside);
            if (!isKinkBetween(boundary, x, *foot, beside, other)) continue;
            kinks.set(v);
            return;
        }
    });
    return kinks;
}

} // namespace

BallUnion unionOf(const std::vector<Ball>& balls, double probe, const Progress& progress)
{
    return {balls, probe, ballBoundary(balls, probe, progress)};
}

DistanceBand distanceToUnion(BallUnion set, double voxelSize, const BandWidths& width,
                             const Progress& progress, const openvdb::CoordBBox& box)
{
    DistanceBand band;
    band.phi.voxelSize = voxelSize;
    if (set.boundary.patches.empty()) return band;
    const Evaluator evaluator(set, voxelSize, width, progress);
    LeafTable& table = band.phi.table;
    table = LeafTable(evaluator.leaves(box, progress));
    band.phi.values = LeafField(table.size());
    LeafArray<std::int32_t> part(table.size());
    tbb::enumerable_thread_specific<Near> scratch;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        table.active(n) =
            evaluator.evaluate(table.origin(n), scratch.local(), band.phi.leaf(n), part.leaf(n));
    });
    band.kinks = table;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        band.kinks.active(n) = kinksOf(set.boundary, table, part, voxelSize, n);
    });
    return band;
}

} // namespace molsurf
