// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

/// The line of the error that makeSurface() ends with; empty if there is none.
std::string refusal(const std::vector<Ball>& balls, const SurfaceOptions& options = {})
{
    Progress progress;
    try {
        makeSurface(balls, options, &progress);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        return e.what();
    }
    return "";
}

TEST(CheckBalls, NamesTheBallAtFault)
{
    std::vector<Ball> balls = test::randomBalls(5, 8.0, Vec3d(0.0), 1);
    EXPECT_EQ(refusal(balls), "");
    const auto with = [&](const Vec3f& center, float radius) {
        std::vector<Ball> some = balls;
        some[3].center = center;
        some[3].radius = radius;
        return refusal(some);
    };
    const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
    for (const std::string& line :
         {with(Vec3f(0.0f, nan, 0.0f), 1.0f), with(Vec3f(infinite, 0.0f, 0.0f), 1.0f),
          with(Vec3f(0.0f, 0.0f, 2e6f), 1.0f), with(Vec3f(0.0f), -1.0f), with(Vec3f(0.0f), 0.0f),
          with(Vec3f(0.0f), nan), with(Vec3f(0.0f), infinite)}) {
        EXPECT_EQ(line.substr(0, 6), "ball 3") << line;
    }
    EXPECT_EQ(refusal({}), "no atoms");
    const double large[] = {1.1e6, 1e30, 1e200}; // whose squares are no numbers, or too rough
    for (const double radius : large) {
        balls[3].radius = radius;
        EXPECT_THROW(exposedAreas(balls, 1.4, Progress()), Error) << radius;
        EXPECT_THROW(contactAreas(balls, 1.4, Progress()), Error) << radius;
    }
}

TEST(CheckBalls, RefusesWhatDoesNotFitTheMemory)
{
    const std::vector<Ball> balls = {{Vec3f(0.0f), 1e5f, 0}};
    EXPECT_NE(refusal(balls).find("radius 100000 Å takes at least"), std::string::npos);

    // The voxel of the hint is one that is taken.
    SurfaceOptions options;
    const std::vector<Ball> large = {{Vec3f(0.0f), 500.0f, 0}};
    std::string line;
    try {
        checkBalls(large, options, Pieces::One, std::size_t(1) << 30);
    } catch (const Error& e) {
        line = e.what();
    }
    const std::size_t hint = line.find("`voxel` ");
    ASSERT_NE(hint, std::string::npos) << line;
    options.voxel = std::stod(line.substr(hint + 8));
    EXPECT_GT(options.voxel, 0.5);
    EXPECT_NO_THROW(checkBalls(large, options, Pieces::One, std::size_t(1) << 30));
}

TEST(CheckBalls, ThePlanOfALargeBallIsItsShell)
{
    BallSet atoms;
    atoms.balls = {{Vec3f(3.0f, -2.0f, 1.0f), 100.0f, 0}};
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    Progress progress;
    const BrickPlan plan = planWhole(atoms, options, progress);
    const MolecularSurface result = makeSurface(atoms, options, &progress);
    ASSERT_EQ(plan.bricks.size(), 1u);
    EXPECT_EQ(plan.bricks[0].atoms, 1u);
    const double voxels = double(result.report.activeVoxels);
    EXPECT_NEAR(double(plan.bricks[0].voxels), voxels, 0.05 * voxels);
}

// Results have the same bits for any order of the atoms.
TEST(AnyOrder, HasTheSameBits)
{
    std::mt19937 random(4);
    for (const SurfaceKind kind :
         {SurfaceKind::Variational, SurfaceKind::SolventExcluded, SurfaceKind::SolventAccessible,
          SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
        std::vector<Ball> balls = test::randomBalls(40, 12.0, Vec3d(3.0), 2);
        for (int k = 0; k < 8; ++k) // and a part of a lattice
            balls.push_back({Vec3f(float(2 * (k & 1)), float(k & 2), float(k >> 1 & 2)), 1.5f, 0});
        SurfaceOptions options;
        options.kind = kind;
        Progress progress;
        const MolecularSurface first = makeSurface(balls, options, &progress);
        for (int n = 0; n < 3; ++n) {
            std::shuffle(balls.begin(), balls.end(), random);
            const MolecularSurface again = makeSurface(balls, options, &progress);
            EXPECT_EQ(again.report.surface.area, first.report.surface.area) << nameOf(kind);
            EXPECT_EQ(again.report.surface.volume, first.report.surface.volume) << nameOf(kind);
            EXPECT_EQ(again.report.surface.eulerCharacteristic,
                      first.report.surface.eulerCharacteristic);
            EXPECT_TRUE(again.mesh.positions == first.mesh.positions) << nameOf(kind);
            EXPECT_TRUE(again.mesh.triangles == first.mesh.triangles) << nameOf(kind);
        }
    }
}

} // namespace
} // namespace molsurf
