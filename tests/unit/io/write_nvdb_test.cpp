// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_nvdb.h"

#include "support/folder.h"
#include "support/surfaces.h"

#include <nanovdb/util/IO.h>

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

// Another reader finds the same active voxels, values, classes and places.
TEST(WriteNvdb, HasTheGridsAsTheyAre)
{
    const test::Folder folder;
    const openvdb::FloatGrid::Ptr surface = test::ballGrid();
    const auto ids = openvdb::Int32Grid::create(-1);
    ids->setName("atom_id");
    const auto ways = openvdb::Vec3SGrid::create();
    ways->setName("v");
    for (auto voxel = surface->cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Coord at = voxel.getCoord();
        ids->tree().setValue(at, at[0] - 7 * at[1]);
        ways->tree().setValue(at, openvdb::Vec3s(at.asVec3s()));
    }
    OutputFile file(folder / "a.nvdb", false);
    writeNvdb({surface, ids, ways}, file);
    file.commit();

    const auto grids = nanovdb::io::readGrids(folder / "a.nvdb");
    ASSERT_EQ(grids.size(), 3u);
    const nanovdb::FloatGrid* read = grids[0].grid<float>();
    ASSERT_TRUE(read);
    EXPECT_STREQ(read->gridName(), "surface");
    EXPECT_TRUE(read->isLevelSet());
    EXPECT_EQ(read->activeVoxelCount(), surface->activeVoxelCount());
    EXPECT_EQ(read->tree().background(), surface->background());
    const nanovdb::Vec3d world = read->indexToWorld(nanovdb::Vec3d(3.0, -2.0, 5.0));
    const openvdb::Vec3d expected = surface->indexToWorld(openvdb::Vec3d(3.0, -2.0, 5.0));
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(world[a], expected[a], 1e-12);
    const nanovdb::Int32Grid* numbers = grids[1].grid<std::int32_t>();
    const nanovdb::Vec3fGrid* vectors = grids[2].grid<nanovdb::Vec3f>();
    ASSERT_TRUE(numbers && vectors);
    EXPECT_STREQ(numbers->gridName(), "atom_id");
    for (auto voxel = surface->cbeginValueOn(); voxel; ++voxel) {
        const openvdb::Coord at = voxel.getCoord();
        const nanovdb::Coord there(at[0], at[1], at[2]);
        ASSERT_EQ(read->tree().getValue(there), *voxel);
        ASSERT_TRUE(read->tree().isActive(there));
        ASSERT_EQ(numbers->tree().getValue(there), at[0] - 7 * at[1]);
        ASSERT_EQ(vectors->tree().getValue(there)[2], float(at[2]));
    }
}

} // namespace
} // namespace molsurf
