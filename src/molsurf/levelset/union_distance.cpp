// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/union_distance.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/grid/leaf_block.h"

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

constexpr int cube = 4, plane = cube * cube, cubeSize = cube * plane;
static_assert(plane % floatLanes == 0 && leafDim % cube == 0);
constexpr double cubeRadius = 0.5 * (cube - 1) * 1.7320508; // [voxel]

/// A foot on a sphere counts as covered if it comes this near, as a cosine, to a cap. If it is not
/// covered, an arc or corner about it is just as near; if it is, as where spheres meet in a point
/// inside of others, nothing is.
constexpr float rimTolerance = 2e-6f;

/// What a cube of voxels is evaluated on, relative to its leaf's centre [Å].
struct NearPatch {
    Vec3f centre;
    float radius;
    std::uint32_t capsBegin, capsEnd;
    std::int32_t part;
    float gap; // between a cube's centre and the sphere
};
struct NearArc {
    Vec3f centre, axis, middle;
    float radius, cosine;
    std::int32_t part;
};
struct NearCorner {
    Vec3f position;
    std::int32_t part;
};
struct NearBall {
    Vec3f centre;
    float radius;
    float distance;     // of its boundary from the leaf's centre, < 0 inside
    std::int32_t patch; // -1: none of its sphere is uncovered
};

/// Caps, number by number: loops over them vectorise.
struct CapArrays {
    std::vector<float> x, y, z, cosine, sine;
};

/// The voxels of a cube: places [Å], and for each the square of the least distance so far and the
/// part that has it.
struct Cube {
    Vec3f first; // voxel
    Vec3f centre;
    float voxel, radius;
    alignas(64) float least2[cubeSize];
    alignas(64) std::int32_t part[cubeSize];
};

/// The places of some voxels of each plane.
MOLSURF_INLINE void places(const Cube& c, int part, Floats& y, Floats& z)
{
    for (int k = 0; k < floatLanes; ++k) {
        y[k] = c.first.y() + c.voxel * float((part + k) / cube);
        z[k] = c.first.z() + c.voxel * float((part + k) % cube);
    }
}

/// Gives voxels to a part where it is nearer than the one they have.
/// @param[in] first  the first of the voxels
/// @param[in] d2     their squared distances from the part
MOLSURF_INLINE void keep(Cube& c, int first, Floats d2, int part)
{
    const Floats least = load(c.least2 + first);
    const Ints nearer = d2 < least;
    store(c.least2 + first, nearer ? d2 : least);
    store(c.part + first, nearer ? splat(part) : load(c.part + first));
}

MOLSURF_KERNEL void nearCorners(Cube& c, const NearCorner* corners, std::size_t count)
{
    for (int first = 0; first < plane; first += floatLanes) {
        Floats y, z;
        places(c, first, y, z);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3f& p = corners[i].position;
            const Floats dy = y - p.y(), dz = z - p.z();
            const Floats aside = dy * dy + dz * dz;
            for (int k = 0; k < cube; ++k) {
                const float dx = c.first.x() + c.voxel * float(k) - p.x();
                keep(c, first + plane * k, aside + dx * dx, corners[i].part);
            }
        }
    }
}

MOLSURF_KERNEL void nearArcs(Cube& c, const NearArc* arcs, std::size_t count)
{
    for (int first = 0; first < plane; first += floatLanes) {
        Floats y, z;
        places(c, first, y, z);
        for (std::size_t i = 0; i < count; ++i) {
            const NearArc& arc = arcs[i];
            const Floats dy = y - arc.centre.y(), dz = z - arc.centre.z();
            for (int k = 0; k < cube; ++k) {
                const float dx = c.first.x() + c.voxel * float(k) - arc.centre.x();
                const Floats along = dx * arc.axis.x() + dy * arc.axis.y() + dz * arc.axis.z();
                const Floats middle =
                    dx * arc.middle.x() + dy * arc.middle.y() + dz * arc.middle.z();
                // Not from squares, which cancel near the axis.
                const Floats px = dx - along * arc.axis.x(), py = dy - along * arc.axis.y();
                const Floats pz = dz - along * arc.axis.z();
                const Floats r = squareRoot(px * px + py * py + pz * pz);
                const Floats d2 = along * along + (r - arc.radius) * (r - arc.radius);
                keep(c, first + plane * k,
                     middle >= (arc.cosine - rimTolerance) * r ? d2 : splat(1e30f), arc.part);
            }
        }
    }
}

