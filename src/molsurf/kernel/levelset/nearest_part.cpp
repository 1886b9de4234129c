// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/nearest_part.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

// A foot on a sphere counts as covered if it comes as near to a cap as cosines are rounded. If it
// is not covered, an arc or corner about it is just as near; if it is, as where spheres meet in a
// point inside of others, nothing is.

constexpr float nowhere = 1e15f; // a distance
constexpr float farAway = 1e8f;  // a place that pads lists

/// The least of the lanes.
MOLSURF_INLINE float least(Floats x)
{
    float out = x[0];
    for (int l = 1; l < floatLanes; ++l) out = smaller(out, x[l]);
    return out;
}

} // namespace

void PartList::makeRoom(int more, int count)
{
    const auto wanted = std::size_t(size + more + floatLanes);
    if (part.size() >= wanted && numbers[std::size_t(count - 1)].size() >= wanted) return;
    for (int n = 0; n < count; ++n) numbers[std::size_t(n)].resize(2 * wanted, farAway);
    part.resize(2 * wanted);
    caps.resize(2 * wanted);
}

namespace
{

/// The coordinates of the voxels of a small cube.
struct Places {
    Floats x, y, z;
    Vec3f centre;

    MOLSURF_INLINE Places(const VoxelCube& c, int small)
    {
        for (int l = 0; l < floatLanes; ++l) {
            const openvdb::Coord at = VoxelCube::coord(floatLanes * small + l);
            x[l] = c.first.x() + c.voxel * float(at.x());
            y[l] = c.first.y() + c.voxel * float(at.y());
            z[l] = c.first.z() + c.voxel * float(at.z());
        }
        centre = Vec3f(x[0], y[0], z[0]) + Vec3f(0.5f * c.voxel);
    }
};

/// Eight parts of one kind as seen from a place, or one of them as seen from eight.
struct Seen {
    Floats x, y, z; // the place, relative to the corner or centre
};

/// Eight parts as seen from one place.
MOLSURF_INLINE Seen seen(const PartList& l, int i, const Vec3f& c)
{
    return {c.x() - load(l.numbers[PartX].data() + i), c.y() - load(l.numbers[PartY].data() + i),
            c.z() - load(l.numbers[PartZ].data() + i)};
}

MOLSURF_INLINE Floats length(const Seen& s)
{
    return squareRoot(s.x * s.x + s.y * s.y + s.z * s.z);
}

/// A place as seen from a circle.
struct FromCircle {
    Floats along, aside; // its distances from the circle's plane and axis
    Floats middle;       // its coordinate towards the middle of the arc

