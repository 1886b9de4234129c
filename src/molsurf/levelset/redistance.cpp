// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/redistance.h"

#include "molsurf/core/parallel.h"
#include "molsurf/core/simd.h"
#include "molsurf/grid/leaf_block.h"
#include "molsurf/levelset/closest_foot.h"
#include "molsurf/levelset/foot_points.h"
#include "molsurf/levelset/jets.h"
#include "molsurf/levelset/kink.h"
#include "molsurf/levelset/nearest_point.h"
#include "molsurf/levelset/walls.h"
#include "molsurf/spline/spline.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// Index of no seed.
constexpr std::int32_t noSeed = -1;

using Lanes = FootPoints::Lanes;

/// A closest point on the interface, in units of voxels. One line of the cache.
struct alignas(64) Seed {
    Vec3f y;           // from the first voxel of its leaf
    std::int32_t leaf; // of the voxel that it is closest to
    Vec3f n;           // unit normal there, outward
    float A[6];        // shape operator: xx yy zz xy yz xz
    float kappa, gauss;

    /// A t
    Vec3f bend(const Vec3f& t) const
    {
        return {A[0] * t.x() + A[3] * t.y() + A[5] * t.z(),
                A[3] * t.x() + A[1] * t.y() + A[4] * t.z(),
                A[5] * t.x() + A[4] * t.y() + A[2] * t.z()};
    }

    /// Normal curvature along the tangential part of a vector; about the mean of all directions
    /// where the vector is along the normal.
    float curvatureAlong(const Vec3f& d) const
    {
        const Vec3f t = d - d.dot(n) * n;
        const float little = 0.01f * d.lengthSqr() + 1e-12f;
        return (t.dot(bend(t)) + little * 0.5f * kappa) / (t.lengthSqr() + little);
    }
};

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

/// @param[in] shift  from the first voxel of the seed's leaf to the origin of the lanes
void setLane(const Seed& seed, const Vec3f& shift, int lane, FootPoints& feet)
{
    for (int a = 0; a < 3; ++a) {
        feet.y[a][lane] = seed.y[a] + shift[a];
        feet.n[a][lane] = seed.n[a];
    }
    for (int i = 0; i < 6; ++i) feet.A[i][lane] = seed.A[i];
    feet.kappa[lane] = seed.kappa;
    feet.gauss[lane] = seed.gauss;
}

Vec3f lane(const Lanes* v, int l)
{
    return {v[0][l], v[1][l], v[2][l]};
}

void setLane(const Vec3f& value, int l, Lanes* v)
{
    for (int a = 0; a < 3; ++a) v[a][l] = value[a];
}

Vec3f placeOf(int v)
{
    return {float(v >> 6), float(v >> 3 & 7), float(v & 7)};
}

/// The farthest that a closest point may lie from its voxel, in voxels.
constexpr float farthestFoot = 1.45f;

/// The closest points of voxels next to the interface, by Newton's method.
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
    constexpr float small2 = 1e-5f; // the next step would be its square
    for (int i = 0;; ++i) {
        jetsIn(c, feet.y, moves, jets);
        for (int l = 0; l < lanes; ++l) moves[l] = moves[l] && step2[l] >= small2;
        if (i == steps || std::none_of(moves, moves + lanes, [](bool on) { return on; })) break;
        shapeFrom(jets, feet);
        newtonSteps(jets, feet, x, move);
        for (int l = 0; l < lanes; ++l) {
            if (!moves[l]) continue;
            const Vec3f step = lane(move, l), next = lane(feet.y, l) + step;
            moves[l] = (next - lane(x, l)).lengthSqr() <= farthestFoot * farthestFoot;
            step2[l] = step.lengthSqr();
            if (moves[l]) setLane(next, l, feet.y);
        }
    }
    shapeFrom(jets, feet);
}

using SeedIndex = LeafArray<std::int32_t>;
using SeedBlock = LeafBlock<std::int32_t, 1>;