/// The directions from the centre of a patch to the ball about a cube.
struct Cone {
    Vec3f axis;
    float cosine, sine; // of half its angle, at most a right one

    Cone(const Cube& c, const Vec3f& apex)
    {
        axis = c.centre - apex;
        const float length = axis.length();
        if (length <= 1.0001f * c.radius) { // any direction
            axis = Vec3f(0.0f);
            cosine = 0.0f;
            sine = 1.0f;
            return;
        }
        axis /= length;
        sine = c.radius / length;
        cosine = std::sqrt(1.0f - sine * sine);
    }
};

/// The caps that may hold a direction of a cone.
/// @param[out] out  their indices; room for all
/// @return their number; -1 if one holds all of the cone
MOLSURF_KERNEL int capsAbout(const Cone& cone, const CapArrays& caps, std::uint32_t begin,
                             std::uint32_t end, float* __restrict above, std::uint32_t* out)
{
    const float *x = caps.x.data() + begin, *y = caps.y.data() + begin, *z = caps.z.data() + begin;
    const float *cosine = caps.cosine.data() + begin, *sine = caps.sine.data() + begin;
    const float ax = cone.axis.x(), ay = cone.axis.y(), az = cone.axis.z();
    const int count = int(end - begin);
    std::int32_t whole = 0;
    for (int k = 0; k < count; ++k) {
        // A cap holds the cone if the angle between the axes is below the difference of the half
        // angles, and misses it if it is above their sum; none does if that is above pi.
        const float t = x[k] * ax + y[k] * ay + z[k] * az - cosine[k] * cone.cosine;
        const float s = sine[k] * cone.sine;
        whole |= (cosine[k] <= cone.cosine ? t - s : -1.0f) > rimTolerance ? 1 : 0;
        above[k] = cosine[k] < -cone.cosine ? 1.0f : t + s;
    }
    if (whole) return -1;
    int m = 0;
    for (int k = 0; k < count; ++k) {
        out[m] = begin + std::uint32_t(k);
        m += above[k] > -2.0f * rimTolerance;
    }
    return m;
}

MOLSURF_KERNEL void nearPatch(Cube& c, const NearPatch& patch, const CapArrays& caps,
                              const std::uint32_t* list, int count)
{
    for (int first = 0; first < plane; first += floatLanes) {
        Floats y, z;
        places(c, first, y, z);
        const Floats dy = y - patch.centre.y(), dz = z - patch.centre.z();
        for (int k = 0; k < cube; ++k) {
            const float dx = c.first.x() + c.voxel * float(k) - patch.centre.x();
            const Floats r = squareRoot(dx * dx + dy * dy + dz * dz);
            const Floats d = patch.radius - r;
            Floats d2 = d * d; // of voxels outside the ball too: the same holds for them
            const Floats least = load(c.least2 + first + plane * k);
            // Only directions that would be nearer are looked at further.
            Ints open = d2 < least ? splat(-1) : Ints{};
            if (!any(open)) continue;
            for (int j = 0; j < count; ++j) {
                const std::uint32_t i = list[j];
                const Floats along = dx * caps.x[i] + dy * caps.y[i] + dz * caps.z[i];
                open = along > (caps.cosine[i] - rimTolerance) * r ? Ints{} : open;
                if ((j & 3) == 3 && !any(open)) break;
            }
            d2 = open != 0 ? d2 : splat(1e30f);
            keep(c, first + plane * k, d2, patch.part);
        }
    }
}

/// The signed distance to the nearest ball, the one that counts outside of all, and its patch.
MOLSURF_KERNEL void nearBalls(Cube& c, const NearBall* balls, std::size_t count,
                              float* __restrict distance)
{
    for (int first = 0; first < plane; first += floatLanes) {
        Floats y, z;
        places(c, first, y, z);
        for (int k = 0; k < cube; ++k) {
            const float x = c.first.x() + c.voxel * float(k);
            Floats least = splat(1e15f);
            Ints patch = splat(-1);
            for (std::size_t i = 0; i < count; ++i) {
                const NearBall& b = balls[i];
                const float dx = x - b.centre.x();
                const Floats dy = y - b.centre.y(), dz = z - b.centre.z();
                const Floats d = squareRoot(dx * dx + dy * dy + dz * dz) - b.radius;
                const Ints nearer = d < least;
                least = nearer ? d : least;
                patch = nearer ? splat(b.patch) : patch;
            }
            store(distance + first + plane * k, least);
            store(c.part + first + plane * k, patch);
        }
    }
}

