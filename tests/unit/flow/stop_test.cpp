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
        EvolveOptions options;
        options.flow = Flow::Newton;
        return test::evolveBalls(pairOf(distance), 0.5, 0.5, options).report.unresolvedGapVoxels;
    };
    EXPECT_EQ(gaps(4.0f), 0u); // a neck
    EXPECT_GT(gaps(7.4f), 3u); // a gap
    EXPECT_LT(gaps(7.4f), 60u);
    EXPECT_EQ(gaps(12.0f), 0u); // apart
}

// A sum of Gaussians that voxels do not resolve: the flow sees that it comes no nearer to rest, and
// says so. Who asks for steps gets them.
TEST(Stop, GivesUpWhereNothingFallsAnyMore)
{
    EvolveOptions options;
    options.flow = Flow::Newton;
    options.tolerance = 1e-9;
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const EvolutionReport early = test::evolveBalls(balls, 0.1, 0.5, options).report;
    EXPECT_FALSE(early.converged);
    EXPECT_GT(early.steps, 8);
    EXPECT_LE(early.steps, defaultSteps);
    EXPECT_GT(early.displacementRms, 0.0);
    options.maxSteps = early.steps + 5;
    EXPECT_EQ(test::evolveBalls(balls, 0.1, 0.5, options).report.steps, early.steps + 5);
}

// The rule in numbers: the rms, the quantile, and what a first step has to be below.
TEST(Stop, IsByRmsAndQuantile)
{
    const auto converged = [](float most, int few, float rare, int steps) {
        Displacements d;
        for (int i = 0; i < 10000 - few; ++i) d.add(most);
        for (int i = 0; i < few; ++i) d.add(rare);
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

// No flow comes nearer to rest than the noise of its grid, which grows as h^2 above 0.5 Å; a
// tolerance above that means itself on all voxels.
TEST(Stop, AllowsWhatCoarseVoxelsDoNotResolve)
{
    const auto report = [](double tolerance, float way, double voxelSize) {
        EvolveOptions options;
        options.flow = Flow::Newton;
        options.tolerance = tolerance;
        Displacements d;
        for (int i = 0; i < 1000; ++i) d.add(way);
        EvolutionReport report;
        report.steps = 2;
        judge(d, options, voxelSize, report);
        return report;
    };
    for (const double h : {0.25, 0.5, 1.0}) {
        EXPECT_TRUE(report(0.01, 0.009f, h).converged);
        EXPECT_FALSE(report(0.01, 0.012f, h).converged);
        EXPECT_NEAR(report(0.01, 0.018f, h).toleranceMet, 0.018, 1e-3);
    }
    EXPECT_TRUE(report(1e-4, 0.0009f, 0.25).converged);
    EXPECT_FALSE(report(1e-4, 0.0012f, 0.25).converged);
    EXPECT_TRUE(report(1e-4, 0.0036f, 1.0).converged);
    EXPECT_FALSE(report(1e-4, 0.0045f, 1.0).converged);
}

// Fronts creep: three steps as long as the last one are allowed for.
TEST(Stop, IsStricterWhereFrontsMove)
{
    EvolveOptions options;
    options.flow = Flow::Newton;
    Displacements d;
    for (int i = 0; i < 1000; ++i) d.add(0.005f);
    EvolutionReport report;
    report.steps = 2;
    judge(d, options, 0.5, report);
    EXPECT_TRUE(report.converged);
    options.lambda = 0.1;
    judge(d, options, 0.5, report);
    EXPECT_FALSE(report.converged);
    EXPECT_NEAR(report.toleranceMet, 0.015, 1e-3);
}

// The estimate in numbers, and against a flow that goes on for long.
TEST(Stop, EstimatesHowMuchTheAreaStillChanges)
{
    EvolutionReport report;
    report.steps = 2;
    report.area = {110.0, 101.0, 100.0};
    report.displacementRms = 0.01;
    estimateAreaError({}, report);
    EXPECT_NEAR(report.areaError, 0.01, 1e-12);
    report.displacementRms = 0.04;
    estimateAreaError({}, report);
    EXPECT_NEAR(report.areaError, 0.02, 1e-12);
    EvolveOptions options;
    options.flow = Flow::Newton;
    options.lambda = 0.1;
    estimateAreaError(options, report);
    EXPECT_NEAR(report.areaError, 0.06, 1e-12);

    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    for (const double lambda : {0.003, 0.01, 0.1}) {
        options.lambda = lambda;
        options.steps.reset();
        const EvolutionReport found = test::evolveBalls(balls, 0.5, 0.5, options).report;
        options.steps = found.steps + 10;
        const EvolutionReport rest = test::evolveBalls(balls, 0.5, 0.5, options).report;
        EXPECT_NEAR(found.area.back() / rest.area.back(), 1.0, found.areaError) << lambda;
        EXPECT_LT(found.areaError, 0.01) << lambda;
    }
}

// What counts are the crossings of edges, up to those between two leaves: three axes see a share of
// the surface that is the mean of |n_x| + |n_y| + |n_z|, 3/2 on a ball.
TEST(Stop, IsByTheCrossingsOfTheInterface)
{
    constexpr double h = 0.25;
    Displacements last;
    EvolveOptions options;
    options.flow = Flow::Newton;
    const EvolutionReport report =
        test::evolveBalls({{Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}}, 0.5, h, options, &last).report;
    const double crossings = 1.5 * report.area.back() / (h * h);
    EXPECT_NEAR(double(last.count) / crossings, 7.0 / 8.0, 0.03);
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
    options.flow = Flow::Newton;
    options.steps = 3;
    const EvolveOptions coarse = coarseFlow(options);
    EXPECT_LT(coarse.tolerance, options.tolerance);
    EXPECT_FALSE(coarse.steps); // to rest, however many are asked for
    options.tolerance = 1e-4;
    EXPECT_EQ(coarseFlow(options).tolerance, options.tolerance);
}

// What the program advises is enough: at the tolerance that a run says it meets, it converges.
TEST(Stop, TheToleranceThatIsAdvisedIsMet)
{
    EvolveOptions options;
    options.flow = Flow::Newton;
    options.lambda = 0.3;
    options.maxSteps = 3;
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    const EvolutionReport report = test::evolveBalls(balls, 0.5, 1.0, options).report;
    ASSERT_FALSE(report.converged);
    options.tolerance = 1.001 * report.toleranceMet;
    EXPECT_TRUE(test::evolveBalls(balls, 0.5, 1.0, options).report.converged);
}

// At lambda 0.1 two balls with a narrow gap become one body: the flow goes on while the film that
// closes the gap moves, and rests where the closed form is one.
TEST(Stop, ComesWhileNothingCloses)
{
    EvolveOptions options;
    options.flow = Flow::Newton;
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
