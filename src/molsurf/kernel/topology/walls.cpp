// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/walls.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/levelset/closest_foot.h"

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

// Least depth of the middle of a closed wall inside the surface that the grid still resolves
// [voxel]. That of an open one outside is highestWall.
constexpr double heldDepth = 0.7;
constexpr double bumpRadius = 3.0; // [voxel]

// How far outside the middle of an open wall comes to lie, so that the film about it is too thin to
// stay, and how far from there S changes, at least bumpRadius [Å]. measured: bench/rotations.py
// vdb_molsurf frame7.xyzr --count 5, means of areas at 0.5 to 0.125 Å and largest range: 0.02 and
// 0.05 %, square on the voxels 0.17 %. With a height of 0.125 Å, when S between voxels decided what
// a wall lacks, 0.36 and 0.10 %, with a radius of 2 Å 0.28 and 0.07 %, for 0.22 and 0.05 %.
constexpr double openHeight = 0.25, openRadius = 1.5;

// How far from the place that leads to it a middle may lie [voxel].
constexpr double farthestMiddle = 2.5;

double openRadiusOf(double voxelSize) // [voxel]
{
    return std::max(bumpRadius, openRadius / voxelSize);
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

/// The middle that a place leads to, by fixed-point iteration: the feet on the sheets move toward
/// the point, the point to the centre of the smallest sphere through them. Lengths are in voxels.
/// @param[in] least,most  depths of a middle
/// @return nothing if it ends elsewhere, leaves the triangle of its feet or gets too far from the
/// start
template<typename JetAt>
std::optional<Middle> middleFrom(const JetAt& jetAt, const ThinPlace& place, double least,
                                 double most)
{
    constexpr int steps = 20;
    constexpr double atRest = 1e-3;      // a last step
    constexpr double leastWeight = 0.02; // of a foot in the centre (Rim::least)
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
        if (rim.least < leastWeight || (x - start).length() > farthestMiddle) return {};
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
    constexpr double nearer = 0.01; // by less than this a sheet is as near [voxel]
    for (const Vec3d& foot : *middle.near) {
        const auto found = closestFoot(jetAt, middle.place, foot);
        if (found && (*found - middle.place).length() < middle.depth - nearer) return false;
    }
    return true;
}

/// Trilinear interpolation of S at a point [voxel]; voxels without a leaf count as 0.
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

} // namespace

int wallReach(double voxelSize)
{
    // A voxel is a corner of the cell that leads to the start of the search for the wall.
    const double voxels = 0.5 * std::sqrt(3.0) + farthestRim + farthestMiddle;
    return int(std::ceil(bumpRadius + openRadiusOf(voxelSize) + voxels));
}

std::vector<Decision> decideWalls(const PsiJetAt& psi, const std::vector<ThinPlace>& places,
                                  double offset, double voxelSize, const Progress& progress)
{
    constexpr double same = 0.1; // [voxel]
    const double depth = offset / voxelSize;
    const double least = depth - highestWall, most = depth + deepestWall * unitAt(depth);
    const auto jetAt = inVoxels(psi, voxelSize);
    std::vector<std::optional<Middle>> found(places.size());
    parallelFor(places.size(), progress,
                [&](std::size_t i) { found[i] = middleFrom(jetAt, places[i], least, most); });
    std::vector<Middle> middles;
    for (const auto& middle : found)
        if (middle) middles.push_back(*middle);
    std::sort(middles.begin(), middles.end());
    std::vector<std::size_t> begins; // of runs that lie farther apart than `same`
    for (std::size_t i = 0; i < middles.size(); ++i)
        if (i == 0 || middles[i].place.x() - middles[i - 1].place.x() > same) begins.push_back(i);
    const std::size_t runs = begins.size();
    begins.push_back(middles.size());
    std::vector<std::vector<Middle>> walls(runs);
    parallelFor(runs, progress, [&](std::size_t r) {
        for (std::size_t i = begins[r]; i < begins[r + 1]; ++i) {
            const Middle& middle = middles[i];
            if (!isAmong(walls[r], middle.place, same) && isNearest(jetAt, middle))
                walls[r].push_back(middle);
        }
    });
    std::vector<Decision> out;
    for (const auto& some : walls)
        for (const Middle& wall : some)
            out.push_back({wall.place * voxelSize, wall.depth * voxelSize - offset - thinnestWall});
    return out;
}

void openWalls(const std::vector<Decision>& walls, SparseField& S)
{
    const double h = S.voxelSize, radius = openRadiusOf(h);
    std::vector<std::pair<Vec3d, double>> opened; // places and amplitudes
    for (const Decision& wall : walls) {
        if (wall.closed()) continue;
        // S between voxels would be too high: the middle lies on a ridge of the depth.
        const Vec3d place = wall.place / h;
        double lacks = openHeight + thinnestWall + wall.beyond;
        for (const auto& [other, amplitude] : opened)
            lacks -= amplitude * fallOf(place, other, radius);
        if (lacks <= 0.0) continue;
        addBump(place, lacks, radius, S);
        opened.emplace_back(place, lacks);
    }
}

void holdWalls(const std::vector<Decision>& walls, SparseField& S)
{
    const double h = S.voxelSize;
    for (const Decision& wall : walls) {
        const Vec3d place = wall.place / h;
        const double here = valueAt(S, place);
        const double lacks = wall.closed() ? std::min(-heldDepth * h - here, 0.0)
                                           : std::max(highestWall * h - here, 0.0);
        if (lacks != 0.0) addBump(place, lacks, bumpRadius, S);
    }
}

} // namespace molsurf
