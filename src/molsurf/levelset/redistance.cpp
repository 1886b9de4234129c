// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/redistance.h"

#include "molsurf/bspline/spline.h"
#include "molsurf/core/leaf_block.h"
#include "molsurf/core/parallel.h"
#include "molsurf/levelset/nearest_point.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

/// Index of no seed.
constexpr std::int32_t noSeed = -1;

/// A closest point on the interface, in units of voxels.
struct Seed {
    Vec3d y;            // the point
    std::int32_t leaf;  // of the voxel that it is closest to
    openvdb::Vec3f n;   // unit normal there, outward
    float A[6];         // shape operator: xx yy zz xy yz xz
    float kappa, gauss; // trace and tangential determinant of A

    /// A t
    template<typename T>
    openvdb::math::Vec3<T> bend(const openvdb::math::Vec3<T>& t) const
    {
        return {A[0] * t.x() + A[3] * t.y() + A[5] * t.z(),
                A[3] * t.x() + A[1] * t.y() + A[4] * t.z(),
                A[5] * t.x() + A[4] * t.y() + A[2] * t.z()};
    }
};

/// Shape operator of the level set through a point: the Hessian over the gradient's length,
/// projected to the tangent plane, with principal curvatures limited to one a voxel, which is all a
/// grid can hold.
Seed seedAt(const Vec3d& y, const Jet& jet)
{
    Seed seed;
    seed.y = y;
    seed.leaf = noLeaf;
    const double norm = std::max(jet.gradient.length(), 1e-3), scale = 1.0 / norm;
    const Vec3d n = jet.gradient * scale;
    const double* H = jet.hessian.asPointer();
    const Vec3d Hn = Vec3d(H[0] * n.x() + H[1] * n.y() + H[2] * n.z(),
                           H[3] * n.x() + H[4] * n.y() + H[5] * n.z(),
                           H[6] * n.x() + H[7] * n.y() + H[8] * n.z()) *
                     scale;
    const Vec3d m = Hn - 0.5 * n.dot(Hn) * n; // A = H/norm - n m^T - m n^T
    double A[6] = {
        H[0] * scale - 2.0 * n.x() * m.x(),           H[4] * scale - 2.0 * n.y() * m.y(),
        H[8] * scale - 2.0 * n.z() * m.z(),           H[1] * scale - n.x() * m.y() - n.y() * m.x(),
        H[5] * scale - n.y() * m.z() - n.z() * m.y(), H[2] * scale - n.x() * m.z() - n.z() * m.x()};
    double square = A[0] * A[0] + A[1] * A[1] + A[2] * A[2] + // tr A^2 = kappa^2 - 2 K
                    2.0 * (A[3] * A[3] + A[4] * A[4] + A[5] * A[5]);
    if (square > 1.0) {
        const double limit = 1.0 / std::sqrt(square);
        for (double& a : A) a *= limit;
        square = 1.0;
    }
    const double kappa = A[0] + A[1] + A[2];
    seed.n = openvdb::Vec3f(n);
    seed.kappa = float(kappa);
    seed.gauss = float(0.5 * (kappa * kappa - square));
    std::copy_n(A, 6, seed.A);
    return seed;
}

/// The step along the surface, to second order, that brings a point of it closest to a voxel: d
/// solves (I + s A) d = t on the tangent plane.
Vec3d stepAlong(const Seed& seed, const Vec3d& voxel)
{
    const Vec3d n(seed.n), toVoxel = voxel - seed.y;
    const double s = n.dot(toVoxel);
    const Vec3d t = toVoxel - s * n;
    const Vec3d At = seed.bend(t);
    const double determinant = std::max(1.0 + s * seed.kappa + s * s * seed.gauss, 0.2);
    return (t + s * (double(seed.kappa) * t - At)) / determinant;
}

/// The farthest that a closest point may lie from its voxel, in voxels.
constexpr double farthestFoot = 1.45;

