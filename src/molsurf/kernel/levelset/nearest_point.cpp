// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/nearest_point.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Coord;

namespace
{

constexpr int cubeEdge = 4, plane = cubeEdge * cubeEdge;
static_assert(plane % floatLanes == 0 && leafDim % cubeEdge == 0);
constexpr float cubeHalf = 0.5f * (cubeEdge - 1); // of the box of its voxels' centres

/// Appends i + k to a list of m for every lane k that is on, which is -1. Each is written.
/// @return the new length
MOLSURF_INLINE int appendLanes(const Ints& on, int i, std::int32_t* list, int m)
{
    if (!any(on)) return m;
    for (int k = 0; k < floatLanes; ++k) {
        list[m] = i + k;
        m -= on[k];
    }
    return m;
}

/// The nearest of some points to a place.
/// @param[in] count  a multiple of `floatLanes`, positive
MOLSURF_KERNEL int nearestOf(const float* x, const float* y, const float* z, int count, float px,
                             float py, float pz, float& distance2)
{
    Floats least = splat(1e30f);
    Ints best = {};
    for (int i = 0; i < count; i += floatLanes) {
        const Floats dx = load(x + i) - px;
        const Floats dy = load(y + i) - py;
        const Floats dz = load(z + i) - pz;
        const Floats d2 = dx * dx + dy * dy + dz * dz;
        const Ints nearer = d2 < least;
        least = nearer ? d2 : least;
        best = nearer ? splat(i) : best;
    }
    int lane = 0;
    for (int k = 1; k < floatLanes; ++k) {
        if (least[k] < least[lane]) lane = k;
    }
    distance2 = least[lane];
    return best[lane] + lane;
}

/// The points that may be the nearest to some place in a box about a centre.
/// @param[in]  y0     the nearest to the centre
/// @param[in]  half   half the edge of the box
/// @param[out] out    their indices
/// @return their number
MOLSURF_KERNEL int candidates(const float* x, const float* y, const float* z, int count, float cx,
                              float cy, float cz, int y0, float half, std::int32_t* out)
{
    const float x0 = x[y0], yy0 = y[y0], z0 = z[y0];
    const float d02 = (x0 - cx) * (x0 - cx) + (yy0 - cy) * (yy0 - cy) + (z0 - cz) * (z0 - cz);
    int m = 0;
    for (int i = 0; i < count; i += floatLanes) {
        const Floats px = load(x + i), py = load(y + i), pz = load(z + i);
        const Floats dx = px - cx, dy = py - cy, dz = pz - cz;
        const Floats ex = px - x0, ey = py - yy0, ez = pz - z0;
        const Floats more = dx * dx + dy * dy + dz * dz - d02;
        const Floats apart = larger(ex, -ex) + larger(ey, -ey) + larger(ez, -ez);
        const Ints good = more <= 2.0f * half * apart + 1e-3f ? splat(-1) : Ints{};
        m = appendLanes(good, i, out, m);
    }
    return m;
}

/// The nearest of some points to each voxel of a cube.
/// @param[in]  cx,cy,cz  the cube's first voxel
/// @param[out] best      positions in the list, by 16 x + 4 y + z
MOLSURF_KERNEL void nearestInCube(const float* x, const float* y, const float* z, int count,
                                  float cx, float cy, float cz, std::int32_t* best, float* least)
{
    for (int part = 0; part < plane; part += floatLanes) { // half of each plane of 4 x 4 voxels
        Floats vy, vz;
        for (int k = 0; k < floatLanes; ++k) {
            vy[k] = cy + float((part + k) / cubeEdge);
            vz[k] = cz + float((part + k) % cubeEdge);
        }
        Floats nearest[cubeEdge];
        Ints which[cubeEdge] = {};
        for (Floats& d : nearest) d = splat(1e30f);
        for (int i = 0; i < count; ++i) {
            const Floats dy = vy - y[i], dz = vz - z[i];
            const Floats aside = dy * dy + dz * dz;
            for (int k = 0; k < cubeEdge; ++k) {
                const float dx = x[i] - cx - float(k);
                const Floats d2 = aside + dx * dx;
                const Ints nearer = d2 < nearest[k];
                nearest[k] = nearer ? d2 : nearest[k];
                which[k] = nearer ? splat(i) : which[k];
            }
        }
        for (int k = 0; k < cubeEdge; ++k) {
            store(least + plane * k + part, nearest[k]);
            store(best + plane * k + part, which[k]);
        }
    }
}

constexpr float leafHalf = 3.5f;               // of the box of a leaf's voxels' centres
constexpr double leafRadius = 3.5 * 1.7320508; // of the ball about it

/// The points within reach of the box of a leaf's voxels, about 0.
/// @param[in]     in        coordinates, `floatLanes` more than there are points
/// @param[in]     shift     to add to them
/// @param[out]    out       indices of the points; room for `floatLanes` more
/// @param[in,out] nearest2  least squared distance of points from 0
/// @return their number
MOLSURF_KERNEL int withinReach(const float* const* in, const float* shift, int count, float reach,
                               std::int32_t* out, float& nearest2)
{
    const Ints lane = laneNumbers();
    Floats least = splat(1e30f);
    int m = 0;
    for (int i = 0; i < count; i += floatLanes) {
        Floats inside2 = {}, outside2 = {};
        for (int a = 0; a < 3; ++a) {
            const Floats place = load(in[a] + i) + shift[a];
            const Floats p = lane < count - i ? place : splat(1e15f);
            const Floats beyond = larger((p < 0.0f ? -p : p) - leafHalf, Floats{});
            inside2 += p * p;
            outside2 += beyond * beyond;
        }
        least = smaller(inside2, least);
        const Ints good = outside2 <= reach * reach ? splat(-1) : Ints{};
        m = appendLanes(good, i, out, m);
    }
    for (int k = 0; k < floatLanes; ++k) nearest2 = smaller(nearest2, least[k]);
    return m;
}

/// The distance between the boxes of voxels of two leaves.
double gapBetween(const Coord& offset)
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double d = std::max(std::abs(offset[k]) - 7, 0);
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// The leaves that may hold points within reach of a voxel of a leaf, nearest first.
void prepare(double reach, NearestScratch& s)
{
    const double farthest = reach + double(farthestSeed);
    const int R = int(std::ceil(farthest / leafDim));
    s.reach = reach;
    s.offsets.clear();
    for (int dx = -R; dx <= R; ++dx) {
        for (int dy = -R; dy <= R; ++dy) {
            for (int dz = -R; dz <= R; ++dz) {
                const Coord offset(leafDim * dx, leafDim * dy, leafDim * dz);
                const double gap = gapBetween(offset);
                if (gap <= farthest) s.offsets.push_back({gap, offset});
            }
        }
    }
    std::stable_sort(s.offsets.begin(), s.offsets.end(),
                     [](const auto& a, const auto& b) { return a.gap < b.gap; });
}

/// Gathers the points that may be nearest to a voxel of a leaf, relative to its centre, padded to a
/// multiple of `floatLanes` by points farther than any.
/// @return their number with the padding
int gatherPoints(const LeafPoints& points, const Coord& origin, double reach, NearestScratch& s)
{
    if (s.reach != reach) prepare(reach, s);
    double limit = reach;
    float nearest2 = 1e30f;
    std::size_t count = 0;
    for (const auto& [gap, offset] : s.offsets) {
        if (gap > limit + double(farthestSeed)) break;
        const std::int32_t n = points.table.find(origin + offset);
        if (n == noLeaf) continue;
        const std::size_t begin = points.begins[n], more = points.begins[n + 1] - begin;
        if (more == 0) continue;
        if (count + more + floatLanes > s.x.size()) {
            const std::size_t room = 2 * (count + more + floatLanes);
            for (auto* v : {&s.x, &s.y, &s.z}) v->resize(room);
            s.index.resize(room);
            s.nearIndex.resize(room);
        }
        const Coord from = offset - Coord(leafDim / 2);
        const float shift[3] = {float(from.x()) + 0.5f, float(from.y()) + 0.5f,
                                float(from.z()) + 0.5f};
        const float* in[3] = {points.x.data() + begin, points.y.data() + begin,
                              points.z.data() + begin};
        const int near =
            withinReach(in, shift, int(more), float(limit), s.nearIndex.data(), nearest2);
        for (int k = 0; k < near; ++k, ++count) {
            const auto i = std::size_t(s.nearIndex[std::size_t(k)]);
            s.x[count] = in[0][i] + shift[0];
            s.y[count] = in[1][i] + shift[1];
            s.z[count] = in[2][i] + shift[2];
            s.index[count] = std::int32_t(begin + i);
        }
        // No voxel is farther from its nearest point than the centre from its own plus the radius.
        limit = std::min(reach, std::sqrt(double(nearest2)) + leafRadius);
    }
    for (; count % floatLanes != 0; ++count) {
        s.x[count] = s.y[count] = s.z[count] = 1e15f;
        s.index[count] = -1;
    }
    return int(count);
}

} // namespace

