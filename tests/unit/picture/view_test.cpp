// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/view.h"

#include "molsurf/show/picture/view_file.h"
#include "unit/picture/add_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// A rod along y in the first set, which goes 10 Å along x.
std::vector<Vec3d> rod(std::size_t i)
{
    std::vector<Vec3d> points;
    for (int n = 0; n <= 20; ++n) points.push_back({5.0 * double(i), double(n), n % 2 ? 0.5 : 0.0});
    return points;
}

TEST(View, OfAllSetsOfPoints)
{
    DrawOptions options;
    keepView(3, rod, 1.5, options);
    EXPECT_NEAR(std::abs(options.up.cross(options.toEye)[1]), 1.0, 0.01); // the rod lies across
    options = DrawOptions();
    lookFrom({0.0, 0.0, 1.0}, options);
    keepView(3, rod, 1.5, options);
    ASSERT_TRUE(options.frame);
    EXPECT_NEAR(options.frame->width, 1.04 * (10.0 + 3.0), 1e-9);
    EXPECT_NEAR(options.frame->height, 1.04 * (20.0 + 3.0), 1e-9);
    // A mesh that is elsewhere does not change it.
    Mesh mesh;
    test::addBall(mesh, {3.0f, 4.0f, 0.0f}, 2.0f, {1, 2, 3});
    options.width = 100;
    const View view = chooseView(mesh, options);
    EXPECT_NEAR(view.pixel * 100, options.frame->width, 1e-9);
    EXPECT_NEAR(view.center[0], 5.0, 1e-9);
    EXPECT_NEAR(view.center[1], 10.0, 1e-9);
}

TEST(View, TurnsOnce)
{
    DrawOptions options;
    lookFrom({0.0, 0.0, 1.0}, options);
    options.turn = 90.0;
    keepView(1, rod, 0.0, options);
    EXPECT_EQ(options.turn, 0.0);
    EXPECT_NEAR(std::abs(options.toEye[0]), 1.0, 1e-9);
    EXPECT_NEAR(options.up[1], 1.0, 1e-9);
}

/// Labels are in the frame, and move neither the cut nor what is clipped.
TEST(View, ShowsThePlacesOfNotes)
{
    Mesh mesh;
    test::addBall(mesh, {3.0f, 4.0f, 10.0f}, 2.0f, {1, 2, 3});
    DrawOptions options;
    lookFrom({0.0, 0.0, 1.0}, options);
    const View plain = chooseView(mesh, options);
    options.notes = {{openvdb::Vec3d(3.0, 4.0, 50.0), {}, "in front"}};
    const View front = chooseView(mesh, options);
    EXPECT_EQ(front.center, plain.center);
    EXPECT_EQ(front.low, plain.low);
    EXPECT_EQ(front.far, plain.far);
    EXPECT_EQ(front.pixel, plain.pixel);
    options.notes = {{openvdb::Vec3d(-7.0, 4.0, 0.0), openvdb::Vec3d(3.0, 34.0, 0.0), ""}};
    const View aside = chooseView(mesh, options);
    EXPECT_NEAR(aside.width * aside.pixel, 1.04 * 12.0, 0.1);  // from -7 to 5
    EXPECT_NEAR(aside.height * aside.pixel, 1.04 * 32.0, 0.1); // from 2 to 34
    EXPECT_EQ(aside.low, plain.low);
    options.turn = 90.0;
    const View turned = chooseView(mesh, options);
    EXPECT_GT(turned.width * turned.pixel, 12.0); // for every turn
}

// A flat or a high extent has a fifth of its width at least, and four of them at most.
TEST(View, HasASizeThatPicturesCanHave)
{
    for (const bool isHigh : {false, true}) {
        const auto line = [&](std::size_t) {
            std::vector<Vec3d> points;
            for (double x = 0.0; x <= 100.0; x += 1.0)
                points.push_back(isHigh ? Vec3d(0.0, x, 0.0) : Vec3d(x, 0.0, 0.0));
            return points;
        };
        DrawOptions options;
        lookFrom({0.0, 0.0, 1.0}, options);
        keepView(1, line, 1.5, options);
        ASSERT_TRUE(options.frame);
        EXPECT_NEAR(options.frame->height / options.frame->width, isHigh ? 4.0 : 0.2, 1e-9);
    }
}

// Without a direction the longest axis lies across, and the second one upright, both with their
// largest component positive, whatever signs the axes come with.
TEST(View, OfItselfHasPositiveAxes)
{
    for (int n = 0; n < 12; ++n) {
        const openvdb::Mat3d turn =
            openvdb::math::rotation<openvdb::Mat3d>(Vec3d(0.48, 0.6, 0.64), 0.5 + 0.53 * n);
        Mesh mesh;
        for (const Vec3d& x : {Vec3d(-10, 0, 0), Vec3d(10, 0, 0), Vec3d(0, 5, 0), Vec3d(0, -5, 0)})
            test::addBall(mesh, openvdb::Vec3f(turn * x), 1.0f, {1, 2, 3});
        const View view = chooseView(mesh, DrawOptions());
        for (const auto& [axis, own] :
             {std::pair(view.right, Vec3d(1, 0, 0)), std::pair(view.up, Vec3d(0, 1, 0))}) {
            EXPECT_NEAR(std::abs(axis.dot(turn * own)), 1.0, 1e-3) << n;
            double largest = 0.0;
            for (int k = 0; k < 3; ++k)
                if (std::abs(axis[k]) > std::abs(largest)) largest = axis[k];
            EXPECT_GT(largest, 0.0) << n;
        }
    }
}

} // namespace
} // namespace molsurf
