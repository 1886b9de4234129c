// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/statistics.h"

#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace molsurf
{
namespace
{

TEST(Statistics, OfWeightedNumbers)
{
    const Statistics s = statistics({3.0f, 1.0f, 100.0f, 2.0f}, {1.0f, 2.0f, 0.0f, 1.0f});
    EXPECT_DOUBLE_EQ(s.mean, 1.75);
    EXPECT_DOUBLE_EQ(s.standardDeviation, std::sqrt(0.6875));
    EXPECT_DOUBLE_EQ(s.min, 1.0);
    EXPECT_DOUBLE_EQ(s.max, 3.0); // 100 has no weight
    ASSERT_EQ(percents[4], 50);
    EXPECT_DOUBLE_EQ(s.percentiles[4], 1.0);
    ASSERT_EQ(percents[5], 75);
    EXPECT_DOUBLE_EQ(s.percentiles[5], 2.0);
    EXPECT_DOUBLE_EQ(s.percentiles.back(), 3.0);
}

TEST(Statistics, PercentilesOfAUniformDistribution)
{
    std::vector<float> values, weights;
    for (int i = 0; i < 1000; ++i) {
        values.push_back(float((i * 367) % 1000 + 1) / 1000.0f);
        weights.push_back(2.5f);
    }
    const Statistics s = statistics(values, weights);
    EXPECT_NEAR(s.mean, 0.5005, 1e-6);
    EXPECT_NEAR(s.standardDeviation, std::sqrt(1.0 / 12.0), 1e-4);
    for (std::size_t i = 0; i < percents.size(); ++i)
        EXPECT_NEAR(s.percentiles[i], 0.01 * percents[i], 0.0011);
}

TEST(Statistics, OfNothingAreZero)
{
    EXPECT_EQ(statistics({}, {}).mean, 0.0);
    EXPECT_EQ(statistics({1.0f}, {0.0f}).max, 0.0);
}

TEST(Statistics, VertexAreasAddUpToTheMesh)
{
    const test::Shape ball = test::sphere(2.3);
    const Mesh mesh = test::meshOf(ball, 0.25);
    const std::vector<float> areas = vertexAreas(mesh, Progress());
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), ball.area, 0.01 * ball.area);
    const Statistics s = statistics(mesh.scalars[0].values, areas);
    EXPECT_NEAR(s.mean, 1.0 / 2.3, 1e-3);
    EXPECT_LT(s.standardDeviation, 3e-3);
}

} // namespace
} // namespace molsurf
