// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/walls.h"

#include "molsurf/core/parallel.h"
#include "molsurf/levelset/closest_foot.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;

namespace
{

// Least depth of the middle of a closed wall inside the surface, and of an open one outside, that
// the grid still resolves [voxel].
constexpr double heldDepth = 0.7, heldHeight = 0.25;
constexpr double deepest = 1.2; // of a wall that voxels or the rounding of ridges may open [voxel]
constexpr double bumpRadius = 3.0; // [voxel]

// How far outside the middle of an open wall comes to lie, so that the film about it is too thin to
// stay, and how far from there S changes, at least bumpRadius [Å]. measured: bench/rotations.py
// vdb_molsurf frame7.xyzr --count 5, means of areas at 0.5 to 0.125 Å and largest range: 0.02 and
// 0.05 %, square on the voxels 0.17 %. With a height of 0.125 Å, when S between voxels decided what
// a wall lacks, 0.36 and 0.10 %, with a radius of 2 Å 0.28 and 0.07 %, for 0.22 and 0.05 %.
constexpr double openHeight = 0.25, openRadius = 1.5;

double openRadiusOf(double voxelSize) // [voxel]
{
    return std::max(bumpRadius, openRadius / voxelSize);
}

/// Unit of lengths near a wall [voxel]: as voxels come near to the depth, everything would be near.
double unitAt(double depth)
{
    return std::min(depth / 2.8, 1.0); // a probe of 1.4 Å on voxels of 0.5 Å
}

/// The smallest sphere through two or three points.
struct Rim {
    Vec3d centre;
    double radius;
    double least; ///< the smallest weight of a point in the centre: negative if it is not amid them
};

Rim rimOf(const std::vector<Vec3d>& y)
{
    if (y.size() == 2) return {0.5 * (y[0] + y[1]), 0.5 * (y[1] - y[0]).length(), 0.5};
    const double a2 = (y[1] - y[2]).lengthSqr(), b2 = (y[2] - y[0]).lengthSqr(),
                 c2 = (y[0] - y[1]).lengthSqr();
    Vec3d w(a2 * (b2 + c2 - a2), b2 * (c2 + a2 - b2), c2 * (a2 + b2 - c2));
    const double sum = w[0] + w[1] + w[2];
    if (sum < 1e-6) return {y[0], 0.0, -1.0};
    w /= sum;
    const Vec3d centre = w[0] * y[0] + w[1] * y[1] + w[2] * y[2];
    return {centre, (centre - y[0]).length(), std::min({w[0], w[1], w[2]})};
}

/// psi with lengths in voxels.
auto inVoxels(const PsiJetAt& psi, double h)
{
    return [&psi, h](const Vec3d& y) {
        const PsiJet jet = psi(y * h);
        return Jet{jet.psi, jet.gradient * h, jet.hessian * (h * h)};
    };
}

/// The middle of a wall, and what is known of it.
struct Middle {
    Vec3d place; // [voxel]
    double depth;
    const std::vector<Vec3d>* near;
    bool operator<(const Middle& o) const { return place < o.place; }
};

/// The middle that a place leads to: it moves amid the points of the sheets that are closest to it,
/// until it rests. Lengths are in voxels.
template<typename JetAt>
std::optional<Middle> middleFrom(const JetAt& jetAt, const ThinPlace& place, double least,
                                 double most)
{
    constexpr int steps = 20;
    constexpr double atRest = 1e-3, farthest = 2.5, doubt = 0.3;
    constexpr double leastWeight = 0.02;
    std::vector<Vec3d> y = place.sheets;
    const Vec3d start = rimOf(y).centre;
    Vec3d x = start;
    for (int i = 0; i < steps; ++i) {
        for (Vec3d& foot : y) {
            const auto found = closestFoot(jetAt, x, foot, 1);
            if (!found) return {};
            foot = *found;
        }
        const Rim rim = rimOf(y);
        const double step = (rim.centre - x).length();
        x = rim.centre;
        if (rim.least < leastWeight || rim.radius < least - doubt || rim.radius > most + doubt ||
            (x - start).length() > farthest)
            return {};
        if (step < atRest || i == steps - 1) {
            if (rim.radius < least || rim.radius > most) return {};
            return Middle{x, rim.radius, &place.near};
        }
    }
    return {};
}

/// Whether no sheet is nearer to a middle than those that it is amid.
template<typename JetAt>
bool isNearest(const JetAt& jetAt, const Middle& middle)
{
    constexpr double nearer = 0.01, beyond = 0.5; // [voxel]
    for (const Vec3d& foot : *middle.near) {
        if ((foot - middle.place).length() > middle.depth + beyond) continue;
        const auto found = closestFoot(jetAt, middle.place, foot);
        if (found && (*found - middle.place).length() < middle.depth - nearer) return false;
    }
    return true;
}

/// S between voxels, linear along each axis.
double valueAt(const SparseField& S, const Vec3d& x)
{
    const Coord low = Coord::floor(x);
    const Vec3d t = x - low.asVec3d();
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const Coord step(k >> 2, k >> 1 & 1, k & 1), voxel = low + step;
        const std::int32_t n = S.table.find(voxel);
        if (n == noLeaf) continue;
        double weight = 1.0;
        for (int a = 0; a < 3; ++a) weight *= step[a] ? t[a] : 1.0 - t[a];
        sum +=
            weight *
            double(S.leaf(std::size_t(n))[openvdb::FloatTree::LeafNodeType::coordToOffset(voxel)]);
    }
    return sum;
}

