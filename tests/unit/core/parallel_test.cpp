// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <functional>

namespace molsurf
{
namespace
{

TEST(ParallelFor, CallsEveryIndexOnce)
{
    std::vector<std::atomic<int>> calls(10007);
    parallelFor(calls.size(), Progress(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) ASSERT_EQ(n, 1);
    parallelFor(0, Progress(), [&](std::size_t) { FAIL(); });
}

// Terms of very different size, so that the order of the additions shows in the last bits.
TEST(ParallelSum, HasTheSameBitsForAnyNumberOfThreads)
{
    const auto term = [](std::size_t i) { return std::sin(double(i)) * std::exp(double(i % 40)); };
    double serial = 0.0, backward = 0.0;
    for (std::size_t i = 0; i < 20000; ++i) serial += term(i);
    for (std::size_t i = 20000; i-- > 0;) backward += term(i);
    ASSERT_NE(serial, backward) << "the order does not matter here: the test sees nothing";
    for (const int threads : {1, 2, 3, 8}) {
        tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(parallelSum<double>(20000, Progress(), term), serial) << threads << " threads";
    }
}

// Of many chunks, few go or nearly all, at the begin or the end.
TEST(ParallelKeep, IsStdRemoveIf)
{
    std::vector<int> all(30000);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i * 7919 % 30000);
    const std::vector<std::function<bool(std::size_t)>> rules = {
        [](std::size_t) { return true; },
        [](std::size_t) { return false; },
        [](std::size_t i) { return i % 1000 != 1; },
        [](std::size_t i) { return i > 9000; },
        [](std::size_t i) { return i < 9000 || i % 5000 == 3; },
        [](std::size_t i) { return std::sin(double(i)) > 0.4; }};
    for (const auto& keep : rules) {
        std::vector<int> expected, got = all;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (keep(i)) expected.push_back(all[i]);
        parallelKeep(got, Progress(), keep);
        EXPECT_EQ(got, expected) << &keep - rules.data();
    }
    std::vector<int> none;
    parallelKeep(none, Progress(), rules[0]);
    EXPECT_TRUE(none.empty());
}

TEST(ParallelFor, StopsWhenCancelled)
{
    struct StopAfter : Progress {
        mutable std::atomic<int> asked{0};
        bool cancelled() const override { return ++asked > 20; }
    } progress;
    std::atomic<int> calls{0};
    EXPECT_THROW(parallelFor(1000000, progress, [&](std::size_t) { ++calls; }), Cancelled);
    EXPECT_GT(calls, 0);
    EXPECT_LT(calls, 1000000);
}

} // namespace
} // namespace molsurf
