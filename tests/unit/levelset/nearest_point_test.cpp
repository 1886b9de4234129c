// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/nearest_point.h"

#include "support/fields.h"

#include <gtest/gtest.h>

#include <random>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

/// Random points beside the voxels of a few leaves, some of which hold none.
LeafPoints scattered(const LeafTable& table, int perLeaf)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.9, 7.9);
    LeafPoints points{table, {0}, {}, {}, {}};
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (int i = 0; i < (n % 3 == 0 ? 0 : perLeaf); ++i) {
            for (auto* v : {&points.x, &points.y, &points.z}) v->push_back(float(place(random)));
        }
        points.begins.push_back(points.x.size());
    }
    for (auto* v : {&points.x, &points.y, &points.z}) v->resize(v->size() + LeafPoints::padding);
    return points;
}

/// Where all points are [voxel].
std::vector<Vec3d> positionsOf(const LeafPoints& points)
{
    std::vector<Vec3d> out;
    for (std::size_t n = 0; n < points.table.size(); ++n) {
        for (std::size_t i = points.begins[n]; i < points.begins[n + 1]; ++i)
            out.push_back(points.table.origin(n).asVec3d() +
                          Vec3d(points.x[i], points.y[i], points.z[i]));
    }
    return out;
}

LeafTable someLeaves()
{
    std::vector<Coord> origins;
    for (int x = -2; x < 2; ++x) {
        for (int y = 0; y < 3; ++y) origins.push_back(Coord(8 * x, 8 * y, 8 * (x + y)));
    }
    return LeafTable(origins);
}

// Against all points, one by one: near the points, far from them, and out of reach.
TEST(NearestPoints, AreTheNearestOfAll)
{
    const LeafTable table = someLeaves();
    NearestScratch scratch;
    for (const int perLeaf : {1, 40}) {
        const LeafPoints points = scattered(table, perLeaf);
        const std::vector<Vec3d> positions = positionsOf(points);
        for (const Coord& origin : {Coord(0, 8, 8), Coord(-8, 0, -16), Coord(24, 8, 0)}) {
            for (const double reach : {3.0, 12.0, 40.0}) {
                LeafMask mask;
                for (int v = 0; v < leafSize; v += 5) mask.set(v);
                std::vector<std::int32_t> found(leafSize, -7);
                nearestPoints(points, origin, mask, reach, scratch, found.data());
                for (int v = 0; v < leafSize; ++v) {
                    if (!mask.on(v)) {
                        EXPECT_EQ(found[v], -7);
                        continue;
                    }
                    const Vec3d x = origin.offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d();
                    double least = reach;
                    for (const Vec3d& p : positions) {
                        least = std::min(least, (p - x).length());
                    }
                    const bool within = least < reach;
                    ASSERT_EQ(found[v] >= 0, within) << least;
                    if (within) {
                        EXPECT_NEAR((positions[found[v]] - x).length(), least, 1e-4);
                    }
                }
            }
        }
    }
}

TEST(NearestPoints, OfNoPoints)
{
    const LeafTable table = someLeaves();
    const LeafPoints points{table, std::vector<std::size_t>(table.size() + 1, 0), {}, {}, {}};
    NearestScratch scratch;
    std::vector<std::int32_t> found(leafSize, 5);
    nearestPoints(points, Coord(0), ~LeafMask(), 10.0, scratch, found.data());
    for (const std::int32_t i : found) EXPECT_EQ(i, -1);
}

} // namespace
} // namespace molsurf
