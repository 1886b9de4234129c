// SPDX-License-Identifier: MPL-2.0
#include "support/flow.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

std::vector<Ball> pairOf(float distance)
{
    return {{Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}, {Vec3f(0.1f + distance, 0.2f, 0.3f), 1.7f, 1}};
}

// Two spheres of 3.12 Å: the gap between them is counted where it is narrower than the stencil.
TEST(Stop, GapsThatTheVoxelsDoNotResolveAreCounted)
{
    const auto gaps = [](float distance) {
        return test::evolveBalls(pairOf(distance), 0.5, 0.5, {}).report.unresolvedGapVoxels;
    };
    EXPECT_EQ(gaps(4.0f), 0u); // a neck
    EXPECT_GT(gaps(7.4f), 3u); // a gap
    EXPECT_LT(gaps(7.4f), 60u);
    EXPECT_EQ(gaps(12.0f), 0u); // apart
}

// A tolerance that float numbers do not meet: the flow sees that it comes no nearer, and says so.
// Who asks for steps gets them.
TEST(Stop, GivesUpWhereNothingFallsAnyMore)
{
    EvolveOptions options;
    options.tolerance = 1e-9;
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const EvolutionReport early = test::evolveBalls(balls, 0.5, 0.5, options).report;
    EXPECT_FALSE(early.converged);
    EXPECT_GT(early.steps, 8);
    EXPECT_LT(early.steps, defaultSteps);
    EXPECT_GT(early.displacementRms, 0.0);
    options.maxSteps = 40;
    EXPECT_EQ(test::evolveBalls(balls, 0.5, 0.5, options).report.steps, 40);
}

// The rule in numbers: the rms, the quantile, and what a first step has to be below.
TEST(Stop, IsByRmsAndQuantile)
{
    const auto converged = [](float most, int few, float rare, int steps) {
        Displacements d;
        for (int i = 0; i < 10000 - few; ++i) d.add(most, most);
        for (int i = 0; i < few; ++i) d.add(rare, rare);
        EvolutionReport report;
        report.steps = steps;
        judge(d, {}, 0.5, report);
        EXPECT_NEAR(report.displacementRms, 0.5 * d.rms(), 1e-12);
        EXPECT_NEAR(report.displacementTail, 0.5 * d.quantile(0.999), 1e-12);
        EXPECT_NEAR(report.unsettledShare, rare > 0.12f ? few / 10000.0 : 0.0, 1e-9);
        return report.converged;
    };
    EXPECT_TRUE(converged(0.009f, 0, 0.0f, 2));
    EXPECT_FALSE(converged(0.012f, 0, 0.0f, 2));
    EXPECT_FALSE(converged(0.009f, 0, 0.0f, 1));
    EXPECT_TRUE(converged(0.002f, 0, 0.0f, 1));
    EXPECT_TRUE(converged(0.005f, 8, 0.2f, 2));
    EXPECT_FALSE(converged(0.003f, 20, 0.15f, 2)); // a front
    EXPECT_TRUE(converged(0.005f, 20, 0.06f, 2));
}

// Coarse voxels have a noise of their own: twice as many voxels at 1 Å.
TEST(Stop, AllowsWhatCoarseVoxelsDoNotResolve)
{
    const auto report = [](float displacement, double voxelSize) {
        Displacements d;
        for (int i = 0; i < 1000; ++i) d.add(displacement, displacement);
        EvolutionReport report;
        report.steps = 2;
        judge(d, {}, voxelSize, report);
        return report;
    };
    EXPECT_TRUE(report(0.009f, 0.25).converged);
    EXPECT_FALSE(report(0.012f, 0.25).converged);
    EXPECT_FALSE(report(0.012f, 0.5).converged);
    EXPECT_TRUE(report(0.018f, 1.0).converged);
    EXPECT_FALSE(report(0.022f, 1.0).converged);
    EXPECT_NEAR(toleranceOf(report(0.018f, 0.25), 0.25), 0.018, 1e-3);
    EXPECT_NEAR(toleranceOf(report(0.018f, 1.0), 1.0), 0.009, 1e-3);
}