/// Normals at the closest points of the voxels of a leaf and of those one step on; not a number
/// where there is none.
struct Normals {
    static constexpr int dim = leafDim + 1;
    static constexpr int strides[3] = {dim * dim, dim, 1};
    float n[3][dim * dim * dim];
};

/// The voxels of a leaf whose normal turns as much as beside a kink to the next voxel along an
/// axis.
MOLSURF_KERNEL void turning(const Normals& normals, int stride, LeafMask& mask)
{
    constexpr float cosine = 1.0f - 0.5f * kinkSpread * kinkSpread;
    const float *nx = normals.n[0], *ny = normals.n[1], *nz = normals.n[2];
    for (int row = 0; row < 64; ++row) {
        const int at = row / 8 * Normals::strides[0] + row % 8 * Normals::strides[1];
        int bits = 0;
        for (int i = at; i < at + 8; ++i) {
            const int j = i + stride;
            bits |= int(nx[i] * nx[j] + ny[i] * ny[j] + nz[i] * nz[j] < cosine) << (i - at);
        }
        mask.words[row >> 3] |= std::uint64_t(bits) << (8 * (row & 7));
    }
}

/// The voxels with a face neighbour of the other sign, among the active ones.
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

/// The voxels of a mask, in ascending order.
int listOf(const LeafMask& mask, std::uint16_t* voxels)
{
    int count = 0;
    mask.forEach([&](int v) { voxels[count++] = std::uint16_t(v); });
    return count;
}

/// The seeds of some interface voxels, leaf by leaf, and where those of each leaf begin.
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

/// The voxels that may lie in the result: those within `steps` of the interface voxels on one side,
/// not crossing to the other.
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

/// Computes the distances of the voxels of one leaf.
class LeafDistances
{
public:
    LeafDistances(const SparseField& coefficients, const PagedArray<Seed>& seeds,
                  const Coord& origin)
        : coefficients_(coefficients), seeds_(seeds), origin_(origin)
    {
    }

    /// From the voxel's closest point to it.
    Vec3f offset(std::int32_t seed, int v) const
    {
        return placeOf(v) - seeds_[seed].y - shift(seeds_[seed]);
    }

    /// The voxels of a leaf with a kink between them and the next voxel along an axis.
    /// @param[in]  index  the seed of each voxel of the leaf and about it
    /// @param[out] turns  those between which the normal turns as much, by curvature too
    LeafMask kinks(const SeedBlock& index, LeafMask& turns) const
    {
        constexpr int dim = Normals::dim, count = dim * dim * dim;
        std::int32_t own[count];
        for (int row = 0; row < dim * dim; ++row)
            std::copy_n(index.at(row / dim, row % dim, 0), dim, own + dim * row);
        Normals normals;
        for (int i = 0; i < count; ++i) {
            prefetch(own[std::min(i + ahead, count - 1)]);
            for (int a = 0; a < 3; ++a)
                normals.n[a][i] = own[i] == noSeed ? std::numeric_limits<float>::quiet_NaN()
                                                   : seeds_[std::size_t(own[i])].n[a];
        }
        constexpr int strides[3] = {SeedBlock::strideX, SeedBlock::strideY, SeedBlock::strideZ};
        LeafMask along[3];
        for (int axis = 0; axis < 3; ++axis) turning(normals, Normals::strides[axis], along[axis]);
        turns = along[0] | along[1] | along[2];
        LeafMask out;
        turns.forEach([&](int v) {
            const std::int32_t* p = index.at(v >> 6, v >> 3 & 7, v & 7);
            for (int axis = 0; axis < 3; ++axis) {
                if (along[axis].on(v) && isKinkBetween(*p, p[strides[axis]], v)) out.set(v);
            }
        });
        return out;
    }