void nearestPoints(const LeafPoints& points, const Coord& origin, const LeafMask& mask,
                   double reach, NearestScratch& s, std::int32_t* out)
{
    const int count = gatherPoints(points, origin, reach, s);
    if (count == 0) {
        mask.forEach([&](int v) { out[v] = -1; });
        return;
    }
    s.nearX.resize(std::size_t(count));
    s.nearY.resize(std::size_t(count));
    s.nearZ.resize(std::size_t(count));
    for (int b = 0; b < 8; ++b) {
        const int bx = b >> 2, by = b >> 1 & 1, bz = b & 1;
        // The bits of the cube's voxels in the words of x (LeafMask).
        const std::uint64_t columns = std::uint64_t(0x0f0f0f0f) << (32 * by + 4 * bz);
        std::uint64_t any = 0;
        for (int x = 0; x < cubeEdge; ++x) any |= mask.words[cubeEdge * bx + x] & columns;
        if (any == 0) continue;

        const float cx = float(cubeEdge * bx) - 3.5f, cy = float(cubeEdge * by) - 3.5f,
                    cz = float(cubeEdge * bz) - 3.5f;
        constexpr float half = cubeHalf;
        float distance2;
        const int y0 = nearestOf(s.x.data(), s.y.data(), s.z.data(), count, cx + half, cy + half,
                                 cz + half, distance2);
        const int near = candidates(s.x.data(), s.y.data(), s.z.data(), count, cx + half, cy + half,
                                    cz + half, y0, half, s.nearIndex.data());
        for (int i = 0; i < near; ++i) {
            s.nearX[i] = s.x[s.nearIndex[i]];
            s.nearY[i] = s.y[s.nearIndex[i]];
            s.nearZ[i] = s.z[s.nearIndex[i]];
        }
        std::int32_t best[cubeEdge * plane];
        float least[cubeEdge * plane];
        nearestInCube(s.nearX.data(), s.nearY.data(), s.nearZ.data(), near, cx, cy, cz, best,
                      least);
        const float reach2 = float(reach * reach);
        for (int row = 0; row < plane; ++row) { // of the voxels along z
            const int at = 8 * (cubeEdge * bx + row / cubeEdge) + cubeEdge * by + row % cubeEdge;
            const int bits = mask.row(at) >> (cubeEdge * bz);
            for (int z = 0; z < cubeEdge; ++z) {
                const int k = cubeEdge * row + z;
                if ((bits >> z & 1) != 0)
                    out[8 * at + cubeEdge * bz + z] =
                        least[k] <= reach2 ? s.index[s.nearIndex[best[k]]] : -1;
            }
        }
    }
}

} // namespace molsurf