// Those that count are the voxels nearer than one to the interface: a shell of two voxels.
TEST(Stop, IsByTheVoxelsBesideTheInterface)
{
    constexpr double h = 0.25;
    Displacements last;
    const EvolutionReport report =
        test::evolveBalls({{Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}}, 0.5, h, {}, &last).report;
    EXPECT_NEAR(double(last.count) * h * h * h / (2.0 * h * report.area.back()), 1.0, 0.03);
}

// The rule for giving up in numbers: in eight steps nothing has fallen by a tenth, and neither area
// nor volume have changed by a thousandth.
TEST(Stop, GivesUpOnlyIfAllStandsStill)
{
    struct Series {
        int steps;
        double rms, tail, area, volume; // of the last step, those before being 1
    };
    const auto gaveUp = [](const Series& s) {
        EvolutionReport report;
        const std::vector<double> ones(std::size_t(s.steps - 1), 1.0);
        const auto with = [&](double last) {
            std::vector<double> all = ones;
            all.push_back(last);
            return all;
        };
        report.area = with(s.area);
        report.volume = with(s.volume);
        return stalled(with(s.rms), with(s.tail), report);
    };
    EXPECT_TRUE(gaveUp({9, 1, 1, 1, 1}));
    EXPECT_TRUE(gaveUp({20, 0.95, 1.5, 1.0005, 0.9995}));
    EXPECT_FALSE(gaveUp({8, 1, 1, 1, 1}));
    EXPECT_FALSE(gaveUp({20, 0.85, 1, 1, 1}));
    EXPECT_FALSE(gaveUp({20, 1, 0.85, 1, 1}));
    EXPECT_FALSE(gaveUp({20, 1, 1, 0.998, 1}));
    EXPECT_FALSE(gaveUp({20, 1, 1, 1, 1.002}));
}

TEST(Stop, OnCoarserVoxelsComesNearerToRest)
{
    EvolveOptions options;
    options.steps = 3;
    const EvolveOptions coarse = coarseFlow(options, 0.5);
    EXPECT_LT(coarse.tolerance, options.tolerance);
    EXPECT_FALSE(coarse.steps); // to rest, however many are asked for
    options.tolerance = 1e-4;
    EXPECT_EQ(coarseFlow(options, 0.5).tolerance, options.tolerance);
}

// What the program advises is enough: at the tolerance that a run says it meets, it converges.
TEST(Stop, TheToleranceThatIsAdvisedIsMet)
{
    EvolveOptions options;
    options.lambda = 0.3;
    options.maxSteps = 3;
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const EvolutionReport report = test::evolveBalls(balls, 0.5, 1.0, options).report;
    ASSERT_FALSE(report.converged);
    options.tolerance = 1.001 * toleranceOf(report, 1.0);
    EXPECT_TRUE(test::evolveBalls(balls, 0.5, 1.0, options).report.converged);
}

// At lambda 0.1 two balls with a narrow gap become one body: the flow goes on while the film that
// closes the gap moves, and rests where the closed form is one.
TEST(Stop, ComesWhileNothingCloses)
{
    EvolveOptions options;
    options.lambda = 0.1;
    const test::Evolved out = test::evolveBalls(pairOf(6.4f), 0.5, 0.5, options);
    EXPECT_TRUE(out.report.converged);
    options.steps = out.report.steps + 30;
    const test::Evolved later = test::evolveBalls(pairOf(6.4f), 0.5, 0.5, options);
    EXPECT_NEAR(out.report.area.back() / later.report.area.back(), 1.0, 3e-3);
    // Without fused multiplications 3.2e-3.
    EXPECT_NEAR(out.report.volume.back() / later.report.volume.back(), 1.0, 4e-3);
}

} // namespace
} // namespace molsurf
