// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/void_field.h"

#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/depth.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/union_distance.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr int cubeDim = 4; // voxels along the edge of a cube that is looked at first

/// Computes depths where they may matter.
class DepthOfLeaves
{
public:
    DepthOfLeaves(const OuterDepth& outer, const PocketOptions& options, double voxelSize)
        : outer_(outer), probe_(options.probeOut), cut_(options.cut), voxel_(voxelSize),
          diagonal_(std::sqrt(3.0) * voxelSize)
    {
    }

    /// The cubes of a leaf. Bits are cubes.
    struct Cubes {
        std::array<Vec3f, 8> centres; ///< the nearest centre of a probe to the middle of each
        std::uint8_t known = 0;       ///< which have one: only these can have room
    };

    /// Looks at a leaf.
    /// @param[out] below  of the voxels that have room, and of those beside them; not a number
    ///                    where the clearance decides
    Cubes evaluate(const Coord& origin, const float* clearance, float* below) const
    {
        std::fill_n(below, leafSize, -float(cut_));
        double guess = 0.0; // of the leaf's middle
        Cubes out;
        for (int cube = 0; cube < 8; ++cube) {
            const int corner = cornerOf(cube), middle = corner + cubeMiddle;
            float most = least();
            forEachVoxel(corner, [&](int v) { most = std::max(most, clearance[v]); });
            if (most <= least() || isFarOutside(clearance[middle])) continue;
            const Vec3d x = placeOf(origin, middle);
            if (guess == 0.0) guess = distanceOf(placeOf(origin, leafMiddle));
            const double near = guess + (x - placeOf(origin, leafMiddle)).length() + rounding;
            const OuterDepth::Depth depth = outer_.at(x, hasRoom(clearance[middle]), near);
            if (depth.value + reach() + diagonal_ <= cut_) continue;
            out.known |= std::uint8_t(1 << cube);
            out.centres[std::size_t(cube)] = Vec3f(depth.centre);
            forEachVoxel(corner, [&](int v) {
                if (clearance[v] > least())
                    below[v] = belowAt(placeOf(origin, v), x, depth, clearance[v]);
            });
        }
        return out;
    }

    /// Gives voxels that are not known the least distance from the centres of the cubes about them.
    void fillDeep(const LeafTable& table, const std::vector<Cubes>& cubes, std::size_t n,
                  float* below) const
    {
        for (int cube = 0; cube < 8; ++cube) {
            const int corner = cornerOf(cube);
            bool any = false;
            forEachVoxel(corner, [&](int v) { any = any || std::isnan(below[v]); });
            if (!any) continue;
            std::vector<Vec3f> near;
            for (int k = 0; k < 27; ++k) {
                const int x = (cube >> 2) + k / 9 - 1, y = (cube >> 1 & 1) + k / 3 % 3 - 1,
                          z = (cube & 1) + k % 3 - 1;
                const auto leaf =
                    std::size_t(centreNeighbour + 9 * (x >> 1) + 3 * (y >> 1) + (z >> 1));
                const std::int32_t m = table.neighbours(n)[leaf];
                const int other = 4 * (x & 1) + 2 * (y & 1) + (z & 1);
                if (m != noLeaf && cubes[std::size_t(m)].known >> other & 1)
                    near.push_back(cubes[std::size_t(m)].centres[std::size_t(other)]);
            }
            forEachVoxel(corner, [&](int v) {
                if (!std::isnan(below[v])) return;
                const Vec3f x(placeOf(table.origin(n), v));
                float least2 = std::numeric_limits<float>::max();
                for (const Vec3f& centre : near)
                    least2 = std::min(least2, (centre - x).lengthSqr());
                below[v] = std::sqrt(least2) - float(probe_ + cut_);
            });
        }
    }

private:
    static int cornerOf(int cube)
    {
        return cubeDim * (64 * (cube >> 2) + 8 * (cube >> 1 & 1) + (cube & 1));
    }

    template<typename F>
    static void forEachVoxel(int corner, const F& f)
    {
        for (int i = 0; i < cubeDim * cubeDim * cubeDim; ++i)
            f(corner + 64 * (i >> 4) + 8 * (i >> 2 & 3) + (i & 3));
    }

    Vec3d placeOf(const Coord& origin, int v) const
    {
        return origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() * voxel_;
    }