    /// Where the level may be a thin wall or neck: inside near the level, where normals turn.
    /// @param[in] block  the seed of each voxel of the leaf and about it
    /// @param[in] index  of each voxel of the domain
    /// @param[in] level  [voxel]
    std::vector<ThinPlace> thinPlaces(const SeedBlock& block, const LeafTable& domain,
                                      const SeedIndex& index, const LeafMask& turns,
                                      double level) const
    {
        constexpr float shallower = 1.5f, deeper = 1.3f; // [voxel]
        // Feet whose normals have a longer mean lie on one sheet. (Of 0.8 to 0.95 the smallest one
        // with which bench/rotations.py finds the walls of 4AT1 and 1AOI that it finds without.)
        constexpr float alike = 0.9f;
        std::vector<ThinPlace> out;
        turns.forEach([&](int v) {
            const std::int32_t* p = block.at(v >> 6, v >> 3 & 7, v & 7);
            const Vec3f off = offset(*p, v);
            const float above = off.length() + float(level);
            if (off.dot(seeds_[std::size_t(*p)].n) > 0.0f || above < -shallower || above > deeper)
                return;
            std::int32_t corners[8];
            Vec3f sum(0.0f);
            int feet = 0;
            for (int k = 0; k < 8; ++k) {
                corners[k] = p[(k >> 2) * SeedBlock::strideX + (k >> 1 & 1) * SeedBlock::strideY +
                               (k & 1) * SeedBlock::strideZ];
                if (corners[k] == noSeed) continue;
                sum += seeds_[std::size_t(corners[k])].n;
                ++feet;
            }
            if (sum.lengthSqr() > alike * alike * float(feet * feet)) return;
            std::vector<std::int32_t> own(corners, corners + 8), about;
            const Coord voxel = origin_.offsetBy(v >> 6, v >> 3 & 7, v & 7);
            const std::size_t known = out.size();
            findThinPlaces(feetOf(std::move(own), 0.0), voxel.asVec3d() + Vec3d(0.5), -level, out);
            if (out.size() == known) return;
            for (auto c = openvdb::CoordBBox(voxel.offsetBy(-1), voxel.offsetBy(2)).begin(); c;
                 ++c) {
                const std::int32_t n = domain.find(*c);
                if (n == noLeaf) continue;
                about.push_back(index.leaf(
                    std::size_t(n))[openvdb::FloatTree::LeafNodeType::coordToOffset(*c)]);
            }
            const std::vector<Vec3d> near = feetOf(std::move(about), 0.5);
            for (std::size_t i = known; i < out.size(); ++i) out[i].near = near;
        });
        return out;
    }

    /// Distances without sign; those within `sharp` of the level by points that are moved to be the
    /// closest.
    /// @param[in]  index   the seed of each voxel of the leaf
    /// @param[in]  voxels  `count` voxels that have one
    /// @param[out] out     by voxel
    void compute(const std::int32_t* index, const std::uint16_t* voxels, int count,
                 const LeafMask& negative, float level, float* out)
    {
        constexpr float sharp = 2.0f;
        waiting_ = 0;
        FootPoints feet;
        alignas(64) Lanes x[3], sign, distance, aside2, step[3];
        for (int first = 0; first < count; first += lanes) {
            const int used = std::min(lanes, count - first);
            for (int l = first + lanes; l < std::min(first + 2 * lanes, count); ++l)
                prefetch(index[voxels[l]]);
            for (int l = 0; l < lanes; ++l) {
                const int v = voxels[first + std::min(l, used - 1)];
                setLane(placeOf(v), l, x);
                sign[l] = negative.on(v) ? -1.0f : 1.0f;
                setLane(seeds_[index[v]], shift(seeds_[index[v]]), l, feet);
            }
            distances(feet, x, sign, distance, aside2);
            bool any = false;
            for (int l = 0; l < used; ++l) {
                out[voxels[first + l]] = distance[l];
                any = any || std::abs(sign[l] * distance[l] - level) < sharp;
            }
            if (!any) continue;
            stepsAlong(feet, x, step);
            for (int l = 0; l < used; ++l) {
                // What the expansion leaves out is of third order in the distance to the normal,
                // and of the size of the change of curvature, at most some curvature a voxel.
                constexpr float farthest = 2.0f;
                const float a2 = aside2[l];
                const float curvature2 = feet.kappa[l] * feet.kappa[l] - 2.0f * feet.gauss[l];
                const Vec3f d = lane(step, l);
                if (std::abs(sign[l] * distance[l] - level) >= sharp ||
                    a2 * a2 * a2 * curvature2 < negligible * negligible) {
                    continue;
                }
                const int v = voxels[first + l];
                const Seed& seed = seeds_[index[v]];
                if (d.lengthSqr() > farthest * farthest) {
                    seekFoot(index[v], v, out);
                    continue;
                }
                wait_[waiting_++] = {v,
                                     index[v],
                                     sign[l],
                                     a2,
                                     lane(feet.y, l) + d - 0.5f * d.dot(seed.bend(d)) * seed.n,
                                     offset(index[v], v).lengthSqr(),
                                     0};
                while (waiting_ == lanes) polish(out);
            }
        }
        while (waiting_ > 0) polish(out);
    }

private:
    static constexpr float negligible = 2e-4f;
    static constexpr float settledEnough = 5e-4f; // after a step
    static constexpr float sharpest = 4.0f;       // curvature of a crease [1/voxel]
    static constexpr int ahead = 24;              // of reading a seed, to ask for it

