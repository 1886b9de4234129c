// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/kernel/balls/boundary_check.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

struct Checked {
    BallBoundary boundary;
    BoundaryMeasure measure;

    explicit Checked(const std::vector<Ball>& balls)
        : boundary(ballBoundary(balls, 1.4, Progress())),
          measure(measureBoundary(boundary, Progress()))
    {
    }
    /// The line of the error; empty if there is none.
    std::string verdict() const
    {
        try {
            checkBoundary(boundary, measure, Progress());
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Check);
            return e.what();
        }
        return "";
    }
};

std::vector<Ball> someBalls()
{
    return test::randomBalls(300, 25.0, Vec3d(10.0), 3);
}

TEST(BoundaryCheck, PassesWhatIsRight)
{
    EXPECT_EQ(Checked({{openvdb::Vec3f(1.0f), 1.7f, 0}}).verdict(), "");
    for (const double edge : {5.0, 12.0, 25.0, 80.0}) {
        for (unsigned seed = 0; seed < 20; ++seed) {
            const Checked checked(test::randomBalls(200, edge, Vec3d(10.0), seed));
            EXPECT_EQ(checked.verdict(), "") << edge << " " << seed;
        }
    }
}

TEST(BoundaryCheck, TellsWhatDisagrees)
{
    const Checked right(someBalls());
    ASSERT_TRUE(right.boundary.components);
    ASSERT_GT(right.measure.pieces.size(), 1u);

    Checked area = right; // a loop too many
    area.measure.patchAreas[7] += 2.0 * M_PI * std::pow(area.boundary.patches[7].radius, 2);
    EXPECT_NE(area.verdict().find("shares of a sphere"), std::string::npos);

    // Loops in the wrong order are a quarter of the sphere off, at least.
    for (const double share : {-0.25, 0.25, 0.5}) {
        for (const std::size_t p : {std::size_t(0), right.boundary.patches.size() / 2}) {
            Checked loops = right;
            loops.measure.patchAreas[p] +=
                share * 4.0 * M_PI * std::pow(loops.boundary.patches[p].radius, 2);
            EXPECT_NE(loops.verdict().find("shares of a sphere"), std::string::npos) << share;
        }
    }

    Checked volume = right;
    volume.measure.pieces[0].volume *= 1.05;
    EXPECT_NE(volume.verdict().find("by lines"), std::string::npos);

    // A ball that counts as hidden, with all of its faces: lines end on nothing there.
    Checked hidden = right;
    hidden.boundary.patches.erase(hidden.boundary.patches.begin() + 3);
    hidden.measure.patchAreas.erase(hidden.measure.patchAreas.begin() + 3);
    EXPECT_NE(hidden.verdict().find("by lines"), std::string::npos);

    Checked lost = right;
    lost.measure.pieces[0].outer = false;
    lost.measure.pieces[0].volume *= -1.0;
    EXPECT_NE(lost.verdict().find("hang together"), std::string::npos);

    Checked joined = right;
    --*joined.boundary.components;
    EXPECT_NE(joined.verdict().find("hang together"), std::string::npos);

    Checked euler = right;
    ++euler.measure.pieces[0].eulerCharacteristic;
    EXPECT_NE(euler.verdict().find("Euler"), std::string::npos);

    Checked flat = right;
    flat.measure.pieces[0].area = 0.0;
    EXPECT_NE(flat.verdict().find("area of a piece"), std::string::npos);

    Checked inward = right;
    for (BoundaryPiece& piece : inward.measure.pieces) piece.volume *= -1.0;
    EXPECT_NE(inward.verdict().find("outer piece or a cavity"), std::string::npos);
}

TEST(BoundaryCheck, LoopsThatDoNotCloseAreNotMeasured)
{
    BallBoundary boundary = ballBoundary(someBalls(), 1.4, Progress());
    std::size_t open = 0;
    while (boundary.arcs[open].ends[0] < 0) ++open;
    boundary.arcs[open].ends[0] = boundary.arcs[open].ends[1]; // another corner
    EXPECT_THROW(measureBoundary(boundary, Progress()), Error);
}

TEST(BoundaryCheck, FacesThatDoNotMeetAreNotMeasured)
{
    BallBoundary boundary = ballBoundary(someBalls(), 1.4, Progress());
    std::size_t open = 0;
    while (boundary.arcs[open].ends[0] < 0) ++open;
    boundary.arcs[open].half *= 0.99;
    try {
        measureBoundary(boundary, Progress());
        ADD_FAILURE() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()), "boundary: a piece is not closed");
    }
}

TEST(BoundaryCheck, MeshesHaveTheirTolerance)
{
    const Checked one({{openvdb::Vec3f(1.0f), 1.6f, 0}}); // R = 3, no creases
    const MeshTolerance tolerance = meshTolerance(one.boundary, one.measure, 0.5);
    EXPECT_NEAR(tolerance.area, 0.5 * 1.5 * 4.0 * M_PI * 3.0, 1e-6);
    EXPECT_NEAR(tolerance.volume, 0.4 * 0.25 * 4.0 * M_PI * 3.0, 1e-6);
    EXPECT_NO_THROW(checkMesh(100.0, 90.0, 101.0, 91.0, tolerance));
    EXPECT_THROW(checkMesh(100.0, 90.0, 101.0 + tolerance.area, 90.0, tolerance), Error);
    EXPECT_THROW(checkMesh(100.0, 90.0, 100.0, 89.0 - tolerance.volume, tolerance), Error);
    EXPECT_THROW(checkMesh(100.0, 90.0, std::nan(""), 90.0, tolerance), Error);
}

} // namespace
} // namespace molsurf