/// The closest point of a voxel next to the interface.
/// @param[in] c      coefficients of phi/h
/// @param[in] x      the voxel, relative to the leaf
Seed closestPoint(const LeafBlock<float, 3>& c, const Coord& x)
{
    const auto jetAt = [&](const Vec3d& p) {
        const Coord cell = Coord::floor(p);
        return evaluateSpline(c.at(cell.x(), cell.y(), cell.z()), c.strideX, c.strideY,
                              p - cell.asVec3d());
    };
    const Vec3d centre = x.asVec3d();
    Vec3d y = centre;
    Jet jet = jetAt(y);
    for (int i = 0; i < 6; ++i) {
        const Seed seed = seedAt(y, jet);
        // Newton toward the zero set, and along it toward x
        const Vec3d move = stepAlong(seed, centre) -
                           jet.value / std::max(jet.gradient.length(), 0.2) * Vec3d(seed.n);
        const Vec3d next = y + move;
        if ((next - centre).lengthSqr() > farthestFoot * farthestFoot) break;
        y = next;
        jet = jetAt(y);
        if (move.lengthSqr() < 1e-5) break; // the next would be its square
    }
    return seedAt(y, jet);
}

/// Distance of a voxel by the expansion about a closest point [voxel], positive on the side that
/// `sign` says. It is kept to what is possible: the point is a point of the surface, and no point
/// of the surface is farther than some 0.87 voxel from one of those known, so that with curvatures
/// up to one a voxel the distance d and r = |x - y| satisfy  r^2 - (1 + r) 0.87^2 <= d^2 <= r^2.
float distanceFrom(const Seed& seed, const Vec3d& x, float sign)
{
    const openvdb::Vec3f d(x - seed.y);
    const float s = seed.n.dot(d);
    const openvdb::Vec3f t = d - s * seed.n;
    const float tAt = t.dot(seed.bend(t));
    const float determinant = std::max(1.0f + s * seed.kappa + s * s * seed.gauss, 0.02f);
    const float distance = sign * (s + 0.5f * (tAt + s * seed.gauss * t.dot(t)) / determinant);
    const float r2 = d.dot(d), r = std::sqrt(r2);
    return std::min(std::max(distance, std::sqrt(std::max(r2 - 0.76f * (1.0f + r), 0.0f))), r);
}

/// The spline of phi/h at a point [voxel] in or beside a leaf.
Jet jetBeside(const LeafTable& table, const LeafField& coefficients, double voxel,
              std::int32_t leaf, const Vec3d& y)
{
    const Coord cell = Coord::floor(y), first = cell - table.origin(leaf) - Coord(1);
    const auto& near = table.neighbours(leaf);
    const int z0 = first.z() & 7,
              inFirst = std::min(4, leafDim - z0); // coefficients before a border
    float c[4][4][4] = {};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const int x = first.x() + i, w = first.y() + j;
            const int side = 9 * ((x >> 3) + 1) + 3 * ((w >> 3) + 1) + (first.z() >> 3) + 1;
            const int row = 64 * (x & 7) + 8 * (w & 7);
            if (near[side] != noLeaf) {
                std::copy_n(coefficients.leaf(near[side]) + row + z0, inFirst, c[i][j]);
            }
            if (inFirst < 4 && near[side + 1] != noLeaf) {
                std::copy_n(coefficients.leaf(near[side + 1]) + row, 4 - inFirst,
                            c[i][j] + inFirst);
            }
        }
    }
    Jet jet = evaluateSpline(&c[1][1][1], 16, 4, y - cell.asVec3d());
    jet.value /= voxel;
    jet.gradient /= voxel;
    jet.hessian *= 1.0 / voxel;
    return jet;
}