    /// @param[in] axis,mid  vectors, a number or eight along each axis
    template<typename V>
    MOLSURF_INLINE FromCircle(const Seen& s, const V* axis, const V* mid)
    {
        along = s.x * axis[0] + s.y * axis[1] + s.z * axis[2];
        middle = s.x * mid[0] + s.y * mid[1] + s.z * mid[2];
        // Not from squares, which cancel near the axis.
        const Floats px = s.x - along * axis[0], py = s.y - along * axis[1];
        const Floats pz = s.z - along * axis[2];
        aside = squareRoot(px * px + py * py + pz * pz);
    }
};

/// The distances of eight parts from a place, and which of them can be the nearest to a point of
/// the ball of radius `room` about it: those with a region (PartNumber) that comes so near.
struct Reach {
    Floats distance;
    Ints possible;
};

MOLSURF_INLINE Floats column(const PartList& l, int number, int i)
{
    return load(l.numbers[std::size_t(number)].data() + i);
}

MOLSURF_INLINE Reach reachOfCorners(const PartList& l, int i, const Seen& s, float room)
{
    Ints within = splat(-1);
    for (int n = NormalX; n < cornerNumbers; n += 3) {
        within &= s.x * column(l, n, i) + s.y * column(l, n + 1, i) + s.z * column(l, n + 2, i) >=
                  splat(-room);
    }
    return {length(s), within};
}

/// @param[out] certain  whether the foot lies on the arc
MOLSURF_INLINE Reach reachOfArcs(const PartList& l, int i, const Seen& s, float room, Ints& certain)
{
    alignas(32)
        const Floats axis[3] = {column(l, AxisX, i), column(l, AxisY, i), column(l, AxisZ, i)};
    alignas(32)
        const Floats mid[3] = {column(l, MiddleX, i), column(l, MiddleY, i), column(l, MiddleZ, i)};
    const FromCircle at(s, axis, mid);
    const Floats off = at.aside - column(l, PartRadius, i);
    const Floats endCosine = column(l, EndCosine, i);
    certain = at.middle >= endCosine * at.aside;
    const Floats across =
        squareRoot(larger(at.aside * at.aside - at.middle * at.middle, splat(0.0f)));
    // Signed distances, positive within, from the planes through the axis and the ends, and from
    // the cones that join the circle to the two centres.
    const Floats between = column(l, EndSine, i) * at.middle - endCosine * across;
    const Floats first = column(l, FirstSine, i) * at.along - column(l, FirstCosine, i) * off;
    const Floats second = -column(l, SecondSine, i) * at.along - column(l, SecondCosine, i) * off;
    const Floats outer = splat(-room);
    return {squareRoot(at.along * at.along + off * off),
            ((between >= outer) | certain) & (first >= outer) & (second >= outer)};
}

MOLSURF_INLINE Reach reachOfPatches(const PartList& l, int i, const Seen& s, float room)
{
    const Floats along =
        s.x * column(l, AxisX, i) + s.y * column(l, AxisY, i) + s.z * column(l, AxisZ, i);
    const Floats d2 = s.x * s.x + s.y * s.y + s.z * s.z;
    const Floats aside = squareRoot(larger(d2 - along * along, splat(0.0f)));
    // How far beyond the cone of the free part.
    const Floats beyond = column(l, FreeCosine, i) * aside - column(l, FreeSine, i) * along;
    return {size(squareRoot(d2) - column(l, PartRadius, i)), beyond <= splat(room)};
}

/// Room for rounding, and for voxels that only by rounding lie outside.
MOLSURF_INLINE float roomFor(float radius)
{
    return 1.003f * radius;
}

/// The keys of a list: the distances of its parts from the centre of a ball, `nowhere` for those
/// that are the nearest to none of its points.
/// @return the least distance of the centre from those that surely hold its foot
MOLSURF_INLINE float boundCorners(const PartList& l, const Vec3f& c, float room, float* keys)
{
    Floats sure = splat(nowhere);
    for (int i = 0; i < l.size; i += floatLanes) {
        const Ints used = laneNumbers() < splat(l.size - i);
        const Reach reach = reachOfCorners(l, i, seen(l, i, c), room);
        store(keys + i, reach.possible & used ? reach.distance : splat(nowhere));
        sure = smaller(used ? reach.distance : splat(nowhere), sure);
    }
    return least(sure);
}

MOLSURF_INLINE float boundArcs(const PartList& l, const Vec3f& c, float room, float* keys)
{
    Floats sure = splat(nowhere);
    for (int i = 0; i < l.size; i += floatLanes) {
        const Ints used = laneNumbers() < splat(l.size - i);
        Ints certain;
        const Reach reach = reachOfArcs(l, i, seen(l, i, c), room, certain);
        store(keys + i, reach.possible & used ? reach.distance : splat(nowhere));
        sure = smaller(certain & used ? reach.distance : splat(nowhere), sure);
    }
    return least(sure);
}

MOLSURF_INLINE void boundPatches(const PartList& l, const Vec3f& c, float room, float* keys)
{
    for (int i = 0; i < l.size; i += floatLanes) {
        const Ints used = laneNumbers() < splat(l.size - i);
        const Reach reach = reachOfPatches(l, i, seen(l, i, c), room);
        store(keys + i, reach.possible & used ? reach.distance : splat(nowhere));
    }
}

/// Whether no cap covers a direction from the centre of a sphere.
/// @param[in] to  any vector of that direction
MOLSURF_INLINE bool isOpen(const CapLists& caps, CapRange range, const Vec3f& to)
{
    const float r = to.length();
    for (std::uint32_t i = range.begin; i < range.end; i += floatLanes) {
        const Floats along = to.x() * load(caps.x.data() + i) + to.y() * load(caps.y.data() + i) +
                             to.z() * load(caps.z.data() + i);
        const Ints covered = (along > (load(caps.cosine.data() + i) - cosineRounding) * r) &
                             (laneNumbers() < splat(std::int32_t(range.end - i)));
        if (any(covered)) return false;
    }
    return true;
}

/// The least distance of a place from a patch that it sees, if that is below `nearest`.
MOLSURF_INLINE float nearestOpen(const PartList& l, const CapLists& caps, const Vec3f& c,
                                 const float* keys, float nearest)
{
    for (int i = 0; i < l.size; ++i) {
        if (keys[i] >= nearest) continue;
        const Vec3f centre(l.numbers[PartX][std::size_t(i)], l.numbers[PartY][std::size_t(i)],
                           l.numbers[PartZ][std::size_t(i)]);
        if (isOpen(caps, l.caps[std::size_t(i)], c - centre)) nearest = keys[i];
    }
    return nearest;
}

/// The places in memory of the keys of three kinds of parts.
struct Keys {
    float *corners, *arcs, *patches;

