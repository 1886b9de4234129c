// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/curvature_colors.h"

#include <gtest/gtest.h>

#include <vector>

namespace molsurf
{
namespace
{

// The largest twentieth, by size, has the colours of the ends: it may be a few outliers.
TEST(CurvatureScale, EndsBelowTheLargestTwentieth)
{
    std::vector<float> curvature;
    for (int i = 0; i < 100; ++i) curvature.push_back(float(i < 50 ? i + 1 : -(i + 1)));
    const ColorScale scale = curvatureScale(curvature, Coloring());
    EXPECT_DOUBLE_EQ(scale.high, 96.0);
    EXPECT_DOUBLE_EQ(scale.low, -96.0);
}

TEST(CurvatureScale, OfAPlaneHasARange)
{
    for (const auto& curvature : {std::vector<float>{}, std::vector<float>(20, 0.0f)}) {
        const ColorScale scale = curvatureScale(curvature, Coloring());
        EXPECT_GT(scale.high, 0.0);
        EXPECT_DOUBLE_EQ(scale.low, -scale.high);
    }
}

TEST(CurvatureScale, HasTheRangeAndThePaletteThatAreGiven)
{
    Coloring options;
    options.range = {{-0.5, 1.0}};
    options.palette = "viridis";
    const ColorScale scale = curvatureScale({3.0f, 4.0f}, options);
    EXPECT_DOUBLE_EQ(scale.low, -0.5);
    EXPECT_DOUBLE_EQ(scale.high, 1.0);
    EXPECT_EQ(scale.at(1.0), (Color{253, 231, 37}));
}

TEST(CurvatureScale, ColoursVerticesByTheirOwn)
{
    Mesh mesh;
    mesh.scalars = {{"mean_curvature", {0.5f, -0.5f, 0.0f}}, {"gaussian_curvature", {0, 0, 0}}};
    colorByCurvature(ColorBy::MeanCurvature, Coloring(), mesh);
    const ColorScale scale = curvatureScale(mesh.scalars[0].values, Coloring());
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.colors[0], scale.stops.back());
    EXPECT_EQ(mesh.colors[1], scale.stops.front());
    EXPECT_EQ(mesh.colors[2], scale.stops[scale.stops.size() / 2]);
}

} // namespace
} // namespace molsurf
