// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/thin_places.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/grid/leaf_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

/// The places of seeds, without those nearer than `apart` to one before.
std::vector<Vec3d> feetOf(const NearestSeeds& near, std::vector<std::int32_t> seeds, double apart)
{
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    std::vector<Vec3d> out;
    for (const std::int32_t i : seeds) {
        if (i == noSeed) continue;
        const Seed& seed = near[i];
        const Vec3d y = near.coefficients.table.origin(seed.leaf).asVec3d() + Vec3d(seed.y);
        const bool known = std::any_of(out.begin(), out.end(), [&](const Vec3d& o) {
            return (y - o).lengthSqr() < apart * apart;
        });
        if (!known) out.push_back(y);
    }
    return out;
}

/// The seeds of a leaf and of the voxels about it.
struct SeedsAbout {
    LeafBlock<std::int32_t, 2> block;

    /// Voxels of leaves that the domain lacks have none.
    SeedsAbout(const NearestSeeds& near, std::size_t n)
    {
        block.gather(near.domain, near.index, n);
        const auto& leaves = near.domain.neighbours(n);
        constexpr int begins[] = {-2, 0, leafDim, leafDim + 2}; // by side
        for (int m = 0; m < 27; ++m) {
            if (leaves[std::size_t(m)] != noLeaf) continue;
            const int a = m / 9, b = m / 3 % 3, c = m % 3;
            for (int x = begins[a]; x < begins[a + 1]; ++x)
                for (int y = begins[b]; y < begins[b + 1]; ++y)
                    std::fill_n(block.at(x, y, begins[c]), begins[c + 1] - begins[c], noSeed);
        }
    }

    /// Those of a voxel of the leaf and of the next ones along the axes.
    std::array<std::int32_t, 8> corners(int v) const
    {
        std::array<std::int32_t, 8> out;
        const std::int32_t* at = block.at(v >> 6, v >> 3 & 7, v & 7);
        for (int i = 0; i < 8; ++i)
            out[std::size_t(i)] =
                at[(i >> 2) * block.strideX + (i >> 1 & 1) * block.strideY + (i & 1)];
        return out;
    }

    /// Those of a cube of voxels.
    /// @param[in] v           a voxel of the leaf
    /// @param[in] first,last  from it, along each axis
    std::vector<std::int32_t> in(int v, int first, int last) const
    {
        const int edge = last - first + 1;
        std::vector<std::int32_t> out;
        out.reserve(std::size_t(edge * edge * edge));
        for (int x = (v >> 6) + first; x <= (v >> 6) + last; ++x)
            for (int y = (v >> 3 & 7) + first; y <= (v >> 3 & 7) + last; ++y)
                out.insert(out.end(), block.at(x, y, (v & 7) + first),
                           block.at(x, y, (v & 7) + last) + 1);
        return out;
    }
};

/// Whether the closest points of the corners of a cell lie on one sheet: their normals have a long
/// mean.
bool onOneSheet(const NearestSeeds& near, const std::array<std::int32_t, 8>& corners)
{
    // Of 0.8 to 0.95 the smallest one with which bench/rotations.py finds the walls of 4AT1 and
    // 1AOI that it finds without.
    constexpr float alike = 0.9f;
    Vec3f sum(0.0f);
    int feet = 0;
    for (const std::int32_t seed : corners) {
        if (seed == noSeed) continue;
        sum += near[seed].n;
        ++feet;
    }
    return sum.lengthSqr() > alike * alike * float(feet * feet);
}

/// The thin places of a leaf.
std::vector<ThinPlace> thinPlacesIn(const NearestSeeds& near, std::size_t n, const LeafMask& turns,
                                    double depth)
{
    constexpr float beside = 1.5f; // the depth: voxels that are tried [voxel]
    const Coord& origin = near.domain.origin(n);
    std::vector<ThinPlace> out;
    std::optional<SeedsAbout> about; // once it is needed
    turns.forEach([&](int v) {
        const Seed& own = near[near.index.leaf(n)[v]];
        const Vec3f offset = near.offset(own, origin, v);
        if (offset.dot(own.n) > 0.0f || std::abs(offset.length() - float(depth)) > beside) return;
        const Coord voxel = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7);
        if (!about) about.emplace(near, n);
        const std::array<std::int32_t, 8> corners = about->corners(v);
        if (onOneSheet(near, corners)) return;
        const std::size_t known = out.size();
        findThinPlaces(feetOf(near, {corners.begin(), corners.end()}, 0.0),
                       voxel.asVec3d() + Vec3d(0.5), depth, out);
        if (out.size() == known) return;
        const std::vector<Vec3d> feet = feetOf(near, about->in(v, -1, 2), 0.5);
        for (std::size_t i = known; i < out.size(); ++i) out[i].near = feet;
    });
    return out;
}

} // namespace

double unitAt(double depth)
{
    return std::min(depth / 2.8, 1.0); // a probe of 1.4 Å on voxels of 0.5 Å
}

Rim rimOf(const std::vector<Vec3d>& y)
{
    if (y.size() == 2) return {0.5 * (y[0] + y[1]), 0.5 * (y[1] - y[0]).length(), 0.5};
    // The circumcentre by barycentric weights, a^2 (b^2 + c^2 - a^2) at the corner opposite to a.
    const double a2 = (y[1] - y[2]).lengthSqr(), b2 = (y[2] - y[0]).lengthSqr(),
                 c2 = (y[0] - y[1]).lengthSqr();
    Vec3d w(a2 * (b2 + c2 - a2), b2 * (c2 + a2 - b2), c2 * (a2 + b2 - c2));
    const double sum = w[0] + w[1] + w[2];
    if (sum < 1e-6) return {y[0], 0.0, -1.0}; // in one line: 16 times the squared area is 0
    w /= sum;
    const Vec3d centre = w[0] * y[0] + w[1] * y[1] + w[2] * y[2];
    return {centre, (centre - y[0]).length(), std::min({w[0], w[1], w[2]})};
}

void findThinPlaces(const std::vector<Vec3d>& feet, const Vec3d& middle, double depth,
                    std::vector<ThinPlace>& out)
{
    const double unit = unitAt(depth), farthest = farthestRim * unit, doubt = 0.5 * unit;
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
        const Rim rim = rimOf(some);
        if (rim.least > 0.0 && rim.radius > depth - highestWall - doubt &&
            rim.radius < depth + deepestWall * unit + doubt &&
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

std::vector<ThinPlace> thinPlaces(const NearestSeeds& near, const std::vector<LeafMask>& turns,
                                  double depth, const Progress& progress)
{
    std::vector<std::vector<ThinPlace>> found(near.domain.size());
    parallelFor(near.domain.size(), progress,
                [&](std::size_t n) { found[n] = thinPlacesIn(near, n, turns[n], depth); });
    std::vector<ThinPlace> out;
    for (auto& some : found) std::move(some.begin(), some.end(), std::back_inserter(out));
    return out;
}

} // namespace molsurf