    Keys(std::vector<float>& memory, int cornerCount, int arcCount, int patchCount)
    {
        const auto padded = [](int count) { return std::size_t(count + floatLanes); };
        memory.resize(padded(cornerCount) + padded(arcCount) + padded(patchCount));
        corners = memory.data();
        arcs = corners + padded(cornerCount);
        patches = arcs + padded(arcCount);
    }
};

/// The parts of the boundary that are looked at, with the caps of the patches.
struct PartsAt {
    const PartList &corners, &arcs, &patches;
    const CapLists& caps;
};

/// Finds a limit for the points of a ball: no part whose key is above it is the nearest to any. If
/// the centre's nearest part is at r, theirs are at most r + 2 radius from the centre; the factor
/// and 1e-5 Å are for rounding.
/// @param[in] c,radius  of the ball
MOLSURF_INLINE float limitAt(const PartsAt& parts, const Vec3f& c, float radius, float inside,
                             const Keys& keys)
{
    const float room = roomFor(radius);
    float nearest = smaller(inside, boundCorners(parts.corners, c, room, keys.corners));
    nearest = smaller(nearest, boundArcs(parts.arcs, c, room, keys.arcs));
    boundPatches(parts.patches, c, room, keys.patches);
    nearest = nearestOpen(parts.patches, parts.caps, c, keys.patches, nearest);
    return 1.00001f * smaller(nearest + 2.0f * radius, inside + radius) + 1e-5f;
}

MOLSURF_KERNEL float limitOf(const VoxelCube& cube, const PartsAt& parts, float inside,
                             const Keys& keys)
{
    return limitAt(parts, cube.centre(), cube.radius(), inside, keys);
}

/// Takes the parts with keys below a limit. Without a branch: each index is written, and counted if
/// it belongs to the list.
MOLSURF_KERNEL void takeParts(const PartList& from, const float* keys, float limit, int numbers,
                              std::vector<std::int32_t>& list, PartList& to)
{
    list.resize(std::size_t(from.size));
    int count = 0;
    for (int i = 0; i < from.size; ++i) {
        list[std::size_t(count)] = i;
        count += keys[i] < limit;
    }
    to.clear();
    to.makeRoom(count, numbers);
    for (int n = 0; n < numbers; ++n) {
        const float* in = from.numbers[std::size_t(n)].data();
        float* out = to.numbers[std::size_t(n)].data();
        for (int i = 0; i < count; ++i) out[i] = in[list[std::size_t(i)]];
    }
    for (int i = 0; i < count; ++i) {
        to.part[std::size_t(i)] = from.part[std::size_t(list[std::size_t(i)])];
        to.caps[std::size_t(i)] = from.caps[std::size_t(list[std::size_t(i)])];
    }
    to.size = count;
}

/// The directions from the centre of a patch to the ball about a cube.
struct Cone {
    Vec3f axis;
    float cosine, sine; // of half its angle, at most a right one

