// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_notes.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

// On a background that is seen through, so is all but the lines and letters.
TEST(DrawNotes, AreSeenOnATransparentBackground)
{
    View view;
    view.right = Vec3d(1.0, 0.0, 0.0);
    view.up = Vec3d(0.0, 1.0, 0.0);
    view.toEye = Vec3d(0.0, 0.0, 1.0);
    view.pixel = 0.1;
    view.width = 200;
    view.height = 100;
    Picture picture;
    picture.width = view.width;
    picture.height = view.height;
    picture.rgb.assign(3 * 200 * 100, 0);
    picture.alpha.assign(200 * 100, 0);
    drawNotes({{Vec3d(-5.0, 0.0, 0.0), Vec3d(5.0, 0.0, 0.0), ""}}, view, 200, picture);
    for (const int x : {60, 100, 140})
        EXPECT_EQ(picture.alpha[50 * 200 + std::size_t(x)], 255) << x;
    for (const int x : {20, 180}) EXPECT_EQ(picture.alpha[50 * 200 + std::size_t(x)], 0) << x;
    EXPECT_EQ(picture.alpha[90 * 200 + 100], 0);
}

} // namespace
} // namespace molsurf