/// Everything near a leaf, relative to its centre.
struct Near {
    std::vector<NearPatch> patches, cubePatches;
    std::vector<float> above; // of capsAbout()
    std::vector<std::uint32_t> caps;
    std::vector<NearArc> arcs, cubeArcs;
    std::vector<NearCorner> corners, cubeCorners;
    std::vector<NearBall> balls, cubeBalls;
};

class Evaluator
{
public:
    /// @param[in,out] set  the caps of its boundary are taken
    Evaluator(BallUnion& set, double voxelSize, const BandWidths& width)
        : boundary_(set.boundary), probe_(set.probe), voxel_(voxelSize), inside_(width.inside),
          outside_(width.outside), caps_(arraysOf(std::move(set.boundary.caps))),
          spheres_(patchBalls(set.boundary)), patchIndex_(spheres_, {1.5, 0.0, 2.0}),
          ballIndex_(set.balls, {1.5, set.probe, 2.0}), patchOf_(set.balls.size(), -1)
    {
        for (std::size_t p = 0; p < spheres_.size(); ++p) {
            const auto placed = std::size_t(boundary_.patches[p].ball);
            patchOf_[std::size_t(boundary_.balls[placed].index)] = std::int32_t(p);
        }
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
        gather(origin, near);
        LeafMask active;
        for (int b = 0; b < 8; ++b) {
            const Coord corner(cube * (b >> 2), cube * (b >> 1 & 1), cube * (b & 1));
            Cube c;
            const float half = 0.5f * (leafDim - 1);
            c.voxel = float(voxel_);
            c.radius = float(cubeRadius * voxel_);
            c.first = (Vec3f(corner.asVec3s()) - Vec3f(half)) * c.voxel;
            c.centre = c.first + Vec3f(0.5f * (cube - 1) * c.voxel);
            float distance[cubeSize];
            evaluate(c, near, distance);
            for (int k = 0; k < cubeSize; ++k) {
                const int v = 64 * (corner.x() + k / plane) + 8 * (corner.y() + k / cube % cube) +
                              corner.z() + k % cube;
                phi[v] = std::clamp(distance[k], float(-inside_), float(outside_));
                part[v] = c.part[k];
                active.set(v, distance[k] > float(-inside_) && distance[k] < float(outside_));
            }
        }
        return active;
    }

private:
    static CapArrays arraysOf(std::vector<Cap> caps)
    {
        CapArrays out;
        for (auto* v : {&out.x, &out.y, &out.z, &out.cosine, &out.sine}) v->reserve(caps.size());
        for (const Cap& cap : caps) {
            out.x.push_back(float(cap.axis.x()));
            out.y.push_back(float(cap.axis.y()));
            out.z.push_back(float(cap.axis.z()));
            out.cosine.push_back(float(cap.cosine));
            out.sine.push_back(float(std::sqrt(1.0 - cap.cosine * cap.cosine)));
        }
        return out;
    }
    static std::vector<Ball> patchBalls(const BallBoundary& boundary)
    {
        std::vector<Ball> out;
        for (const Patch& p : boundary.patches) {
            out.push_back({Vec3f(p.centre), float(p.radius), p.ball});
        }
        return out;
    }