    /// The cone of the directions from an apex to a ball.
    Cone(const Vec3f& centre, float radius, const Vec3f& apex)
    {
        axis = centre - apex;
        const float length = axis.length();
        if (length <= 1.0001f * radius) { // any direction
            axis = Vec3f(0.0f);
            cosine = 0.0f;
            sine = 1.0f;
            return;
        }
        axis /= length;
        sine = radius / length;
        cosine = std::sqrt(1.0f - sine * sine);
    }
};

/// The caps that may hold a direction of a cone.
/// @param[out] out  their indices; room for all
/// @return their number; -1 if one holds all of the cone
MOLSURF_KERNEL int capsAbout(const Cone& cone, const CapLists& caps, CapRange range,
                             float* __restrict above, std::int32_t* out)
{
    const float *x = caps.x.data() + range.begin, *y = caps.y.data() + range.begin;
    const float *z = caps.z.data() + range.begin, *cosine = caps.cosine.data() + range.begin;
    const float* sine = caps.sine.data() + range.begin;
    const float ax = cone.axis.x(), ay = cone.axis.y(), az = cone.axis.z();
    const int count = int(range.end - range.begin);
    std::int32_t whole = 0;
    for (int k = 0; k < count; ++k) {
        // A cap holds the cone if the angle g between the axes is below the difference of the half
        // angles A and B, and misses it if g is above their sum; none does if that is above pi.
        // Here t - s = cos g - cos(A - B) and t + s = cos g - cos(A + B).
        const float t = x[k] * ax + y[k] * ay + z[k] * az - cosine[k] * cone.cosine;
        const float s = sine[k] * cone.sine;
        whole |= (cosine[k] <= cone.cosine ? t - s : -1.0f) > cosineRounding ? 1 : 0;
        above[k] = cosine[k] < -cone.cosine ? 1.0f : t + s;
    }
    if (whole) return -1;
    int m = 0;
    for (int k = 0; k < count; ++k) {
        out[m] = std::int32_t(range.begin) + k;
        m += above[k] > -2.0f * cosineRounding;
    }
    return m;
}

/// Replaces the caps of patches by those that may cover something as seen from a cube, and drops
/// patches of which nothing is seen from there.
void uncover(const VoxelCube& cube, const CapLists& all, CubeParts& near)
{
    PartList& patches = near.patches;
    near.caps.clear();
    int kept = 0;
    for (int i = 0; i < patches.size; ++i) {
        const auto p = std::size_t(i), q = std::size_t(kept);
        const std::size_t room = patches.caps[p].end - patches.caps[p].begin;
        near.keys.resize(std::max(near.keys.size(), room));
        near.list.resize(std::max(near.list.size(), room));
        const Vec3f apex(patches.numbers[PartX][p], patches.numbers[PartY][p],
                         patches.numbers[PartZ][p]);
        const int count = capsAbout(Cone(cube.centre(), cube.radius(), apex), all, patches.caps[p],
                                    near.keys.data(), near.list.data());
        if (count < 0) continue;
        const auto begin = std::uint32_t(near.caps.size());
        for (int k = 0; k < count; ++k) {
            const auto c = std::size_t(near.list[std::size_t(k)]);
            near.caps.add(all.x[c], all.y[c], all.z[c], all.cosine[c], all.sine[c]);
        }
        for (int n = 0; n < patchNumbers; ++n)
            patches.numbers[std::size_t(n)][q] = patches.numbers[std::size_t(n)][p];
        patches.part[q] = patches.part[p];
        patches.caps[q] = {begin, std::uint32_t(near.caps.size())};
        ++kept;
    }
    patches.size = kept;
}

/// The nearest part so far of eight voxels.
struct Nearest {
    Floats distance; // or its square
    Ints part;
    Seen normal;
    Floats bend;

    /// @param[in] way  along the normal at the foot
    MOLSURF_INLINE void offer(Floats other, std::int32_t otherPart, const Seen& way,
                              Floats otherBend)
    {
        const Ints nearer = other < distance;
        distance = nearer ? other : distance;
        part = nearer ? splat(otherPart) : part;
        normal.x = nearer ? way.x : normal.x;
        normal.y = nearer ? way.y : normal.y;
        normal.z = nearer ? way.z : normal.z;
        bend = nearer ? otherBend : bend;
    }

