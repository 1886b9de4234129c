// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/relax_fronts.h"

#include "support/flow.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace molsurf
{
namespace
{

// Where tension closes pockets from their ends, fronts move on long after the rest: they go to
// where a flow of the whole would bring them in ten times as many steps.
TEST(Settle, FrontsEndWhereALongFlowEnds)
{
    EvolveOptions options;
    options.lambda = 0.1;
    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    const EvolutionReport found = test::evolveBalls(balls, 0.5, 0.5, options).report;
    EXPECT_TRUE(found.converged);
    EXPECT_GT(found.frontSteps, 0);
    EXPECT_EQ(found.restlessFronts, 0u);
    options.steps = 100;
    const EvolutionReport rest = test::evolveBalls(balls, 0.5, 0.5, options).report;
    EXPECT_LT(found.steps, 40);
    EXPECT_EQ(rest.frontSteps, 0);
    EXPECT_NEAR(found.area.back(), rest.area.back(), 1e-3 * rest.area.back());
    EXPECT_NEAR(found.energy.back(), rest.energy.back(), 5e-4 * rest.energy.back());
}

TEST(Settle, LeavesThatAreAsleepKeepTheirBits)
{
    EvolveOptions options;
    options.steps = 1;
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    test::Evolved out = test::evolveBalls(balls, 0.5, 0.5, options);
    const LeafField before = copied(out.band.phi.values);
    const LeafTable table = out.band.phi.table;
    std::vector<float> largest(table.size(), 0.0f);
    const std::size_t awake = table.size() / 2;
    largest[awake] = 1.0f;
    const PsiSource source = [](const openvdb::Coord&, float*) { FAIL() << "no leaf is missing"; };
    Progress progress;
    const Settling done =
        settle(out.band, source, {weightsOf(options), 2, false, 0}, largest, 0.9f, progress);
    EXPECT_EQ(done.steps, 4);
    ASSERT_EQ(out.band.phi.table.size(), table.size());
    const auto& near = table.neighbours(awake);
    std::size_t moved = 0;
    for (std::size_t n = 0; n < table.size(); ++n) {
        const bool same =
            std::equal(before.leaf(n), before.leaf(n) + leafSize, out.band.phi.leaf(n));
        const bool beside = std::find(near.begin(), near.end(), std::int32_t(n)) != near.end();
        moved += !same;
        EXPECT_TRUE(same || beside) << n;
    }
    EXPECT_GT(moved, 0u);
}

} // namespace
} // namespace molsurf
