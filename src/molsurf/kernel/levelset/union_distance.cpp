// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/union_distance.h"

#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/kink.h"
#include "molsurf/kernel/levelset/leaf_feet.h"
#include "molsurf/kernel/levelset/part_tables.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// The boundary point nearest to a voxel.
struct Foot {
    bool inside; // whether the voxel is
    Vec3f y;     // from the voxel [Å]
    Vec3f n;     // unit normal of the distance there, outward
};

/// The foot of a voxel on the whole sphere or circle of its nearest part, or a corner. Only voxels
/// inside are nearest to an arc or to a corner.
Foot footOn(const Part& part, const Vec3d& x)
{
    const Vec3f w(x - part.place);
    if (part.kind == PartKind::Patch) {
        const float distance = w.length();
        const Vec3f n = w / std::max(distance, 1e-6f * part.radius);
        return {distance < part.radius, (part.radius - distance) * n, n};
    }
    Vec3f y = -w;
    if (part.kind == PartKind::Arc) {
        const Vec3f u = w - w.dot(part.axis) * part.axis;
        y += part.radius / std::max(u.length(), 1e-6f) * u;
    }
    return {true, y, y / std::max(y.length(), 1e-6f)};
}

/// Normal curvature of the boundary at the foot of x, along the tangential part of a vector [1/Å].
/// At an arc it is that of the circle, n.u/r, times the square of the cosine between the vector and
/// the arc; u is the radial unit vector, n the normal of the distance.
float curvatureAlong(const Part& part, const Foot& foot, const Vec3d& x, const Vec3f& chord)
{
    if (part.kind == PartKind::Patch) return 1.0f / part.radius;
    if (part.kind == PartKind::Corner) return 0.0f;
    const Vec3f u = (Vec3f(x - part.place) + foot.y) / part.radius;
    const float along = chord.dot(part.axis.cross(u)), across = chord.dot(foot.n);
    const float length2 = chord.lengthSqr() - across * across; // of the tangential part
    return length2 > 0.0f ? foot.n.dot(u) / part.radius * along * along / length2 : 0.0f;
}

/// Whether a voxel is so near to the axis of an arc that others about it may have feet far apart.
bool isNearAxis(const Part& part, const Vec3d& x, double voxelSize)
{
    if (part.kind != PartKind::Arc) return false;
    const Vec3d w = x - part.place;
    const double height = w.dot(Vec3d(part.axis));
    return w.lengthSqr() - height * height < 2.0 * voxelSize * voxelSize;
}

/// Whether the distance has a kink between a voxel and the next one along an axis.
/// @param[in] p,q  the parts nearest to them, or -1
bool isKinkBeside(const PartTables& tables, const Coord& voxel, int axis, double voxelSize,
                  std::int32_t p, std::int32_t q)
{
    if (p < 0 || q < 0 || (p == q && std::size_t(p) < tables.patches())) return false;
    const Vec3d x = voxel.asVec3d() * voxelSize;
    const Part part = tables.part(p);
    if (p == q && !isNearAxis(part, x, voxelSize)) return false;
    Vec3d next = x;
    next[axis] += voxelSize;
    const Part other = tables.part(q);
    const Foot a = footOn(part, x), b = footOn(other, next);
    const float side = a.inside ? 1.0f : -1.0f;
    const Vec3f spread = side * (b.n - a.n);
    if (a.inside != b.inside || spread.lengthSqr() < kinkSpread * kinkSpread) return false;
    const Vec3f chord = Vec3f(next - x) + b.y - a.y;
    return isKink(chord, spread,
                  std::max(side * curvatureAlong(part, a, x, chord),
                           side * curvatureAlong(other, b, next, chord)));
}

/// Adds the voxels of a leaf with a kink between them and the next leaf along an axis.
/// @param[in] part  index of the nearest part of each voxel of the table
void addKinksBetweenLeaves(const PartTables& tables, const LeafTable& table,
                           const LeafArray<std::int32_t>& part, double voxelSize, std::size_t n,
                           LeafMask& kinks)
{
    constexpr int strides[3] = {64, 8, 1}, neighbours[3] = {22, 16, 14}; // of 27: the next
    const std::int32_t* own = part.leaf(n);
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t m = table.neighbours(n)[std::size_t(neighbours[axis])];
        if (m == noLeaf) continue;
        const std::int32_t* next = part.leaf(std::size_t(m));
        const int stride = strides[axis], across = strides[axis == 0 ? 1 : 0];
        const int along = strides[axis == 2 ? 1 : 2];
        for (int i = 0; i < leafDim; ++i) {
            for (int j = 0; j < leafDim; ++j) {
                const int w = i * across + j * along, v = w + (leafDim - 1) * stride;
                if (!table.active(n).on(v) || kinks.on(v)) continue;
                const Coord at = table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
                kinks.set(v, isKinkBeside(tables, at, axis, voxelSize, own[v], next[w]));
            }
        }
    }
}