    MOLSURF_INLINE void storeFoot(VoxelCube& cube, int small) const
    {
        store(cube.normal[0] + floatLanes * small, normal.x);
        store(cube.normal[1] + floatLanes * small, normal.y);
        store(cube.normal[2] + floatLanes * small, normal.z);
        store(cube.bend + floatLanes * small, bend);
    }
};

/// One part as seen from eight places.
MOLSURF_INLINE Seen seenFrom(const PartList& l, std::size_t i, const Places& at)
{
    return {at.x - l.numbers[PartX][i], at.y - l.numbers[PartY][i], at.z - l.numbers[PartZ][i]};
}

MOLSURF_INLINE void offerCorner(const PartList& l, std::size_t i, const Places& at, Nearest& best)
{
    const Seen s = seenFrom(l, i, at);
    best.offer(s.y * s.y + s.z * s.z + s.x * s.x, l.part[i], {-s.x, -s.y, -s.z}, Floats{});
}

/// Offers the nearest point of a circle's arc to voxels, where it lies between the arc's ends.
MOLSURF_INLINE void offerArc(const PartList& l, std::size_t i, const Places& at, Nearest& best)
{
    const float axis[3] = {l.numbers[AxisX][i], l.numbers[AxisY][i], l.numbers[AxisZ][i]};
    const float mid[3] = {l.numbers[MiddleX][i], l.numbers[MiddleY][i], l.numbers[MiddleZ][i]};
    const Seen s = seenFrom(l, i, at);
    const FromCircle from(s, axis, mid);
    const float radius = l.numbers[PartRadius][i];
    const Floats off = from.aside - radius;
    const Ints between = from.middle >= (l.numbers[EndCosine][i] - cosineRounding) * from.aside;
    const Floats d2 = from.along * from.along + off * off;
    // With the radial unit vector u, which is (s - along axis)/aside, the way is -along axis - off
    // u, and the circle's curvature counts by the cosine between them.
    const Floats onAxis = -radius * from.along;
    best.offer(
        between ? d2 : splat(nowhere), l.part[i],
        {onAxis * axis[0] - off * s.x, onAxis * axis[1] - off * s.y, onAxis * axis[2] - off * s.z},
        -off / (radius * squareRoot(larger(d2, splat(1e-12f)))));
}

/// Offers the nearest point of a ball to voxels, where no cap covers it.
MOLSURF_INLINE void offerPatch(const PartList& l, const CapLists& caps, std::size_t i,
                               const Places& at, Nearest& best)
{
    const Seen s = seenFrom(l, i, at);
    const Floats r = length(s), d = l.numbers[PartRadius][i] - r;
    const Floats d2 = d * d; // of voxels outside the ball too: the same holds for them
    Ints open = d2 < best.distance;
    if (!any(open)) return; // only directions that would be nearer are looked at further
    for (std::uint32_t k = l.caps[i].begin; k < l.caps[i].end; ++k) {
        const Floats along = s.x * caps.x[k] + s.y * caps.y[k] + s.z * caps.z[k];
        open &= along <= (caps.cosine[k] - cosineRounding) * r;
    }
    best.offer(open ? d2 : splat(nowhere), l.part[i], s, splat(1.0f / l.numbers[PartRadius][i]));
}

/// Calls f(i) for each part with a key below a limit.
template<typename F>
MOLSURF_INLINE void forEachBelow(const float* keys, int count, float limit, const F& f)
{
    for (int i = 0; i < count; i += floatLanes) {
        std::uint32_t bits = bitsOf((load(keys + i) < limit) & laneBits());
        for (; bits != 0; bits &= bits - 1) f(std::size_t(i + __builtin_ctz(bits)));
    }
}

/// The nearest of the parts about a cube, for its voxels inside. For each small cube limitAt() of
/// the ball about it chooses parts, which are offered to its eight voxels.
MOLSURF_KERNEL void takeNearest(VoxelCube& cube, const PartsAt& parts, float inside,
                                const Keys& keys)
{
    const float radius = 0.8661f * cube.voxel; // about a small cube: half its diagonal
    for (int s = 0; s < 8; ++s) {
        const Floats outer = load(cube.distance + floatLanes * s);
        const Ints wanted = outer < cube.rounding();
        if (!any(wanted)) continue;
        const Places at(cube, s);
        const float limit = limitAt(parts, at.centre, radius, inside, keys);
        Nearest best{splat(inside * inside), splat(-1), {}, {}};
        forEachBelow(keys.corners, parts.corners.size, limit,
                     [&](std::size_t i) { offerCorner(parts.corners, i, at, best); });
        forEachBelow(keys.arcs, parts.arcs.size, limit,
                     [&](std::size_t i) { offerArc(parts.arcs, i, at, best); });
        forEachBelow(keys.patches, parts.patches.size, limit,
                     [&](std::size_t i) { offerPatch(parts.patches, parts.caps, i, at, best); });

        // Outside, the boundary is as near as the nearest ball. If it is not, balls meet in the
        // voxel, and only by rounding does none of them hold it.
        const Floats d = squareRoot(best.distance);
        const Ints held = (outer < 0.0f) | (wanted & (d > 2.0f * cube.rounding()));
        store(cube.distance + floatLanes * s, held ? -smaller(d, splat(inside)) : outer);
        store(cube.part + floatLanes * s, wanted ? best.part : load(cube.part + floatLanes * s));
        const auto keep = [&](const float* from, Floats& of) {
            of = wanted ? of : load(from + floatLanes * s);
        };
        keep(cube.normal[0], best.normal.x);
        keep(cube.normal[1], best.normal.y);
        keep(cube.normal[2], best.normal.z);
        keep(cube.bend, best.bend);
        best.storeFoot(cube, s);
    }
}

/// Eight parts of a table, from a place that they are seen from.
MOLSURF_INLINE Seen seen(const PartGroup& group, const Vec3d& centre)
{
    Floats from[3];
    for (int a = 0; a < 3; ++a) {
        const double* place = group.place[a].data() + group.first;
        for (int l = 0; l < floatLanes; ++l) from[a][l] = float(centre[a] - place[l]);
    }
    return {from[0], from[1], from[2]};
}

/// Adds some of eight parts.
/// @param[in] chosen  which of them
/// @param[in] count   of their numbers
MOLSURF_INLINE void addChosen(const PartGroup& group, const Seen& s, Ints chosen, int count,
                              PartList& out)
{
    const PartList& table = group.table;
    chosen &= laneNumbers() < splat(table.size - std::int32_t(group.first));
    std::uint32_t bits = bitsOf(chosen & laneBits());
    if (bits == 0) return;
    out.makeRoom(floatLanes, count);
    alignas(32) float place[3][floatLanes];
    store(place[0], -s.x);
    store(place[1], -s.y);
    store(place[2], -s.z);
    for (; bits != 0; bits &= bits - 1) {
        const auto lane = std::size_t(__builtin_ctz(bits)), to = std::size_t(out.size++);
        for (std::size_t a = 0; a < 3; ++a) out.numbers[a][to] = place[a][lane];
        for (std::size_t n = PartRadius; n < std::size_t(count); ++n)
            out.numbers[n][to] = table.numbers[n][group.first + lane];
        out.part[to] = table.part[group.first + lane];
        if (!table.caps.empty()) out.caps[to] = table.caps[group.first + lane];
    }
}

} // namespace