/// A closest point moved along the surface until it is the closest to a voxel: one Newton step on
/// the spline, which leaves an error of fourth order in the distance moved. The point as it is
/// where that does not bring it closer to the normal through the voxel.
/// @param[out] storage  for a point that was moved
const Seed& polished(const Seed& seed, const Vec3d& x, const LeafTable& table,
                     const LeafField& coefficients, double voxel, Seed& storage)
{
    // What the expansion leaves out is of third order in the distance to the normal, and of the
    // size of the change of curvature, at most some curvature a voxel.
    constexpr float negligible = 2e-4f, farthest = 2.0f; // [voxel]
    const openvdb::Vec3f offset(x - seed.y);
    const float along = seed.n.dot(offset), aside2 = offset.lengthSqr() - along * along;
    const float curvature2 = seed.kappa * seed.kappa - 2.0f * seed.gauss;
    if (aside2 * aside2 * aside2 * curvature2 < negligible * negligible) return seed;

    const Vec3d d = stepAlong(seed, x);
    if (d.lengthSqr() > farthest * farthest) return seed;
    Vec3d y = seed.y + d - 0.5 * d.dot(seed.bend(d)) * Vec3d(seed.n);
    const Jet jet = jetBeside(table, coefficients, voxel, seed.leaf, y);
    const double slope2 = jet.gradient.lengthSqr();
    if (slope2 < 0.25) return seed;
    y -= jet.value / slope2 * jet.gradient;
    storage = seedAt(y, jet);
    storage.leaf = seed.leaf;
    const Vec3d moved = x - y, n(storage.n);
    const bool nearer = moved.lengthSqr() < (x - seed.y).lengthSqr();
    return nearer && (moved - n.dot(moved) * n).lengthSqr() < aside2 ? storage : seed;
}

/// Gradient of the same expansion.
openvdb::Vec3f gradientFrom(const Seed& seed, const Vec3d& x)
{
    const openvdb::Vec3f d(x - seed.y);
    const float s = seed.n.dot(d);
    const openvdb::Vec3f t = d - s * seed.n;
    const openvdb::Vec3f At = seed.bend(t);
    const float determinant = std::max(1.0f + s * seed.kappa + s * s * seed.gauss, 0.02f);
    openvdb::Vec3f gradient = seed.n + (At + s * seed.gauss * t) / determinant;
    gradient.normalize();
    return gradient;
}

/// Whether two closest points give a voxel gradients that differ by more than 20 degrees.
bool disagree(const Seed& a, const Seed& b, const Vec3d& x)
{
    constexpr float cosine = 0.94f;
    return a.n.dot(b.n) < cosine && gradientFrom(a, x).dot(gradientFrom(b, x)) < cosine;
}

using SeedIndex = LeafArray<std::int32_t>;
using SeedBlock = LeafBlock<std::int32_t, 1>;

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

/// The seeds of all interface voxels, leaf by leaf, and where those of each leaf begin.
std::vector<Seed> findSeeds(const LeafTable& table, const LeafField& coefficients, double voxel,
                            const std::vector<LeafMask>& interface,
                            std::vector<std::size_t>& begins, const Progress& progress)
{
    begins.assign(table.size() + 1, 0);
    for (std::size_t n = 0; n < table.size(); ++n) begins[n + 1] = begins[n] + interface[n].count();
    std::vector<Seed> seeds(begins.back());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        if (!interface[n].any()) return;
        LeafBlock<float, 3> block;
        block.gather(table, coefficients, n);
        for (float& c : block.values) c *= float(1.0 / voxel);
        std::size_t k = begins[n];
        interface[n].forEach([&](int v) {
            seeds[k] = closestPoint(block, Coord(v >> 6, v >> 3 & 7, v & 7));
            seeds[k].leaf = std::int32_t(n);
            seeds[k++].y += table.origin(n).asVec3d();
        });
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
        std::size_t m = 0;
        for (std::size_t n = 0; n < out.size(); ++n) {
            while (m < table.size() && table.origin(m) < out.origin(n)) ++m;
            if (m == table.size()) break;
            if (table.origin(m) == out.origin(n)) out.active(n) &= ~wrong[m] | interface[m];
        }
    }
    return out;
}

/// The leaves of both tables, with the voxels of both active.
LeafTable merged(const LeafTable& a, const LeafTable& b)
{
    std::vector<Coord> origins;
    std::set_union(a.origins().begin(), a.origins().end(), b.origins().begin(), b.origins().end(),
                   std::back_inserter(origins));
    LeafTable out(std::move(origins));
    for (std::size_t n = 0, i = 0, j = 0; n < out.size(); ++n) {
        if (i < a.size() && a.origin(i) == out.origin(n)) out.active(n) |= a.active(i++);
        if (j < b.size() && b.origin(j) == out.origin(n)) out.active(n) |= b.active(j++);
    }
    return out;
}