    /// How far a point is below the cut.
    /// @param[in] middle  another one, and its depth
    /// @return not a number if it is more than the clearance; if it is so little that no point
    ///         beside it is below the cut, perhaps more than it is, but as little
    float belowAt(const Vec3d& x, const Vec3d& middle, const OuterDepth::Depth& depth,
                  float clearance) const
    {
        if (depth.value - (x - middle).length() - cut_ > double(std::max(clearance, 0.0f)))
            return std::numeric_limits<float>::quiet_NaN();
        const double most = (x - depth.centre).length();
        if (most - probe_ < cut_ - diagonal_) return float(most - probe_ - cut_);
        return float(outer_.at(x, hasRoom(clearance), most + rounding).value - cut_);
    }

    /// The clearance that a voxel beside one with room has at least.
    float least() const { return float(-diagonal_); }

    /// The way from the middle of a cube to any of its voxels. Depths differ by no more.
    double reach() const { return 2.0 * diagonal_; }

    bool hasRoom(float clearance) const { return clearance >= float(probe_); }

    /// Whether the large probe gets to a cube, and so far from where it does not that no voxel of
    /// the cube is below the cut.
    bool isFarOutside(float clearance) const
    {
        return hasRoom(clearance) && !outer_.hasVoids() && reach() + diagonal_ < probe_ + cut_;
    }

    double distanceOf(const Vec3d& x) const
    {
        return (outer_.at(x, false, probe_ + cut_).centre - x).length();
    }

    static constexpr int leafMiddle = 64 * 4 + 8 * 4 + 4, cubeMiddle = 64 * 2 + 8 * 2 + 2;
    static constexpr double rounding = 1e-3; // of places, so that a search finds them [Å]
    const OuterDepth& outer_;
    double probe_, cut_, voxel_, diagonal_;
};

/// A box of whole leaves about balls that are grown.
openvdb::CoordBBox leavesAbout(const std::vector<Ball>& balls, double grown, double voxelSize)
{
    const openvdb::BBoxd box = boxOf(balls, grown);
    const double leaf = leafDim * voxelSize;
    const Coord low = Coord::floor(box.min() / leaf), high = Coord::floor(box.max() / leaf);
    return {Coord(low.x() * leafDim, low.y() * leafDim, low.z() * leafDim),
            Coord((high.x() + 1) * leafDim - 1, (high.y() + 1) * leafDim - 1,
                  (high.z() + 1) * leafDim - 1)};
}

} // namespace

VoidField voidField(const std::vector<Ball>& balls, const PocketOptions& options, double voxelSize,
                    const Progress& progress)
{
    const auto outer = std::make_shared<const OuterDepth>(balls, options.probeOut,
                                                          OuterDepth::Reach::Passed, progress);
    const double rim = 2.0 * voxelSize, high = options.probeOut - options.probeIn + rim;
    const BandWidths width{options.probeIn + rim, high + outer->voidRadius()};
    // No void is outside of the balls, and what else is higher is not looked at.
    const openvdb::CoordBBox box = outer->hasVoids()
                                       ? leavesAbout(balls, options.probeIn + high, voxelSize)
                                       : openvdb::CoordBBox::inf();
    BallUnion grown = unionOf(balls, options.probeIn, progress);
    std::vector<Ball> corners;
    for (const Corner& corner : grown.boundary.corners)
        corners.push_back({corner.position, 0.0, 0});
    SparseField band = distanceToUnion(std::move(grown), voxelSize, width, progress, box).phi;
    const DepthOfLeaves depths(*outer, options, voxelSize);
    LeafField below(band.table.size());
    std::vector<DepthOfLeaves::Cubes> cubes(band.table.size());
    parallelFor(band.table.size(), progress, [&](std::size_t n) {
        float* clearance = band.leaf(n);
        for (int v = 0; v < leafSize; ++v) clearance[v] += float(options.probeIn);
        cubes[n] = depths.evaluate(band.table.origin(n), clearance, below.leaf(n));
    });
    parallelFor(band.table.size(), progress,
                [&](std::size_t n) { depths.fillDeep(band.table, cubes, n, below.leaf(n)); });
    std::vector<Coord> origins;
    for (std::size_t n = 0; n < cubes.size(); ++n)
        if (cubes[n].known) origins.push_back(band.table.origin(n));
    VoidField out{LeafTable(std::move(origins)), {}, {}, voxelSize, std::move(corners), outer};
    out.clearance = LeafField(out.table.size());
    out.below = LeafField(out.table.size());
    parallelFor(out.table.size(), progress, [&](std::size_t n) {
        const auto from = std::size_t(band.table.find(out.table.origin(n)));
        std::copy_n(band.leaf(from), leafSize, out.clearance.leaf(n));
        std::copy_n(below.leaf(from), leafSize, out.below.leaf(n));
        for (int v = 0; v < leafSize; ++v) out.table.active(n).set(v, out.room(n, v) > 0.0f);
    });
    return out;
}

} // namespace molsurf
