// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "support/flow.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

// The flow starts near its rest, so that the energy tells only what steps and reinitialize() add:
// at lambda 0.01 an interface that is off by 0.001 Å (rms) has 1e-4 more of it.
TEST(Flow, HoldsTheEnergyOfCrambin)
{
    for (const Regularizer regularizer : {Regularizer::Gradient, Regularizer::Area}) {
        const double rise = regularizer == Regularizer::Gradient ? 3e-4 : 1e-3;
        EvolveOptions options;
        options.regularizer = regularizer;
        options.steps = 12;
        const auto report = test::evolveBalls(test::balls("1crn.pdb"), 0.5, 0.5, options).report;
        ASSERT_EQ(report.steps, 12);
        for (std::size_t i = 1; i < report.energy.size(); ++i)
            EXPECT_LT(report.energy[i], report.energy[i - 1] * (1.0 + rise)) << "step " << i;
        EXPECT_LT(report.energy.back(), report.energy.front() * (1.0 + 2.0 * rise));
    }
}

// With a lambda beyond every minimum the surface shrinks away: an error, not an empty result.
TEST(Flow, TellsWhenTheSurfaceVanishes)
{
    EvolveOptions options;
    options.regularizer = Regularizer::Area;
    options.lambda = 1000.0;
    options.maxSteps = 500;
    const std::vector<Ball> atom = {{openvdb::Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}};
    try {
        test::evolveBalls(atom, 0.5, 0.5, options);
        FAIL() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Numeric);
    }
}

} // namespace
} // namespace molsurf