    void gather(const Coord& origin, Near& near) const
    {
        const Vec3d centre = (origin.asVec3d() + Vec3d(0.5 * (leafDim - 1))) * voxel_;
        const double radius = 0.5 * (leafDim - 1) * std::sqrt(3.0) * voxel_;
        const double reach = inside_ + radius;
        near.patches.clear();
        near.arcs.clear();
        near.corners.clear();
        near.balls.clear();
        ballIndex_.forEachNear(
            centre, centre, probe_ + outside_ + voxel_ + radius,
            [&](const Ball& ball, std::int32_t i) {
                const Vec3f c(Vec3d(ball.center) - centre);
                const float R = float(ball.radius + probe_);
                const double touch = R + outside_ + voxel_ + radius;
                if (c.lengthSqr() < touch * touch)
                    near.balls.push_back({c, R, c.length() - R, patchOf_[std::size_t(i)]});
            });
        // The largest overlap first: it may hold all voxels of a cube.
        std::sort(near.balls.begin(), near.balls.end(),
                  [](const NearBall& a, const NearBall& b) { return a.distance < b.distance; });
        patchIndex_.forEachNear(centre, centre, reach, [&](const Ball&, std::int32_t i) {
            const Patch& patch = boundary_.patches[i];
            const Vec3d c = patch.centre - centre;
            const double distance = c.length();
            // All parts of a patch lie on its sphere.
            if (std::abs(distance - patch.radius) > reach) return;
            near.patches.push_back(
                {Vec3f(c), float(patch.radius), patch.capsBegin, patch.capsEnd, i, 0.0f});
            const std::int32_t arcs = std::int32_t(boundary_.patches.size());
            for (std::uint32_t k = patch.arcsBegin; k < patch.arcsEnd; ++k) {
                const Arc& arc = boundary_.arcs[k];
                const Vec3d m = arc.centre - centre;
                if (distance2ToCircle(arc, -m) > reach * reach) continue;
                const float cosine = arc.ends[0] < 0 ? -2.0f : float(std::cos(arc.half));
                near.arcs.push_back({Vec3f(m), Vec3f(arc.axis), Vec3f(arc.middle),
                                     float(arc.radius), cosine, arcs + std::int32_t(k)});
            }
            const std::int32_t corners = arcs + std::int32_t(boundary_.arcs.size());
            for (std::uint32_t k = patch.cornersBegin; k < patch.cornersEnd; ++k) {
                const Vec3d p = boundary_.corners[k].position - centre;
                if (p.lengthSqr() > reach * reach) continue;
                near.corners.push_back({Vec3f(p), corners + std::int32_t(k)});
            }
        });
    }

    /// @param[in] x  relative to the circle's centre
    static double distance2ToCircle(const Arc& arc, const Vec3d& x)
    {
        const double along = x.dot(arc.axis);
        const double r = std::sqrt(std::max(0.0, x.lengthSqr() - along * along)) - arc.radius;
        return along * along + r * r;
    }

    /// @param[out] distance  signed, of the cube's voxels [Å]
    void evaluate(Cube& c, Near& near, float* distance) const
    {
        near.cubeBalls.clear();
        bool within = false;
        for (const NearBall& ball : near.balls) {
            const float d = (ball.centre - c.centre).length();
            if (d + c.radius < ball.radius) {
                within = true;
                break;
            }
            if (d - c.radius < ball.radius + float(outside_ + voxel_))
                near.cubeBalls.push_back(ball);
        }
        if (within) {
            std::fill_n(distance, cubeSize, -1.0f);
            std::fill_n(c.part, cubeSize, -1);
        } else {
            nearBalls(c, near.cubeBalls.data(), near.cubeBalls.size(), distance);
        }
        // Outside, the nearest ball has the nearest point of the boundary. Where balls meet in a
        // voxel, none of them may hold it, by rounding only.
        const float beyond = float(inside_) * 1.0001f, rounding = 1e-3f * c.voxel;
        bool anyInside = false;
        for (int k = 0; k < cubeSize; ++k) {
            const bool inside = distance[k] < rounding;
            c.least2[k] = inside ? beyond * beyond : 0.0f; // nothing is nearer than that
            if (inside) c.part[k] = -1;
            anyInside = anyInside || inside;
        }
        if (!anyInside) return;

        const float reach = beyond + c.radius;
        near.cubeCorners.clear();
        near.cubeArcs.clear();
        near.cubePatches.clear();
        for (const NearCorner& corner : near.corners) {
            if ((corner.position - c.centre).lengthSqr() < reach * reach) {
                near.cubeCorners.push_back(corner);
            }
        }
        nearCorners(c, near.cubeCorners.data(), near.cubeCorners.size());
        // A part that is farther from the centre is farther from every voxel than what it has.
        const auto farthest = [&c] {
            float most2 = 0.0f;
            for (const float d2 : c.least2) most2 = larger(most2, d2);
            return std::sqrt(most2) + c.radius;
        };
        float limit = farthest();
        for (const NearArc& arc : near.arcs) {
            const Vec3f x = c.centre - arc.centre;
            const float along = x.dot(arc.axis);
            const float r = std::sqrt(std::max(0.0f, x.lengthSqr() - along * along)) - arc.radius;
            if (along * along + r * r < limit * limit) near.cubeArcs.push_back(arc);
        }
        nearArcs(c, near.cubeArcs.data(), near.cubeArcs.size());
        limit = farthest();
        for (NearPatch& patch : near.patches) {
            patch.gap = std::abs((patch.centre - c.centre).length() - patch.radius);
            if (patch.gap < limit) near.cubePatches.push_back(patch);
        }
        // The nearest first: of the others fewer voxels then are looked at.
        std::sort(near.cubePatches.begin(), near.cubePatches.end(),
                  [](const NearPatch& a, const NearPatch& b) { return a.gap < b.gap; });
        for (const NearPatch& patch : near.cubePatches) nearPatch(c, patch, near);
        for (int k = 0; k < cubeSize; ++k) {
            const float nearest = std::sqrt(c.least2[k]);
            if (distance[k] < 0.0f || (distance[k] < rounding && nearest > 2.0f * rounding))
                distance[k] = -std::min(nearest, beyond);
        }
    }

