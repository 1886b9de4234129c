// SPDX-License-Identifier: MPL-2.0
#include "support/convergence.h"
#include "support/fields.h"

#include <gtest/gtest.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

// An inactive voxel keeps its own sign, whatever the active voxel before it in its row has.
TEST(ToLevelSet, KeepsSignsBesideABandWithHoles)
{
    const double voxel = 0.5, width = 1.5;
    SparseField phi;
    phi.voxelSize = voxel;
    phi.table = LeafTable({Coord(0)});
    phi.values = LeafField(1);
    std::fill_n(phi.leaf(0), leafSize, float(-width));
    for (const int v : {3, 70, 300}) {
        phi.leaf(0)[v] = 0.4f;
        phi.table.active(0).set(v);
    }
    const auto grid = toLevelSet(phi, width, Progress());
    using Leaf = openvdb::FloatTree::LeafNodeType;
    for (int v = 0; v < leafSize; ++v)
        ASSERT_EQ(grid->getConstAccessor().getValue(Leaf::offsetToLocalCoord(openvdb::Index(v))),
                  v == 3 || v == 70 || v == 300 ? 0.4f : float(-width));
}

// Larger than a leaf of the tree's upper levels, so that whole tiles lie inside.
TEST(ToLevelSet, KeepsValuesInTheBandAndSignsEverywhere)
{
    const double voxel = 0.5, width = 1.5;
    const test::Shape ball = test::sphere(34.0);
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
    const SparseField phi = test::filled(table, voxel, ball.distance);
    const auto grid = toLevelSet(phi, width, Progress());

    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_EQ(grid->background(), float(width));
    EXPECT_DOUBLE_EQ(grid->voxelSize()[0], voxel);
    EXPECT_EQ(grid->activeVoxelCount(), table.activeCount());
    const auto read = grid->getConstAccessor();
    test::forEachActive(table, voxel, [&](std::size_t n, int v, const Vec3d& x) {
        const Coord c = Coord::round(x / voxel);
        ASSERT_TRUE(read.isValueOn(c));
        ASSERT_EQ(read.getValue(c), phi.leaf(n)[v]);
    });
    int inside = 0;
    for (int x = -76; x <= 76; x += 3) {
        for (int y = -76; y <= 76; y += 3) {
            for (int z = -76; z <= 76; z += 3) {
                const Coord c(x, y, z);
                const double d = ball.distance(c.asVec3d() * voxel);
                const double expected = std::min(std::max(d, -width), width);
                ASSERT_NEAR(read.getValue(c), expected, 1e-5) << c;
                inside += d < -width;
            }
        }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_EQ(read.getValue(Coord::round(ball.centre / voxel)), -float(width));
}

// A tile of 128^3 voxels inside, and nodes of 4096^3 with and without a child that ends inside.
TEST(ToLevelSet, FillsTilesOfTheUpperNodes)
{
    const double voxel = 0.5, width = 1.5, radius = 60.0;
    const Vec3d centre(32.0);
    const auto distance = [&](const Vec3d& x) { return (x - centre).length() - radius; };
    const LeafTable table = test::bandTable(distance, centre, radius + 3.0, voxel, width);
    const auto grid = toLevelSet(test::filled(table, voxel, distance), width, Progress());
    openvdb::FloatTree plain(grid->tree());
    for (auto tile = plain.beginValueOff(); tile; ++tile)
        if (tile.getLevel() > 0) tile.setValue(float(width));
    openvdb::tools::signedFloodFill(plain);
    const auto read = grid->getConstAccessor();
    EXPECT_EQ(read.getValueDepth(Coord(64)), 1);
    EXPECT_EQ(read.getValue(Coord(64)), -float(width));
    for (int i = -70; i <= 200; ++i)
        for (const Coord& c : {Coord(i, 64, 64), Coord(64, i, 60), Coord(3, 70, i), Coord(i)})
            EXPECT_EQ(read.getValue(c), plain.getValue(c)) << c;
}

TEST(FromGrid, ReadsWhatToLevelSetWrote)
{
    const double voxel = 0.5, width = 1.5;
    const test::Shape ball = test::sphere(7.0);
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, voxel, width);
    const SparseField phi = test::filled(table, voxel, ball.distance);
    const SparseField read = fromGrid(*toLevelSet(phi, width, Progress()));
    EXPECT_DOUBLE_EQ(read.voxelSize, voxel);
    ASSERT_EQ(read.table.origins(), table.origins());
    for (std::size_t n = 0; n < table.size(); ++n) {
        ASSERT_EQ(read.table.active(n).words, table.active(n).words);
        for (int v = 0; v < leafSize; ++v) {
            const bool active = table.active(n).on(v);
            const float expected =
                active ? phi.leaf(n)[v] : std::copysign(float(width), phi.leaf(n)[v]);
            ASSERT_EQ(read.leaf(n)[v], expected);
        }
    }
}

TEST(Clipped, KeepsTheLeavesInTheBoxAsTheyAre)
{
    const test::Shape ball = test::sphere(7.0);
    const LeafTable table = test::bandTable(ball.distance, ball.centre, ball.extent, 0.5, 1.5);
    const SparseField phi = test::filled(table, 0.5, ball.distance);
    const openvdb::CoordBBox box(Coord(0, -32, -32), Coord(7, 31, 31));
    const SparseField part = clipped(copied(phi), box, Progress());
    EXPECT_DOUBLE_EQ(part.voxelSize, 0.5);
    std::size_t inside = 0;
    for (std::size_t n = 0; n < table.size(); ++n) {
        const std::int32_t m = part.table.find(table.origin(n));
        ASSERT_EQ(m != noLeaf, box.isInside(table.origin(n)));
        if (m == noLeaf) continue;
        ++inside;
        ASSERT_EQ(part.table.active(m).words, table.active(n).words);
        for (int v = 0; v < leafSize; ++v) ASSERT_EQ(part.leaf(m)[v], phi.leaf(n)[v]);
    }
    EXPECT_EQ(inside, part.table.size());
    EXPECT_GT(inside, 4u);
    EXPECT_LT(inside, table.size());
}

} // namespace
} // namespace molsurf
