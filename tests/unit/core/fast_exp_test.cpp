// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/simd.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

TEST(FastExp, IsWithinThreeUlpOverItsRange)
{
    double worst = 0.0;
    for (int i = 0; i <= 1740000; ++i) {
        const float x = -87.0f + 1e-4f * float(i);
        worst = std::max(worst, std::abs(double(fastExp(x)) / std::exp(double(x)) - 1.0));
    }
    EXPECT_LT(worst, 3e-7);
    EXPECT_EQ(fastExp(0.0f), 1.0f);
}

TEST(FastExp, ClampsBeyondItsRange)
{
    EXPECT_EQ(fastExp(-1e30f), fastExp(-87.0f));
    EXPECT_EQ(fastExp(1e30f), fastExp(87.0f));
    EXPECT_TRUE(std::isfinite(fastExp(87.0f)));
    EXPECT_GT(fastExp(-87.0f), 0.0f);
}

TEST(FastExp, InDoubleIsWithinAFewUlp)
{
    double worst = 0.0;
    for (double x = -700.0; x < 699.9; x += 4 * 0.00317) {
        const Doubles at = {x, x + 0.00317, x + 2 * 0.00317, x + 3 * 0.00317}, e = fastExp(at);
        for (int l = 0; l < doubleLanes; ++l)
            worst = std::max(worst, std::abs(e[l] / std::exp(at[l]) - 1.0));
    }
    EXPECT_LT(worst, 1e-15);
    const Doubles ends = {0.0, -1e9, 1e9, 1.0}, e = fastExp(ends);
    EXPECT_EQ(e[0], 1.0);
    EXPECT_GT(e[1], 0.0);
    EXPECT_TRUE(std::isfinite(e[2]));
}

TEST(FastLog, IsAsExactAsFloatAllows)
{
    double worst = 0.0;
    for (double x = 1.2e-38; x < 3e38; x *= 1.0007) {
        const double exact = std::log(double(float(x)));
        worst =
            std::max(worst, std::abs(double(fastLog(float(x))) - exact) / (1.0 + std::abs(exact)));
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_EQ(fastLog(1.0f), 0.0f);
}

TEST(FlushDenormals, TakesThemForZeroWhileItLives)
{
#ifndef __SSE__
    GTEST_SKIP();
#endif
    volatile float small = 1e-30f;
    {
        const FlushDenormals scope;
        volatile float denormal = small * 1e-10f;
        EXPECT_EQ(denormal, 0.0f);
    }
    volatile float denormal = small * 1e-10f;
    EXPECT_GT(denormal, 0.0f);
}

} // namespace
} // namespace molsurf