    /// Closest points lie scattered in memory.
    inline __attribute__((always_inline)) void prefetch(std::int32_t seed) const
    {
        if (seed != noSeed) __builtin_prefetch(&seeds_[std::size_t(seed)]);
    }

    /// A voxel whose closest point has to be moved.
    struct Waiting {
        int v;
        std::int32_t seed;
        float sign, aside2;
        Vec3f y;      // where to
        float least2; // squared distance of the point so far
        int rounds;
    };

    /// Whether a voxel and the next one, whose normals turn, have a kink between them.
    bool isKinkBetween(std::int32_t seed, std::int32_t next, int v) const
    {
        const Seed &a = seeds_[std::size_t(seed)], &b = seeds_[std::size_t(next)];
        const float side = a.n.dot(offset(seed, v)) < 0.0f ? 1.0f : -1.0f;
        const Vec3f chord = b.y + shift(b) - a.y - shift(a);
        const float curvature =
            std::max(side * a.curvatureAlong(chord), side * b.curvatureAlong(chord));
        return isKink(chord, side * (b.n - a.n), curvature);
    }

    /// The places of seeds [voxel], without those nearer than `apart` to one before.
    std::vector<Vec3d> feetOf(std::vector<std::int32_t> seeds, double apart) const
    {
        std::sort(seeds.begin(), seeds.end());
        seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
        std::vector<Vec3d> out;
        for (const std::int32_t i : seeds) {
            if (i == noSeed) continue;
            const Seed& seed = seeds_[std::size_t(i)];
            const Vec3d y = coefficients_.table.origin(seed.leaf).asVec3d() + Vec3d(seed.y);
            const bool known = std::any_of(out.begin(), out.end(), [&](const Vec3d& o) {
                return (y - o).lengthSqr() < apart * apart;
            });
            if (!known) out.push_back(y);
        }
        return out;
    }

    Vec3f shift(const Seed& seed) const
    {
        return Vec3f((coefficients_.table.origin(seed.leaf) - origin_).asVec3s());
    }

