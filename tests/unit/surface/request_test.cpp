// SPDX-License-Identifier: MPL-2.0
// What files of a request say about it.

#include "molsurf/error.h"
#include "molsurf/request/drawn_request.h"
#include "molsurf/request/format_table.h"
#include "molsurf/request/run_metadata.h"
#include "molsurf/request/run_outputs.h"
#include "molsurf/request/usd_stage.h"

#include "support/folder.h"

#include <gtest/gtest.h>

#include <limits>

namespace molsurf
{
namespace
{

Output outputOf(const std::string& path)
{
    return {path, findFormat(formatWordOf(path))};
}

// Light that fog scatters is per unit of length of the scene: 0.5 per Å where density is 1, or what
// the density has already.
TEST(UsdVolumes, ScatterByTheirDensityAndUnit)
{
    for (const double scale : {1.0, 0.1}) {
        Request request;
        request.scene.scale = scale;
        UsdVolume volume = usdVolume(request, outputOf("some/a.usda"));
        EXPECT_DOUBLE_EQ(volume.scattering, 0.5 / scale);
        EXPECT_DOUBLE_EQ(volume.metersPerUnit, 1e-10 / scale);
        EXPECT_EQ(volume.name, "a");
        EXPECT_EQ(volume.file, "a.vdb");
        request.scene.fogDensity = 0.02;
        volume = usdVolume(request, outputOf("some/a.usda"));
        EXPECT_EQ(volume.scattering, 1.0);
        EXPECT_TRUE(volume.frames.empty());
    }
}

// A clip of meshes plays at 24 frames a second, or as asked; its velocities are per second.
TEST(UsdStages, OfAFrameHaveItsRate)
{
    for (const double rate : {0.0, 10.0}) {
        Request request;
        request.frame = 7;
        request.frameDigest = "0123456789abcdef";
        request.fps = rate;
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        for (const char* axis : {"v_x", "v_y", "v_z"}) // per frame, without a rate
            mesh.scalars.push_back({axis, std::vector<float>(4, 0.5f)});
        const std::string text = test::written(
            [&](OutputFile& file) { writeUsdStage(request, outputOf("a.0003.usda"), mesh, file); });
        const std::string perSecond = rate > 0.0 ? "10" : "24";
        EXPECT_NE(text.find("timeCodesPerSecond = " + perSecond + "\n"), std::string::npos) << text;
        EXPECT_NE(text.find("0123456789abcdef"), std::string::npos);
        const std::string speed =
            rate > 0.0 ? "(0.5000, 0.5000, 0.5000)" : "(12.0000, 12.0000, 12.0000)";
        EXPECT_NE(text.find("[" + speed + ", " + speed), std::string::npos) << text;
    }
}

std::string textIn(const openvdb::MetaMap& map, const std::string& name)
{
    const auto found = map.getMetadata<openvdb::StringMetadata>(name);
    return found ? found->value() : "none";
}

// A frame names the file of its coordinates, and its digest; without one there is no word of it.
TEST(RunMetadata, OfAFrameHasItsTrajectory)
{
    Request request;
    request.input = "a.pdb";
    Report report;
    report.input = "a.pdb";
    report.surface.area = 12.5;
    report.surface.volume = 3.25;
    const openvdb::MetaMap still = runMetadata(request, report);
    EXPECT_EQ(textIn(still, "trajectory"), "none");
    EXPECT_EQ(textIn(still, "input"), "a.pdb");
    EXPECT_EQ(still.metaValue<double>("area"), 12.5);
    EXPECT_EQ(still.metaValue<double>("volume"), 3.25);
    request.frame = 4;
    request.frameDigest = "abc";
    EXPECT_EQ(textIn(runMetadata(request, report), "trajectory"), "a.pdb"); // of its models
    request.trajectory = "run.xtc";
    report.surface.area = std::numeric_limits<double>::quiet_NaN();
    const openvdb::MetaMap moving = runMetadata(request, report);
    EXPECT_EQ(textIn(moving, "trajectory"), "run.xtc");
    EXPECT_EQ(textIn(moving, "frames.options"), "abc");
    EXPECT_EQ(moving.metaValue<std::int64_t>("frame"), 4);
    EXPECT_FALSE(moving["area"] || moving["volume"]);
}

// Without knowledge of the atoms no option of theirs is named.
TEST(RunMetadata, HasTheOptionsThatAreKnown)
{
    Request request;
    Report report;
    const openvdb::MetaMap whole = runMetadata(request, report);
    EXPECT_TRUE(whole["option.voxel"]);
    EXPECT_TRUE(whole["option.radii"]);
    request.knowsAtoms = false;
    const openvdb::MetaMap some = runMetadata(request, report);
    EXPECT_TRUE(some["option.voxel"]);
    EXPECT_FALSE(some["option.radii"]);
}

// Each pocket has a file of its own, whose name no other file may have.
TEST(RunOutputs, OfPocketsAreNumbered)
{
    std::vector<Output> asked = {outputOf("a.ply"), outputOf("some.pockets/b.pockets.ply")};
    const std::vector<Output> all = withPockets(asked, 2);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].path, "a.ply");
    for (std::size_t k : {1u, 2u}) {
        EXPECT_EQ(all[k].path, "some.pockets/b.pocket" + std::to_string(k) + ".ply");
        EXPECT_EQ(all[k].pocket, k);
    }
    asked.push_back(outputOf("some.pockets/b.pocket2.ply"));
    EXPECT_EQ(withPockets(asked, 1).size(), 3u);
    try {
        withPockets(asked, 2);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Output);
        EXPECT_STREQ(error.what(), "-o some.pockets/b.pocket2.ply is given twice");
    }
}