    void nearPatch(Cube& c, const NearPatch& patch, Near& near) const
    {
        const std::size_t room = patch.capsEnd - patch.capsBegin;
        if (near.caps.size() < room) {
            near.caps.resize(room);
            near.above.resize(room);
        }
        const int count = capsAbout(Cone(c, patch.centre), caps_, patch.capsBegin, patch.capsEnd,
                                    near.above.data(), near.caps.data());
        if (count >= 0) molsurf::nearPatch(c, patch, caps_, near.caps.data(), count);
    }

    const BallBoundary& boundary_;
    double probe_, voxel_, inside_, outside_;
    const CapArrays caps_;
    std::vector<Ball> spheres_;
    BallIndex patchIndex_, ballIndex_;
    std::vector<std::int32_t> patchOf_; // of each ball, or -1
};

/// The foot of a point on the whole sphere or circle of a part, or a corner.
Vec3d footOn(const BallBoundary& boundary, std::int32_t part, const Vec3d& x)
{
    const std::size_t patches = boundary.patches.size(), arcs = boundary.arcs.size();
    const std::size_t i = std::size_t(part);
    if (i < patches) {
        const Patch& p = boundary.patches[i];
        Vec3d u = x - p.centre;
        u.normalize();
        return p.centre + p.radius * u;
    }
    if (i < patches + arcs) {
        const Arc& arc = boundary.arcs[i - patches];
        const Vec3d w = x - arc.centre;
        Vec3d u = w - w.dot(arc.axis) * arc.axis;
        u.normalize();
        return arc.centre + arc.radius * u;
    }
    return boundary.corners[i - patches - arcs].position;
}

/// Whether the nearest boundary points of two neighbouring voxels lie apart: farther than they can
/// on one smooth piece, and by more than 20 degrees as seen from the first.
bool isKink(const Vec3d& x, const Vec3d& foot, const Vec3d& nextFoot, double voxelSize)
{
    constexpr double apartVox = 2.5, cosine = 0.94;
    if ((foot - nextFoot).length() < apartVox * voxelSize) return false;
    Vec3d a = foot - x, b = nextFoot - x;
    a.normalize();
    b.normalize();
    return a.dot(b) < cosine;
}

/// The voxels of a leaf beside which the nearest boundary points lie apart.
/// @param[in] part  index of the nearest part of each voxel of the table
LeafMask kinksOf(const BallBoundary& boundary, const LeafTable& table,
                 const LeafArray<std::int32_t>& part, double voxelSize, std::size_t n)
{
    LeafMask kinks;
    LeafBlock<std::int32_t, 1> block;
    block.gather(table, part, n);
    table.active(n).forEach([&](int v) {
        const Coord local(v >> 6, v >> 3 & 7, v & 7);
        const std::int32_t* p = block.at(local.x(), local.y(), local.z());
        const Vec3d x = (table.origin(n) + local).asVec3d() * voxelSize;
        for (const int step : {block.strideX, block.strideY, block.strideZ}) {
            if (p[0] < 0 || p[step] < 0 || p[step] == p[0]) continue;
            const Coord next(step == block.strideX, step == block.strideY, step == block.strideZ);
            const Vec3d foot = footOn(boundary, p[0], x);
            const Vec3d nextFoot = footOn(boundary, p[step], x + next.asVec3d() * voxelSize);
            if (isKink(x, foot, nextFoot, voxelSize)) kinks.set(v);
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
    const Evaluator evaluator(set, voxelSize, width);
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
