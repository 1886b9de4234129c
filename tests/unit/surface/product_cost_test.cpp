// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/product_cost.h"

#include "molsurf/error.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/surface/product_table.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

namespace molsurf
{
namespace
{

BallSet someAtoms()
{
    BallSet atoms;
    atoms.balls = test::randomBalls(500, 24.0, openvdb::Vec3d(0.0), 3);
    return atoms;
}

PlannedBrick planned(const BallSet& atoms, const SurfaceOptions& options)
{
    return (options.grid ? planWhole(atoms, options, Progress()) : planWithoutGrid(atoms, options))
        .bricks[0];
}

/// A length of a product, a small and a large value, and which of them takes more.
struct Length {
    const char* name;
    std::function<void(SurfaceOptions&, double)> set;
    double less, more;
};

const std::vector<Length>& lengths()
{
    static const std::vector<Length> all = {
        {"remesh", [](auto& o, double x) { o.meshEdge = x; }, 2.0, 0.1},
        {"adapt",
         [](auto& o, double x) {
             o.meshEdge = 2.0;
             o.meshError = x;
         },
         0.5, 0.005},
        {"min-thickness", [](auto& o, double x) { o.minThickness = x; }, 1.0, 50.0},
        {"probe-out",
         [](auto& o, double x) {
             o.pockets = true;
             o.pocket.probeOut = x;
         },
         4.0, 40.0},
        {"voxel of pockets",
         [](auto& o, double x) {
             o.pockets = true;
             o.kind = SurfaceKind::SolventAccessible;
             o.grid = false;
             o.voxel = x;
         },
         1.0, 0.25}};
    return all;
}

} // namespace

TEST(ProductCost, FollowsTheLengthsOfTheProduct)
{
    const BallSet atoms = someAtoms();
    for (const Length& length : lengths()) {
        SurfaceOptions less, more;
        length.set(less, length.less);
        length.set(more, length.more);
        const PlannedBrick small = planned(atoms, less), large = planned(atoms, more);
        EXPECT_GT(large.seconds, 3.0 * small.seconds) << length.name;
        EXPECT_GT(large.bytes, small.bytes) << length.name;
    }
}

// What a stage of its own makes has a row with a cost; the names are of those that take nothing to
// speak of.
TEST(ProductCost, IsKnownOfAllThatIsMade)
{
    const std::set<std::string> free = {"colours by curvature", "areas", "`halfFloats`"};
    for (const ProductRow& row : productTable()) {
        const bool needsCost = row.make && free.count(row.name) == 0;
        EXPECT_TRUE(!needsCost || row.cost) << row.name;
    }
}

// A table alone, without a grid, takes what its products take.
TEST(ProductCost, CountsWithoutAGrid)
{
    const BallSet atoms = someAtoms();
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    options.grid = false;
    const PlannedBrick plain = planned(atoms, options);
    options.contacts = true;
    const PlannedBrick contacts = planned(atoms, options);
    EXPECT_GT(contacts.seconds, plain.seconds);
    EXPECT_GT(contacts.bytes, plain.bytes);
    options.contacts = false;
    options.ballAreas = true; // which closed forms have
    EXPECT_LT(planned(atoms, options).seconds, 1.5 * plain.seconds);
}

TEST(ProductCost, IsRefusedBeforeTheWork)
{
    SurfaceOptions options;
    options.meshEdge = 0.05;
    RunLimits limits{std::size_t(100) << 20, 1e9, 1};
    EXPECT_THROW(checkCost(someAtoms(), options, limits, Progress()), Error);
    options.meshEdge = 2.0;
    EXPECT_NO_THROW(checkCost(someAtoms(), options, limits, Progress()));
    options.meshEdge = 0.05;
    limits = {std::size_t(64) << 30, 1e-4, 1};
    EXPECT_THROW(checkCost(someAtoms(), options, limits, Progress()), Error);
}

// The voxels of a run are those that are expected, on voxels below and above the size of an atom.
TEST(SurfaceSize, CountsTheVoxels)
{
    const BallSet atoms = someAtoms();
    for (const SurfaceKind kind :
         {SurfaceKind::Variational, SurfaceKind::SolventExcluded, SurfaceKind::SolventAccessible,
          SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
        for (const double voxel : {0.5, 1.0}) {
            SurfaceOptions options;
            options.kind = kind;
            options.voxel = voxel;
            const SurfaceSize size = sizeOf(atoms, options);
            const Report report = makeSurface(atoms, options).report;
            const double ratio = size.voxels / double(report.activeVoxels);
            EXPECT_GT(ratio, 0.7) << nameOf(kind) << " " << voxel;
            EXPECT_LT(ratio, 1.5) << nameOf(kind) << " " << voxel;
        }
    }
}

// What is smooth without a tolerance is not smoothed by it.
TEST(SurfaceSize, IsAtLeastThatOfABall)
{
    BallSet atoms;
    atoms.balls = {{openvdb::Vec3d(0.0), 1.7, 0}, {openvdb::Vec3d(1.0, 0.0, 0.0), 1.7, 1}};
    SurfaceOptions options;
    options.probe = 90.0;
    options.epsilon = 10.0;
    const double least = 4.0 * M_PI * 91.7 * 91.7;
    EXPECT_NEAR(sizeOf(atoms, options).area, least, 0.05 * least);
}

TEST(SurfaceSize, IsBelowTheMost)
{
    const BallSet atoms = someAtoms();
    const SurfaceOptions options;
    EXPECT_LT(sizeOf(atoms, options).area, mostOf(atoms, options, 1e9).area);
}

} // namespace molsurf
