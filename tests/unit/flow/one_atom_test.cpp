// SPDX-License-Identifier: MPL-2.0
#include "support/convergence.h"
#include "support/exact_minimum.h"
#include "support/fields.h"
#include "support/flow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

const Ball atom{openvdb::Vec3f(0.137f, -0.291f, 0.443f), 1.7f, 0};
constexpr double R = 3.1; // 1.7 and the probe of 1.4

EvolveOptions tight(const test::Energy& energy, int steps)
{
    EvolveOptions options;
    options.lambda = energy.lambda;
    options.regularizer = energy.regularizer;
    options.steps = steps;
    return options;
}

/// Mean radius of the evolved zero set.
double evolvedRadius(const test::Energy& energy, double voxel, const EvolveOptions& options)
{
    const double near = test::minimalRadius(R, energy);
    const test::Evolved out = test::evolveBalls({atom}, energy.epsilon, voxel, options);
    double sum = 0.0;
    const auto directions = test::directions(300);
    for (const Vec3d& n : directions)
        sum += test::zeroOnRay(out.spline, Vec3d(atom.center), n, near - 2.5 * voxel,
                               near + 2.5 * voxel);
    return sum / double(directions.size());
}

struct Case {
    const char* name;
    test::Energy energy;
    double radius; ///< of the minimum, to check the root finder against

    friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

const Case cases[] = {
    {"Gradient001", {0.5, 0.01, Regularizer::Gradient}, 3.1208143},
    {"Area001", {0.5, 0.01, Regularizer::Area}, 3.0995809},
    {"Area01", {0.5, 0.1, Regularizer::Area}, 3.0958560},
    {"Gradient01", {0.5, 0.1, Regularizer::Gradient}, 3.2726645},
    {"CoarseGradient01", {1.0, 0.1, Regularizer::Gradient}, 3.1739878},
    // The curvature moves the radius by 0.037 and 0.095 here.
    {"Area1", {0.5, 1.0, Regularizer::Area}, 3.0625279},
    {"Area3", {0.5, 3.0, Regularizer::Area}, 3.0052907},
};

TEST(MinimalRadius, IsWhatWasPublished)
{
    for (const Case& c : cases)
        EXPECT_NEAR(test::minimalRadius(R, c.energy), c.radius, 6e-8) << c.name;
}

class OneAtom : public testing::TestWithParam<Case>
{
};

TEST_P(OneAtom, SettlesAtTheMinimumAtSecondOrder)
{
    const Case& c = GetParam();
    const double exact = test::minimalRadius(R, c.energy);
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> error;
    for (std::size_t i = 0; i < h.size(); ++i) {
        error.push_back(std::abs(evolvedRadius(c.energy, h[i], tight(c.energy, 10)) - exact));
    }
    EXPECT_LT(error[0], 0.01) << test::table(h, error);
    EXPECT_LT(error[1], 0.003) << test::table(h, error);
    EXPECT_TRUE(test::observedOrder(h, error) > 1.8 || error[2] < 4e-4) << test::table(h, error);
    if (getenv("VERBOSE")) printf("%s %s", c.name, test::table(h, error).c_str());
}

INSTANTIATE_TEST_SUITE_P(Fast, OneAtom, testing::ValuesIn(cases, cases + 3),
                         [](const auto& info) { return info.param.name; });
INSTANTIATE_TEST_SUITE_P(Slow, OneAtom, testing::ValuesIn(cases + 3, cases + 7),
                         [](const auto& info) { return info.param.name; });

TEST(Flow, ReportsItsHistory)
{
    EvolveOptions options;
    options.flow = Flow::Newton;
    const test::Evolved out = test::evolveBalls({atom}, 0.5, 0.25, options);
    const EvolutionReport& r = out.report;
    EXPECT_TRUE(r.converged);
    EXPECT_EQ(r.energy.size(), std::size_t(r.steps) + 1);
    EXPECT_EQ(r.area.size(), r.energy.size());
    EXPECT_EQ(r.volume.size(), r.energy.size());
    EXPECT_EQ(r.meanDisplacement.size(), std::size_t(r.steps));
    EXPECT_EQ(r.maxSpeed.size(), std::size_t(r.steps));
    EXPECT_EQ(r.unresolvedGapVoxels, 0u);
    const double exact = test::minimalRadius(R, {});
    EXPECT_NEAR(r.area.back() / (4.0 * M_PI * exact * exact), 1.0, 2e-3);
    EXPECT_NEAR(r.volume.back() / (4.0 / 3.0 * M_PI * std::pow(exact, 3)), 1.0, 2e-3);
    // E = area w at the minimum
    const double C = M_LN2 / (0.5 * R), E = std::exp(-C * (exact * exact - R * R));
    const double w = (1 - E) * (1 - E) + 0.01 * std::pow(2 * C * exact * E, 2);
    EXPECT_NEAR(r.energy.back() / (4.0 * M_PI * exact * exact * w), 1.0, 5e-3);
}

TEST(Flow, OfNoStepsLeavesTheInitialSurface)
{
    EvolveOptions options;
    options.maxSteps = 0;
    const test::Evolved out = test::evolveBalls({atom}, 0.5, 0.25, options);
    EXPECT_EQ(out.report.steps, 0);
    EXPECT_FALSE(out.report.converged);
    EXPECT_EQ(out.report.energy.size(), 1u);
    EXPECT_NEAR(test::zeroOnRay(out.spline, Vec3d(atom.center), Vec3d(0.6, 0.0, 0.8), 2.5, 3.5), R,
                1e-3);
}

} // namespace
} // namespace molsurf
