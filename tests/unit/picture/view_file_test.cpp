// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/view_file.h"

#include "molsurf/error.h"
#include "support/folder.h"
#include "unit/picture/add_ball.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr const char* oblique = R"("to_eye": [1, 2, 3], "up": [0, 1, 0])";

struct ViewFile : testing::Test {
    const test::Folder folder;
    DrawOptions options;

    /// Reads a view of directions, centre, width and height.
    void read(const std::string& directions, const std::string& center, const std::string& size)
    {
        std::ofstream(folder / "a.view")
            << "{" << directions << ", \"center\": " << center << ", " << size << "}";
        readView(folder / "a.view", options);
    }
};

constexpr const char *origin = "[0, 0, 0]", *square = R"("width": 10, "height": 10)";

TEST_F(ViewFile, ReadsWhatItHasWritten)
{
    Mesh mesh;
    test::addBall(mesh, {30.0f, -7.0f, 4.0f}, 5.0f, {});
    lookFrom({1, 2, 3}, options);
    options.width = 100;
    OutputFile file(folder / "a.view", false);
    writeView(mesh, options, file);
    file.commit();
    DrawOptions back;
    back.width = 100;
    readView(folder / "a.view", back);
    ASSERT_TRUE(back.frame);
    EXPECT_LT((back.frame->center - Vec3d(30, -7, 4)).length(), 0.01);
    EXPECT_NEAR(back.frame->width, 10.4, 0.01);
    EXPECT_EQ(drawMesh(mesh, back, Progress()).rgb, drawMesh(mesh, options, Progress()).rgb);
}

// Rays of floats do not tell places so far away apart.
TEST_F(ViewFile, RefusesViewsOfNowhere)
{
    EXPECT_NO_THROW(read(oblique, "[9e6, 0, 0]", square));
    EXPECT_THROW(read(oblique, "[2e7, 0, 0]", square), Error);
    EXPECT_THROW(read(oblique, "[1e200, 1e200, 0]", square), Error);
    EXPECT_THROW(read(oblique, origin, R"("width": 2e7, "height": 2e7)"), Error);
}

TEST_F(ViewFile, RefusesDirectionsThatAreOne)
{
    EXPECT_NO_THROW(read(R"("to_eye": [0, 2, 0], "up": [0, 1, 1e-5])", origin, square));
    for (const char* up : {"[0, 1, 0]", "[0, -3, 0]", "[0, 1, 1e-7]", "[0, 0, 0]", "[0, 0, 1e200]"})
        EXPECT_THROW(read(std::string(R"("to_eye": [0, 2e200, 0], "up": )") + up, origin, square),
                     Error)
            << up;
    EXPECT_THROW(read(R"("to_eye": [0, 0, 0], "up": [0, 1, 0])", origin, square), Error);
}

TEST_F(ViewFile, RefusesShapesThatNoPictureHas)
{
    for (const char* size : {R"("width": 10, "height": 0.9)", R"("width": 10, "height": 51)",
                             R"("width": 1e-4, "height": 1e-4)", R"("width": -1, "height": 1)"})
        EXPECT_THROW(read(oblique, origin, size), Error) << size;
}

// Up is y, or z for who looks along x or y.
TEST_F(ViewFile, WhoLooksFromSomewhereHasAnUp)
{
    for (const Vec3d& from : {Vec3d(1, 2, 3), Vec3d(0, -5, 0), Vec3d(0, 5, 0.1), Vec3d(0, 0, 1)}) {
        lookFrom(from, options);
        EXPECT_EQ(options.toEye, from);
        EXPECT_GT(options.up.cross(from.unit()).length(), 0.1) << from;
    }
    EXPECT_EQ(options.up, Vec3d(0, 1, 0));
    for (const Vec3d& from : {Vec3d(3, 0, 0), Vec3d(-3, 0.1, 0), Vec3d(0, -3, 0)}) {
        lookFrom(from, options);
        EXPECT_EQ(options.up, Vec3d(0, 0, 1)) << from;
    }
}

} // namespace
} // namespace molsurf