    /// Moves closest points along the surface: one Newton step on the spline, which leaves an error
    /// of fourth order in the distance moved. They stay where that does not bring them closer to
    /// the normals through their voxels.
    void polish(float* out)
    {
        FootPoints feet;
        JetLanes jets{};
        alignas(64) Lanes x[3], sign, distance, aside2;
        alignas(64) Lanes step[3];
        bool good[lanes];
        for (int l = 0; l < lanes; ++l) {
            const Waiting& w = wait_[std::min(l, waiting_ - 1)];
            const Seed& seed = seeds_[w.seed];
            setLane(placeOf(w.v), l, x);
            sign[l] = w.sign;
            if (l >= waiting_) { // idle
                setLane(seed, Vec3f(0.0f), l, feet);
                good[l] = false;
                continue;
            }
            jetBeside(coefficients_, seed.leaf, w.y - shift(seed), l, jets);
            const Vec3f gradient = lane(jets.gradient, l);
            const float slope2 = gradient.lengthSqr();
            good[l] = slope2 >= 0.04f;
            setLane(w.y - jets.value[l] / std::max(slope2, 0.04f) * gradient, l, feet.y);
        }
        shapeFrom(jets, feet, sharpest);
        distances(feet, x, sign, distance, aside2);
        stepsAlong(feet, x, step);
        int again = 0;
        for (int l = 0; l < waiting_; ++l) {
            Waiting w = wait_[l];
            const float r2 = (lane(x, l) - lane(feet.y, l)).lengthSqr();
            const float curvature2 = feet.kappa[l] * feet.kappa[l] - 2.0f * feet.gauss[l];
            const float a2 = aside2[l];
            const Vec3f d = lane(step, l);
            constexpr int mostRounds = 3;
            if (good[l] && r2 < w.least2 && a2 < w.aside2) {
                if (a2 * a2 * a2 * curvature2 < settledEnough * settledEnough) {
                    out[w.v] = distance[l];
                    continue;
                }
                if (++w.rounds < mostRounds && d.lengthSqr() < 1.0f) {
                    w.aside2 = a2;
                    w.least2 = r2;
                    const Vec3f Ad(
                        feet.A[0][l] * d.x() + feet.A[3][l] * d.y() + feet.A[5][l] * d.z(),
                        feet.A[3][l] * d.x() + feet.A[1][l] * d.y() + feet.A[4][l] * d.z(),
                        feet.A[5][l] * d.x() + feet.A[4][l] * d.y() + feet.A[2][l] * d.z());
                    w.y = lane(feet.y, l) + d - 0.5f * d.dot(Ad) * lane(feet.n, l);
                    wait_[again++] = w;
                    continue;
                }
            }
            seekFoot(w.seed, w.v, out);
        }
        waiting_ = again;
    }

    /// The distance by a closest point that is sought until it is found: beside creases and ridges
    /// of the interface, where the surface turns within a voxel, no one step leads there.
    void seekFoot(std::int32_t index, int v, float* out) const
    {
        const Seed& seed = seeds_[std::size_t(index)];
        const Vec3d x(placeOf(v) - shift(seed));
        const auto jetAt = [&](const Vec3d& y) {
            JetLanes jets;
            jetBeside(coefficients_, seed.leaf, Vec3f(y), 0, jets);
            return jets.at(0);
        };
        if (const auto y = closestFoot(jetAt, x, Vec3d(seed.y))) out[v] = float((x - *y).length());
    }

    const SparseField& coefficients_;
    const PagedArray<Seed>& seeds_;
    const Coord origin_;
    Waiting wait_[lanes];
    int waiting_ = 0;
};

/// The seeds' places, for the search of the nearest.
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

/// Tells which leaves of a domain that a level set lacks lie inside: no interface crosses them, so
/// they are on the side of the leaves about them.
/// @param[in] inner  whether voxels of the level set's leaves are inside
std::vector<bool> innerLeaves(const LeafTable& domain, const LeafTable& table,
                              const std::vector<LeafMask>& inner)
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
    std::vector<bool> out(domain.size()), known(domain.size());
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < domain.size(); ++n) {
        if (table.find(domain.origin(n)) != noLeaf) continue;
        int sum = 0;
        for (const Neighbour& next : about) {
            const std::int32_t m = table.find(domain.origin(n) + next.offset);
            if (m == noLeaf) continue;
            sum += 2 * (inner[std::size_t(m)] & next.own).count() - next.own.count();
        }
        out[n] = sum > 0;
        if (sum == 0) continue;
        known[n] = true;
        found.push_back(n);
    }
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

