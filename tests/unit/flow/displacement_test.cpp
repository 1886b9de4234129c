// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/displacement.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(Displacements, TellRmsQuantileAndMean)
{
    Displacements d;
    for (int i = 0; i < 999; ++i) d.add(0.01f);
    d.add(0.2f);
    d.add(0.2f);
    EXPECT_NEAR(d.rms(), std::sqrt((999 * 1e-4 + 2 * 0.04) / 1001), 1e-6);
    EXPECT_NEAR(d.mean(), (999 * 0.01 + 0.4) / 1001, 1e-6);
    EXPECT_NEAR(d.quantile(0.99), 0.01, 0.001);
    EXPECT_NEAR(d.quantile(0.999), 0.2, 0.02);
    EXPECT_NEAR(d.shareAbove(0.1), 2.0 / 1001, 1e-9);
}

// A few places far from rest shall not hide in the mean of squares, nor rule it.
TEST(Displacements, TakeLongOnesForAQuarterInTheRmsOnly)
{
    Displacements d;
    d.add(3.0f);
    EXPECT_NEAR(d.rms(), 0.25, 1e-6);
    EXPECT_GT(d.quantile(0.5), 2.9);
}

TEST(Displacements, AddUpInAnyOrder)
{
    Displacements a, b, all;
    for (int i = 1; i < 50; ++i) (i % 3 ? a : b).add(0.003f * float(i));
    for (int i = 49; i > 0; --i) all.add(0.003f * float(i));
    a += b;
    EXPECT_EQ(a.count, all.count);
    EXPECT_EQ(a.moved, all.moved);
    EXPECT_EQ(a.square, all.square);
    EXPECT_EQ(a.bins, all.bins);
}

TEST(Displacements, OfNothingAreZero)
{
    const Displacements none;
    EXPECT_EQ(none.rms(), 0.0);
    EXPECT_EQ(none.quantile(0.999), 0.0);
    EXPECT_EQ(none.shareAbove(0.1), 0.0);
}

} // namespace
} // namespace molsurf