/// The inner voxels of a leaf that the given level set lacks, and that no interface can cross: all
/// or none, as most of its closest points say. (Where the given leaves have a sign it stands:
/// voxels do not change sides.)
LeafMask sideOf(const Coord& origin, const std::int32_t* index, const std::vector<Seed>& seeds)
{
    double side = 0.0;
    for (int v = 0; v < leafSize; ++v) {
        if (index[v] == noSeed) continue;
        const Seed& seed = seeds[index[v]];
        side += Vec3d(seed.n).dot(origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() - seed.y);
    }
    return side < 0.0 ? ~LeafMask() : LeafMask();
}

} // namespace

DistanceBand redistance(const LeafTable& table, const LeafField& phi, double voxel, double inside,
                        double outside, double level, const Progress& progress,
                        const openvdb::CoordBBox& box)
{
    std::vector<LeafMask> inner(table.size()), outer(table.size());
    parallelFor(table.size(), progress, [&](std::size_t n) {
        inner[n] = lessThan(phi.leaf(n), 0.0f);
        outer[n] = ~inner[n];
    });
    const std::vector<LeafMask> interface = interfaceVoxels(table, inner, progress);
    std::vector<std::size_t> begins;
    const LeafField coefficients = prefilter(table, phi, progress);
    const std::vector<Seed> seeds =
        findSeeds(table, coefficients, voxel, interface, begins, progress);
    if (seeds.empty()) return DistanceBand();

    const auto steps = [&](double width) { return int(std::ceil(width / voxel)); };
    const LeafTable domain =
        clipped(merged(reachable(table, interface, outer, steps(inside), progress),
                       reachable(table, interface, inner, steps(outside), progress)),
                box);

    LeafPoints points{table, std::move(begins), std::vector<Vec3d>(seeds.size())};
    parallelFor(seeds.size(), progress, [&](std::size_t i) { points.positions[i] = seeds[i].y; });
    const double reach = std::max(inside, outside) / voxel + 1.0;
    SeedIndex index(domain.size());
    tbb::enumerable_thread_specific<NearestScratch> scratches;
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        std::fill_n(index.leaf(n), leafSize, noSeed);
        nearestPoints(points, domain.origin(n), domain.active(n), reach, scratches.local(),
                      index.leaf(n));
    });

    DistanceBand band;
    band.table = domain;
    band.phi = LeafField(domain.size());
    band.kinks.resize(domain.size());
    const float h = float(voxel);
    parallelFor(domain.size(), progress, [&](std::size_t n) {
        const std::int32_t m = table.find(domain.origin(n));
        const LeafMask negative =
            m != noLeaf ? inner[m] : sideOf(domain.origin(n), index.leaf(n), seeds);
        SeedBlock block;
        block.gather(domain, index, n);
        LeafMask active;
        LeafMask reached;
        float* phi = band.phi.leaf(n);
        for (int v = 0; v < leafSize; ++v) {
            phi[v] = negative.on(v) ? float(-inside) : float(outside);
            reached.set(v, index.leaf(n)[v] != noSeed);
        }
        Seed storage;
        reached.forEach([&](int v) {
            const Coord local(v >> 6, v >> 3 & 7, v & 7);
            const std::int32_t* p = block.at(local.x(), local.y(), local.z());
            const Vec3d x = (domain.origin(n) + local).asVec3d();
            const float sign = negative.on(v) ? -1.0f : 1.0f;
            const float width = float(negative.on(v) ? inside : outside) / h;
            float distance = distanceFrom(seeds[*p], x, sign);
            constexpr float sharpVox = 2.0f;
            if (std::abs(sign * distance - float(level) / h) < sharpVox) {
                const Seed& seed = polished(seeds[*p], x, table, coefficients, voxel, storage);
                distance = distanceFrom(seed, x, sign);
            }
            distance = std::max(distance, 1e-6f);
            if (distance >= width) return;
            phi[v] = sign * distance * h;
            active.set(v);
            for (const int step : {block.strideX, block.strideY, block.strideZ}) {
                if (p[step] == noSeed || p[step] == *p) continue;
                if (disagree(seeds[*p], seeds[p[step]], x)) band.kinks[n].set(v);
            }
        });
        band.table.active(n) = active;
    });
    return band;
}

} // namespace molsurf
