// SPDX-License-Identifier: MPL-2.0
#include "support/mesh_checks.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

BallSet crambin(std::vector<ResolutionRule> rules)
{
    SelectOptions options;
    options.resolutions = std::move(rules);
    return selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + "/1crn.pdb"), options);
}

MolecularSurface runOn(const BallSet& atoms, bool matchVolume = false)
{
    SurfaceOptions options;
    options.matchVolume = matchVolume;
    Progress progress;
    return makeSurface(atoms, options, &progress);
}

TEST(Resolution, RatesAreThoseOfTheLastRule)
{
    const BallSet atoms = crambin({{"", 10.0}, {"/1/A/1-20", 5.0}, {"/1/A/10-46", 8.0}});
    ASSERT_EQ(atoms.decays.size(), atoms.balls.size());
    std::size_t counts[3] = {0, 0, 0};
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const double d = atoms.resolutions[std::size_t(atoms.resolutionOf[i])].rule.resolution;
        EXPECT_NEAR(atoms.decays[i].rate, M_PI * M_PI / (d * d), 1e-6);
        ++counts[atoms.resolutionOf[i]];
    }
    for (int r = 0; r < 3; ++r) EXPECT_EQ(counts[r], atoms.resolutions[std::size_t(r)].balls);
    EXPECT_EQ(counts[0], 0u);
    EXPECT_GT(counts[1], 40u);
    EXPECT_GT(counts[2], 200u);
    EXPECT_FALSE(atoms.record.warnings.empty()); // the first rule has no ball
    EXPECT_TRUE(crambin({}).decays.empty());
}

TEST(Resolution, CoarseSurfacesSwellUnlessTheVolumeIsMatched)
{
    const double fine = runOn(crambin({})).report.surface.volume;
    const BallSet coarse = crambin({{"", 10.0}});
    const MolecularSurface swollen = runOn(coarse), matched = runOn(coarse, true);
    EXPECT_GT(swollen.report.surface.volume, 1.5 * fine);
    EXPECT_NEAR(matched.report.surface.volume, fine, 0.01 * fine);
    EXPECT_LT(matched.report.resolutions.at(0).level, -0.5);
    // Smoother: less of every other surface than the fine one has.
    EXPECT_LT(matched.report.surface.area, 0.9 * runOn(crambin({})).report.surface.area);
    EXPECT_TRUE(test::judge(matched.mesh).good());
}

// Far from the seam each half is what it is when all atoms have its resolution.
TEST(Resolution, HalvesOfTwoResolutionsJoin)
{
    const MolecularSurface both = runOn(crambin({{"", 10.0}, {"/1/A/1-23", 5.0}}));
    const test::MeshVerdict verdict = test::judge(both.mesh);
    EXPECT_TRUE(verdict.good()) << verdict;
    EXPECT_EQ(both.report.surface.components, 1);
    const double low = runOn(crambin({{"", 5.0}})).report.surface.volume;
    const double high = runOn(crambin({{"", 10.0}})).report.surface.volume;
    EXPECT_GT(both.report.surface.volume, 1.1 * low);
    EXPECT_LT(both.report.surface.volume, 0.9 * high);
}

// The tolerance that opens a passage is none of balls with rates of their own.
TEST(Resolution, LeavesPassagesUncountedThatTheFieldCloses)
{
    EXPECT_FALSE(runOn(crambin({{"", 5.0}})).report.evolution->gaps->closedByField);
    EXPECT_TRUE(runOn(crambin({})).report.evolution->gaps->closedByField);
}

// A blurred surface lies far from the balls; its vertices still know their atoms.
TEST(Resolution, VerticesKnowTheirAtomsHoweverBlurred)
{
    SelectOptions select;
    select.resolutions = {{"", 20.0}};
    SurfaceOptions options;
    options.voxel = 2.0;
    options.fields = {"atom_id"};
    Progress progress;
    const MolecularSurface result = makeSurface(
        selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + "/1crn.pdb"), select), options,
        &progress);
    ASSERT_FALSE(result.mesh.labels.empty());
    EXPECT_EQ(result.mesh.labels[0].name, "atom_id");
    for (const std::int32_t atom : result.mesh.labels[0].values) ASSERT_GE(atom, 0);
    const auto grid = openvdb::gridPtrCast<openvdb::Int32Grid>(result.fields.at(0));
    for (auto it = grid->cbeginValueOn(); it; ++it) ASSERT_GE(*it, 0);
}

} // namespace
} // namespace molsurf