// A turn of four pictures: each has its number, and a fourth of the turn.
TEST(RunOutputs, OfATurntableTurn)
{
    const std::vector<Output> all =
        withTurntable({outputOf("a.png"), outputOf("b.ply"), outputOf("c.gif")}, 4);
    ASSERT_EQ(all.size(), 6u); // a film has them all itself
    EXPECT_EQ(all[5].path, "c.gif");
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_EQ(all[n].path, "a.000" + std::to_string(n + 1) + ".png");
        EXPECT_EQ(all[n].turn, 90.0 * double(n));
    }
    EXPECT_EQ(all[4].path, "b.ply");
}

// Panels of other kinds turn as the first one does; those that look from elsewhere have its mesh.
TEST(DrawnPanels, TurnWithTheFirst)
{
    Request request;
    request.firstName = "variational";
    request.panels.resize(2);
    request.panels[0].toEye = openvdb::Vec3d(0.0, 0.0, 2.0);
    request.panels[1].kind = SurfaceKind::VanDerWaals;
    request.panelSurfaces = std::make_shared<std::vector<PanelSurface>>();
    request.panelSurfaces->push_back({"vdw", {}, {}, {}, {}, {}, true});
    const BallSet atoms;
    const Mesh mesh;
    const DrawnSurface first = drawnSurface(request, atoms, mesh, {}, 30.0, true);
    EXPECT_EQ(first.look.turn, 30.0);
    EXPECT_TRUE(first.look.quick);
    const std::vector<DrawnSurface> all = drawnPanels(request, first);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].name, "variational");
    EXPECT_TRUE(all[1].ownEye);
    EXPECT_LT((all[1].look.toEye.unit() - openvdb::Vec3d(0.0, 0.0, 1.0)).length(), 1e-12);
    EXPECT_EQ(&all[1].mesh, &mesh);
    EXPECT_EQ(all[2].name, "vdw");
    EXPECT_EQ(all[2].look.turn, 30.0);
    EXPECT_TRUE(all[2].look.quick);
    EXPECT_FALSE(all[2].ownEye);
    EXPECT_EQ(&all[2].mesh, &request.panelSurfaces->front().mesh);
}

} // namespace
} // namespace molsurf