/// Replaces the nearest seed of each voxel of a leaf by its signed distance; makes voxels of the
/// band active.
/// @param[in]     negative  the voxels inside
/// @param[in]     level  that gets the best distances [Å]
/// @param[in,out] band   the leaf's active voxels and kinks are set, and its values: bytes of the
///                       seeds' indices before
void takeDistances(LeafDistances leaf, const LeafMask& negative, const BandWidths& width,
                   double level, std::size_t n, DistanceBand& band)
{
    const float h = float(band.phi.voxelSize);
    float* phi = band.phi.leaf(n);
    std::int32_t own[leafSize];
    std::memcpy(own, phi, sizeof own);
    LeafMask reached;
    for (int v = 0; v < leafSize; ++v) {
        phi[v] = negative.on(v) ? float(-width.inside) : float(width.outside);
        reached.set(v, own[v] != noSeed);
    }
    std::uint16_t voxels[leafSize];
    const int count = listOf(reached, voxels);
    float distance[leafSize];
    leaf.compute(own, voxels, count, negative, float(level) / h, distance);
    LeafMask active;
    for (int k = 0; k < count; ++k) {
        const int v = voxels[k];
        const float d = std::max(distance[v], 1e-6f) * h;
        if (d >= float(negative.on(v) ? width.inside : width.outside)) continue;
        phi[v] = negative.on(v) ? -d : d;
        active.set(v);
    }
    band.phi.table.active(n) = active;
    band.kinks.active(n) &= active;
}

} // namespace

DistanceBand redistance(SparseField phi, const BandWidths& width, double level,
                        const Progress& progress, const openvdb::CoordBBox& box, bool thin)
{
    std::vector<LeafMask> inner(phi.table.size()), outer(phi.table.size());
    parallelFor(phi.table.size(), progress, [&](std::size_t n) {
        inner[n] = lessThan(phi.leaf(n), 0.0f);
        outer[n] = ~inner[n];
    });
    const std::vector<LeafMask> interface = interfaceVoxels(phi.table, inner, progress);
    std::vector<std::size_t> begins;
    const SparseField coefficients = prefilter(phi, progress);
    phi.values = LeafField();
    const LeafTable& table = coefficients.table;
    // Half of them are enough for a level that lies deep inside. Near the interface each sheet of a
    // wall or gap of one voxel needs its own.
    std::vector<LeafMask> seeded = interface;
    if (level < -2.0 * phi.voxelSize)
        for (std::size_t n = 0; n < table.size(); ++n) seeded[n] &= inner[n];
    const PagedArray<Seed> seeds = findSeeds(coefficients, seeded, begins, progress);
    DistanceBand band;
    band.phi.voxelSize = phi.voxelSize;
    if (seeds.empty()) return band;

    const auto steps = [&](double w) { return int(std::ceil(w / phi.voxelSize)); };
    const LeafTable domain =
        clipped(joined(reachable(table, interface, outer, steps(width.inside), progress),
                       reachable(table, interface, inner, steps(width.outside), progress)),
                box);
    const LeafPoints points = pointsOf(table, seeds, std::move(begins), progress);
    const double reach = std::max(width.inside, width.outside) / phi.voxelSize + 1.0;
    SeedIndex index(domain.size());
    tbb::enumerable_thread_specific<NearestScratch> scratches;
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        std::fill_n(index.leaf(n), leafSize, noSeed);
        nearestPoints(points, domain.origin(n), domain.active(n), reach, scratches.local(),
                      index.leaf(n));
    });

    band.phi.table = band.kinks = domain;
    std::vector<std::vector<ThinPlace>> places(domain.size());
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        SeedBlock block;
        block.gather(domain, index, n);
        const LeafDistances leaf(coefficients, seeds, domain.origin(n));
        LeafMask turns;
        band.kinks.active(n) = leaf.kinks(block, turns);
        if (thin) places[n] = leaf.thinPlaces(block, domain, index, turns, level / phi.voxelSize);
    });
    for (auto& some : places) std::move(some.begin(), some.end(), std::back_inserter(band.thin));
    band.phi.values = std::move(index).reused<float>();
    const std::vector<bool> innerLeaf = innerLeaves(domain, table, inner);
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        const std::int32_t m = table.find(domain.origin(n));
        takeDistances(LeafDistances(coefficients, seeds, domain.origin(n)),
                      m != noLeaf    ? inner[std::size_t(m)]
                      : innerLeaf[n] ? ~LeafMask()
                                     : LeafMask(),
                      width, level, n, band);
    });
    return band;
}

} // namespace molsurf