/// (1 - t^2)^3, t being the distance in radii, up to 1.
double fallOf(const Vec3d& x, const Vec3d& place, double radius)
{
    const double fall = std::max(0.0, 1.0 - (x - place).lengthSqr() / (radius * radius));
    return fall * fall * fall;
}

/// Adds a bump to S: amplitude times fallOf().
void addBump(const Vec3d& place, double amplitude, double radius, SparseField& S)
{
    const Coord low = Coord::ceil(place - Vec3d(radius)),
                high = Coord::floor(place + Vec3d(radius));
    for (auto voxel = openvdb::CoordBBox(low, high).begin(); voxel; ++voxel) {
        const double fall = fallOf((*voxel).asVec3d(), place, radius);
        const std::int32_t n = S.table.find(*voxel);
        if (fall <= 0.0 || n == noLeaf) continue;
        const int v = int(openvdb::FloatTree::LeafNodeType::coordToOffset(*voxel));
        if (S.table.active(n).on(v)) S.leaf(n)[v] += float(amplitude * fall);
    }
}

/// How much thicker a wall is than the thinnest that is closed, halved [Å].
double beyondOf(const Wall& wall, double offset)
{
    return wall.depth - offset - thinnestWall;
}

} // namespace

int wallReach(double voxelSize)
{
    constexpr double told = 5.0; // how far from a wall voxels tell of it [voxel]
    return int(std::ceil(bumpRadius + openRadiusOf(voxelSize) + told));
}

void findThinPlaces(const std::vector<Vec3d>& feet, const Vec3d& middle, double depth,
                    std::vector<ThinPlace>& out)
{
    const double unit = unitAt(depth), farthest = 1.2 * unit, doubt = 0.5 * unit;
    const double apart = std::max(0.5 * depth, 1.0);
    // The mean of the feet on a sheet is about the foot of the middle.
    struct Sheet {
        Vec3d first, sum;
        int count;
        Vec3d foot() const { return sum / count; }
    };
    std::vector<Sheet> sheets;
    for (const Vec3d& foot : feet) {
        const auto same = std::find_if(sheets.begin(), sheets.end(), [&](const Sheet& s) {
            return (foot - s.first).lengthSqr() < apart * apart;
        });
        if (same == sheets.end()) {
            sheets.push_back({foot, foot, 1});
        } else {
            same->sum += foot;
            ++same->count;
        }
    }
    if (sheets.size() < 2) return;
    const auto add = [&](std::vector<Vec3d> some) {
        constexpr double leastWeight = -0.2;
        const Rim rim = rimOf(some);
        if (rim.least > leastWeight && rim.radius > depth - heldHeight - doubt &&
            rim.radius < depth + deepest * unit + doubt &&
            (rim.centre - middle).length() < farthest)
            out.push_back({std::move(some), {}});
    };
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        for (std::size_t j = i + 1; j < sheets.size(); ++j) {
            add({sheets[i].foot(), sheets[j].foot()});
            for (std::size_t k = j + 1; k < sheets.size(); ++k)
                add({sheets[i].foot(), sheets[j].foot(), sheets[k].foot()});
        }
    }
}

std::vector<Wall> findWalls(const PsiJetAt& psi, const std::vector<ThinPlace>& places,
                            double offset, double voxelSize, const Progress& progress)
{
    constexpr double same = 0.1; // [voxel]
    const double depth = offset / voxelSize;
    const auto jetAt = inVoxels(psi, voxelSize);
    std::vector<std::optional<Middle>> found(places.size());
    parallelFor(places.size(), progress, [&](std::size_t i) {
        found[i] =
            middleFrom(jetAt, places[i], depth - heldHeight, depth + deepest * unitAt(depth));
    });
    std::vector<Middle> middles;
    for (const auto& middle : found)
        if (middle) middles.push_back(*middle);
    std::sort(middles.begin(), middles.end());
    std::vector<Wall> walls;
    for (const Middle& middle : middles) {
        if (!standsAmong(walls, middle.place, same) && isNearest(jetAt, middle))
            walls.push_back({middle.place, middle.depth * voxelSize});
    }
    return walls;
}

void openWalls(const std::vector<Wall>& walls, double offset, SparseField& S)
{
    const double radius = openRadiusOf(S.voxelSize);
    std::vector<std::pair<Vec3d, double>> opened; // places and amplitudes
    for (const Wall& wall : walls) {
        if (beyondOf(wall, offset) > 0.0) continue;
        // S between voxels would be too high: the middle lies on a ridge of the depth.
        double lacks = openHeight - (offset - wall.depth);
        for (const auto& [place, amplitude] : opened)
            lacks -= amplitude * fallOf(wall.place, place, radius);
        if (lacks <= 0.0) continue;
        addBump(wall.place, lacks, radius, S);
        opened.emplace_back(wall.place, lacks);
    }
}

GapReport decideWalls(const std::vector<Wall>& walls, double offset, SparseField& S)
{
    GapReport done;
    done.nearest = deepest * S.voxelSize;
    for (const Wall& wall : walls) {
        const double beyond = beyondOf(wall, offset), here = valueAt(S, wall.place);
        ++done.found;
        done.closed += beyond > 0.0;
        done.nearest = std::min(done.nearest, std::abs(beyond));
        const double lacks = beyond > 0.0 ? std::min(-heldDepth * S.voxelSize - here, 0.0)
                                          : std::max(heldHeight * S.voxelSize - here, 0.0);
        if (lacks != 0.0) addBump(wall.place, lacks, bumpRadius, S);
    }
    return done;
}

} // namespace molsurf