MOLSURF_KERNEL void addCorners(const PartGroup& group, const Vec3d& centre, float radius,
                               float inside, PartList& out)
{
    const float room = roomFor(radius);
    const Seen s = seen(group, centre);
    const Reach reach = reachOfCorners(group.table, int(group.first), s, room);
    addChosen(group, s, reach.possible & (reach.distance <= splat(inside + room)), cornerNumbers,
              out);
}

MOLSURF_KERNEL void addArcs(const PartGroup& group, const Vec3d& centre, float radius, float inside,
                            PartList& out)
{
    const float room = roomFor(radius);
    const Seen s = seen(group, centre);
    Ints certain;
    const Reach reach = reachOfArcs(group.table, int(group.first), s, room, certain);
    addChosen(group, s, reach.possible & (reach.distance <= splat(inside + room)), arcNumbers, out);
}

MOLSURF_KERNEL void addPatches(const PartGroup& group, const Vec3d& centre, float radius,
                               float inside, PartList& out)
{
    const float room = roomFor(radius);
    const Seen s = seen(group, centre);
    const Reach reach = reachOfPatches(group.table, int(group.first), s, room);
    addChosen(group, s, reach.possible & (reach.distance <= splat(inside + room)), patchNumbers,
              out);
}

MOLSURF_KERNEL void addBalls(const PartGroup& group, const Vec3d& centre, float half, float outside,
                             PartList& out)
{
    const Seen s = seen(group, centre);
    const Floats zero = {};
    const Floats x = larger(size(s.x) - half, zero), y = larger(size(s.y) - half, zero);
    const Floats z = larger(size(s.z) - half, zero);
    const Floats reach = column(group.table, PartRadius, int(group.first)) + outside;
    addChosen(group, s, x * x + y * y + z * z <= reach * reach, ballNumbers, out);
}

