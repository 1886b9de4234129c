// SPDX-License-Identifier: MPL-2.0
#include "molsurf/flow/newton_step.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

constexpr float h = 0.5f;

float extended(float u, float lastU, float lastStep)
{
    return extendedStep(u, lastU, lastStep, h, 0.02f, 0.2f);
}

// What is solved for is a share of the way to rest, the same in every step: then the next step is
// all that is left, however far the one before went.
TEST(ExtendedStep, GoesToRestWhereDisplacementsAreAShareOfTheWay)
{
    for (const float sign : {1.0f, -1.0f}) {
        for (const float share : {0.4f, 0.6f, 0.9f}) {
            const float way = 0.2f * sign, lastU = share * way;
            for (const float lastStep : {0.5f * way, 0.7f * way}) {
                const float left = way - lastStep;
                EXPECT_NEAR(extended(share * left, lastU, lastStep), left, 1e-5f) << share;
            }
        }
    }
}

TEST(ExtendedStep, IsTheDisplacementWhereThatTurnsOrIsShort)
{
    EXPECT_FLOAT_EQ(extended(-0.05f, 0.06f, 0.06f), -0.05f);
    EXPECT_FLOAT_EQ(extended(0.05f, 0.0f, 0.0f), 0.05f); // the first step
    EXPECT_FLOAT_EQ(extended(0.01f, 0.02f, 0.02f), 0.01f);
}

TEST(ExtendedStep, HasItsLimits)
{
    EXPECT_FLOAT_EQ(extended(0.05f, 0.051f, 0.05f), 3.0f * 0.05f);
    EXPECT_FLOAT_EQ(extendedStep(0.05f, 0.051f, 0.05f, h, 0.02f, 0.04f), 5.0f * 0.05f);
    EXPECT_FLOAT_EQ(extended(0.3f, 0.31f, 0.3f), 0.8f * h);
    EXPECT_FLOAT_EQ(extended(-0.7f, 0.0f, 0.0f), -0.8f * h);
}

} // namespace
} // namespace molsurf
