// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/scene.h"

#include "support/surfaces.h"

#include <openvdb/tools/LevelSetMeasure.h>

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(ParseScene, TakesProgramsAndScales)
{
    EXPECT_EQ(parseScene("houdini")->host, Host::Houdini);
    EXPECT_EQ(parseScene("blender")->scale, 1.0);
    EXPECT_EQ(parseScene("blender")->host, Host::Blender);
    EXPECT_EQ(parseScene("blender4=nm")->host, Host::Blender4);
    EXPECT_EQ(parseScene("blender=mn-0.01")->scale, 0.01);
    EXPECT_EQ(parseScene("blender=mn-0.1")->scale, 0.1);
    EXPECT_EQ(parseScene("usd=nm")->scale, 0.1);
    EXPECT_EQ(parseScene("usd=2.5")->scale, 2.5);
    for (const char* word : {"", "none", "blenders", "blender=", "blender=0", "blender=-1",
                             "blender=inf", "blender=1e9", "blender=1 "})
        EXPECT_FALSE(parseScene(word)) << word;
}

TEST(PlaceInScene, MovesScalesAndShifts)
{
    const auto grid = test::ballGrid();
    Scene scene;
    scene.host = Host::Blender4;
    scene.scale = 0.1;
    scene.center = openvdb::Vec3d(0.3, 1.2, -0.7);
    const auto placed = placeInScene({grid}, scene, true);
    const auto out = openvdb::gridConstPtrCast<openvdb::FloatGrid>(placed.at(0));
    ASSERT_TRUE(out);
    // The centre of the sphere is at the origin once Blender has added half a voxel.
    const openvdb::Vec3d seen =
        out->indexToWorld(grid->worldToIndex(scene.center)) + openvdb::Vec3d(0.02);
    EXPECT_LT(seen.length(), 1e-9);
    EXPECT_NEAR(openvdb::tools::levelSetVolume(*out), openvdb::tools::levelSetVolume(*grid) * 1e-3,
                1e-6);
    EXPECT_FLOAT_EQ(out->background(), 0.1f * grid->background());
    const openvdb::Coord middle(0, 3, -2);
    EXPECT_FALSE(out->tree().isValueOn(middle));
    EXPECT_EQ(out->tree().getValue(middle), -out->background());
    // The grid that was given is as before.
    EXPECT_EQ(grid->tree().getValue(middle), -grid->background());
    EXPECT_EQ(grid->indexToWorld(openvdb::Vec3d(0.0)), openvdb::Vec3d(0.0));
}

TEST(PlaceInScene, BlenderFiveTakesGridsAsTheyAre)
{
    const auto grid = test::ballGrid();
    const auto placed = placeInScene({grid}, *parseScene("blender=0.1"), true);
    const openvdb::Vec3d x(0.3, 1.2, -0.7);
    EXPECT_LT((placed.at(0)->indexToWorld(grid->worldToIndex(x)) - 0.1 * x).length(), 1e-9);
}

// The way through fog times its density is the same in every unit.
TEST(PlaceInScene, FogHasOneOpticalDepth)
{
    auto fog = test::ballGrid()->deepCopy();
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    fog->setName("density_A");
    fog->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(3)), 0.5f);
    for (const char* word : {"usd", "usd=nm", "blender=mn-0.01"}) {
        Scene scene = *parseScene(word);
        scene.fogDensity = 0.8;
        const auto placed =
            openvdb::gridConstPtrCast<openvdb::FloatGrid>(placeInScene({fog}, scene, true).at(0));
        const double depth = placed->tree().getValue(openvdb::Coord(1)) * placed->voxelSize()[0];
        EXPECT_NEAR(depth, 0.8 * 0.5 * fog->voxelSize()[0], 1e-6) << word;
    }
}

TEST(PlaceInScene, ValuesWithoutALengthStay)
{
    const auto grid = test::ballGrid();
    auto fog = grid->deepCopy();
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    fog->setName("density");
    auto curvature = fog->deepCopy();
    curvature->setGridClass(openvdb::GRID_UNKNOWN);
    curvature->setName("gaussian_curvature_A");
    EXPECT_EQ(lengthPower(*grid), 1);
    EXPECT_EQ(lengthPower(*fog), 0);
    EXPECT_EQ(lengthPower(*curvature), -2);
    Scene scene;
    scene.host = Host::Houdini;
    scene.scale = 0.1;
    const auto placed = placeInScene({fog, curvature}, scene, true);
    const openvdb::Coord voxel = fog->cbeginValueOn().getCoord();
    const float before = fog->tree().getValue(voxel);
    const auto value = [&](std::size_t i) {
        return openvdb::gridConstPtrCast<openvdb::FloatGrid>(placed[i])->tree().getValue(voxel);
    };
    EXPECT_EQ(value(0), before);
    EXPECT_FLOAT_EQ(value(1), 100.0f * before);
    EXPECT_EQ(placed[0]->indexToWorld(openvdb::Vec3d(0.0)), openvdb::Vec3d(0.0));
}

} // namespace
} // namespace molsurf