namespace
{

/// Finds the balls that may be the nearest to a voxel of a cube, or hold it.
/// @param[out] list  their places
/// @return their number; -1 if one holds the whole cube
MOLSURF_INLINE int chooseBalls(const VoxelCube& cube, const PartList& balls, float outside,
                               float* keys, std::int32_t* list)
{
    const float radius = roomFor(cube.radius());
    Floats nearest = splat(outside - radius);
    for (int i = 0; i < balls.size; i += floatLanes) {
        const Ints used = laneNumbers() < splat(balls.size - i);
        const Floats d = length(seen(balls, i, cube.centre())) - column(balls, PartRadius, i);
        if (any((d < splat(-radius)) & used)) return -1;
        const Ints free = (load(balls.part.data() + i) >= 0) & used;
        nearest = smaller(free ? d : splat(nowhere), nearest);
        // One without a patch is the nearest to none, but may hold a voxel.
        store(keys + i, free | (used & (d < splat(radius))) ? d : splat(nowhere));
    }
    const float limit = least(nearest) + 2.0f * radius;
    int count = 0;
    for (int i = 0; i < balls.size; ++i) {
        list[count] = i;
        count += keys[i] < limit;
    }
    return count;
}

} // namespace

MOLSURF_KERNEL void nearestBalls(VoxelCube& cube, const PartList& balls, float outside,
                                 CubeParts& scratch)
{
    const auto room = std::size_t(balls.size + floatLanes);
    if (scratch.keys.size() < room) scratch.keys.resize(room);
    if (scratch.list.size() < room) scratch.list.resize(room);
    const int count = chooseBalls(cube, balls, outside, scratch.keys.data(), scratch.list.data());
    if (count < 0) { // all voxels are inside, which nearestParts() completes
        std::fill_n(cube.distance, VoxelCube::size, -1.0f);
        std::fill_n(cube.part, VoxelCube::size, -1);
        return;
    }
    for (int s = 0; s < 8; ++s) {
        const Places at(cube, s);
        Nearest best{splat(nowhere), splat(-1), {}, {}};
        for (int k = 0; k < count; ++k) {
            const auto i = std::size_t(scratch.list[std::size_t(k)]);
            const Seen from = seenFrom(balls, i, at);
            best.offer(length(from) - balls.numbers[PartRadius][i], balls.part[i], from, Floats{});
        }
        store(cube.distance + floatLanes * s, best.distance);
        store(cube.part + floatLanes * s, best.part);
        best.storeFoot(cube, s);
    }
}

void nearestParts(VoxelCube& cube, const LeafParts& parts, const CapLists& caps, float inside,
                  CubeParts& near)
{
    const Keys keys(near.keys, parts.corners.size, parts.arcs.size, parts.patches.size);
    const float limit =
        limitOf(cube, {parts.corners, parts.arcs, parts.patches, caps}, inside, keys);
    takeParts(parts.corners, keys.corners, limit, cornerNumbers, near.list, near.corners);
    takeParts(parts.arcs, keys.arcs, limit, arcNumbers, near.list, near.arcs);
    takeParts(parts.patches, keys.patches, limit, patchNumbers, near.list, near.patches);
    uncover(cube, caps, near);
    takeNearest(cube, {near.corners, near.arcs, near.patches, near.caps}, inside,
                Keys(near.keys, near.corners.size, near.arcs.size, near.patches.size));
}

} // namespace molsurf