/// Everything near a leaf, relative to its centre, and the memory that its cubes take by turns.
struct Near {
    LeafParts parts;
    CubeParts cubeParts;
    LeafFeet feet;
};

class Evaluator
{
public:
    /// @param[in,out] set  the arcs and corners of its boundary are taken
    Evaluator(BallUnion& set, double voxelSize, const BandWidths& width, const Progress& progress)
        : boundary_(set.boundary), voxel_(voxelSize), inside_(width.inside),
          outside_(width.outside),
          tables_(set.boundary, set.balls, set.probe, 1.0001 * width.inside, progress)
    {
    }

    const PartTables& tables() const { return tables_; }

    /// The leaves that may have a voxel of the band: those whose box of voxels meets the shell
    /// about the whole sphere of a patch, from `inside` within it to `outside` beyond.
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

    /// @param[out] phi    of the leaf, cut off at the limits of the band [Å]
    /// @param[out] part   index of the nearest part: patches, then arcs, then corners; null:
    ///                    neither parts nor kinks are wanted
    /// @param[out] kinks  voxels with a kink between them and the next of the leaf along an axis
    /// @return the voxels within the band
    LeafMask evaluate(const Coord& origin, Near& near, float* phi, std::int32_t* part,
                      LeafMask& kinks) const
    {
        const double half = 0.5 * (leafDim - 1) * voxel_;
        tables_.gather(origin.asVec3d() * voxel_ + Vec3d(half), half, outside_ + voxel_,
                       near.parts);
        LeafFeet& feet = near.feet;
        for (int b = 0; b < 8; ++b) {
            constexpr int edge = VoxelCube::edge;
            const Coord corner(edge * (b >> 2), edge * (b >> 1 & 1), edge * (b & 1));
            VoxelCube cube;
            cube.voxel = float(voxel_);
            cube.first = (Vec3f(corner.asVec3s()) - Vec3f(0.5f * (leafDim - 1))) * cube.voxel;
            evaluate(cube, near);
            part ? feet.set(cube, corner) : feet.setDistances(cube, corner);
        }
        const LeafMask active = feet.cutOff(float(inside_), float(outside_), phi);
        if (!part) return active;
        feet.finish();
        std::copy_n(feet.part, leafSize, part);
        kinks = kinksWithin(origin, feet, active);
        return active;
    }

private:
    /// The voxels of a leaf beside which the distance has a kink, between voxels of this leaf.
    LeafMask kinksWithin(const Coord& origin, const LeafFeet& feet, const LeafMask& active) const
    {
        const KinkMasks found = findKinks(feet, float(voxel_), std::int32_t(tables_.patches()));
        LeafMask kinks = found.sure & active;
        for (int axis = 0; axis < 3; ++axis) {
            (found.possible[axis] & active & ~kinks).forEach([&](int v) {
                const Coord at = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
                const int next = v + (64 >> 3 * axis); // by 64, 8 or 1
                kinks.set(v,
                          isKinkBeside(tables_, at, axis, voxel_, feet.part[v], feet.part[next]));
            });
        }
        return kinks;
    }

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

/// The signed distance to the boundary of balls in its band, and its kinks if they are wanted.
DistanceBand bandOf(BallUnion set, double voxelSize, const BandWidths& width,
                    const Progress& progress, const openvdb::CoordBBox& box, Kinks wanted)
{
    DistanceBand band;
    band.phi.voxelSize = voxelSize;
    if (set.boundary.patches.empty()) return band;
    const Evaluator evaluator(set, voxelSize, width, progress);
    trimHeap();
    LeafTable& table = band.phi.table;
    table = LeafTable(evaluator.leaves(box, progress));
    band.phi.values = LeafField(table.size());
    const bool all = wanted == Kinks::Found;
    LeafArray<std::int32_t> part(all ? table.size() : 0);
    tbb::enumerable_thread_specific<Near> scratch;
    std::vector<LeafMask> kinks(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        table.active(n) = evaluator.evaluate(table.origin(n), scratch.local(), band.phi.leaf(n),
                                             all ? part.leaf(n) : nullptr, kinks[n]);
    });
    band.kinks = emptied(table);
    if (!all) return band;
    parallelFor(table.size(), progress, [&](std::size_t n) {
        addKinksBetweenLeaves(evaluator.tables(), table, part, voxelSize, n, kinks[n]);
        band.kinks.active(n) = kinks[n];
    });
    return band;
}

} // namespace

BallUnion unionOf(const std::vector<Ball>& balls, double probe, const Progress& progress)
{
    return {balls, probe, ballBoundary(balls, probe, progress)};
}

DistanceBand distanceToUnion(BallUnion set, double voxelSize, const BandWidths& width,
                             const Progress& progress, const openvdb::CoordBBox& box, Kinks kinks)
{
    DistanceBand band = bandOf(std::move(set), voxelSize, width, progress, box, kinks);
    trimHeap();
    return band;
}

} // namespace molsurf
