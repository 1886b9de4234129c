// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/pockets/find_pockets.h"

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/excluded_measure.h"

#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// Whether a point is left empty.
using Hole = std::function<bool(const Vec3d&)>;

/// Balls of 1.5 Å, an Å apart, in a box about 0 with holes.
std::vector<Ball> boxWith(const Vec3d& half, const Hole& hole)
{
    std::vector<Ball> out;
    for (double x = -half[0]; x <= half[0]; x += 1.0)
        for (double y = -half[1]; y <= half[1]; y += 1.0)
            for (double z = -half[2]; z <= half[2]; z += 1.0)
                if (!hole({x, y, z}))
                    out.push_back({Vec3d(x, y, z), 1.5, std::int32_t(out.size())});
    return out;
}

double largest(const Vec3d& x)
{
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
}

/// A tunnel of a radius along x, from x = `from` on.
bool inTunnel(const Vec3d& x, double radius, double from)
{
    return x[0] >= from && x[1] * x[1] + x[2] * x[2] < radius * radius;
}

/// The volume of all closed cavities, exactly.
double cavityVolume(const std::vector<Ball>& balls)
{
    const BallBoundary boundary = ballBoundary(balls, 1.4, Progress());
    double sum = 0.0;
    for (const BoundaryPiece& piece :
         measureExcluded(boundary, measureBoundary(boundary, Progress()), 1.4, false, Progress())
             .pieces)
        sum -= std::min(piece.volume, 0.0);
    return sum;
}

std::vector<PocketReport> pocketsOf(const std::vector<Ball>& balls, double voxel = 0.5,
                                    const PocketOptions& options = {})
{
    return findPockets(balls, options, voxel, {}, Progress()).list;
}

TEST(FindPockets, OneBallHasNone)
{
    EXPECT_TRUE(pocketsOf({{Vec3d(0.3), 1.7, 0}}).empty());
}

TEST(FindPockets, AClosedCavityIsExact)
{
    const auto balls = boxWith(Vec3d(7.0), [](const Vec3d& x) { return largest(x) < 4.5; });
    const auto pockets = pocketsOf(balls);
    ASSERT_EQ(pockets.size(), 1u);
    EXPECT_NEAR(pockets[0].volume, cavityVolume(balls), 1e-9);
    EXPECT_FALSE(pockets[0].open);
    EXPECT_TRUE(pockets[0].mouths.empty());
    EXPECT_NEAR(Vec3d(pockets[0].centre[0], pockets[0].centre[1], pockets[0].centre[2]).length(),
                0.0, 1e-3);
    EXPECT_NEAR(pockets[0].radius, 5.0 - 1.5, 0.01);
    EXPECT_NEAR(pockets[0].depth, 8.5, 0.05); // 7 and a radius to the wall, which is nearly flat
    double lined = 0.0;
    for (const PocketReport::Lining& part : pockets[0].lining) lined += part.area;
    EXPECT_NEAR(lined, pockets[0].area, 0.02 * pockets[0].area);
}

// The largest ball in it, whatever the voxels: to the wall of a round void, and no less than the
// small probe.
TEST(FindPockets, TheLargestBallDoesNotDependOnVoxels)
{
    for (const double inner : {3.2, 7.0}) {
        const auto balls = boxWith(Vec3d(std::ceil(inner) + 2.0),
                                   [=](const Vec3d& x) { return x.length() < inner; });
        double nearest = 1e9;
        for (const Ball& ball : balls) nearest = std::min(nearest, ball.center.length());
        for (const double voxel : {0.7, 0.45}) {
            const auto pockets = pocketsOf(balls, voxel);
            ASSERT_EQ(pockets.size(), 1u);
            EXPECT_NEAR(pockets[0].radius, nearest - 1.5, 2e-3) << inner << " " << voxel;
        }
    }
}

// Its space is what the body leaves.
TEST(FindPockets, ABodyInACavityIsTakenOff)
{
    auto balls = boxWith(Vec3d(9.0), [](const Vec3d& x) { return largest(x) < 6.5; });
    const double cavity = cavityVolume(balls);
    balls.push_back({Vec3d(0.5, 0.0, 0.0), 1.5, std::int32_t(balls.size())});
    const auto pockets = pocketsOf(balls, 0.7);
    ASSERT_EQ(pockets.size(), 1u);
    EXPECT_NEAR(pockets[0].volume, cavity - 4.0 / 3.0 * M_PI * 1.5 * 1.5 * 1.5, 1e-6);
}

// A cavity that the cut touches has no way out there.
TEST(FindPockets, ACavityAtTheCutIsClosed)
{
    const auto balls = boxWith(Vec3d(7.0), [](const Vec3d& x) {
        return std::abs(x[1]) < 4.5 && std::abs(x[2]) < 4.5 && x[0] > -4.5 && x[0] < 6.5;
    });
    PocketOptions deeper;
    deeper.cut = 3.3; // its top is 3 Å deep
    const auto pockets = pocketsOf(balls, 0.5, deeper);
    ASSERT_EQ(pockets.size(), 1u);
    EXPECT_FALSE(pockets[0].open);
    EXPECT_TRUE(pockets[0].mouths.empty());
    EXPECT_NEAR(pockets[0].volume, cavityVolume(balls), 1e-9);
}

// Two rooms and a tunnel that passes balls of 1.5 or 2.5 Å, where those in the rooms have 3.5 Å.
TEST(FindPockets, ADumbBellIsTwoIfItsNeckIsNarrow)
{
    const auto dumbBell = [](double neck) {
        return boxWith(Vec3d(13.0, 7.0, 7.0), [=](const Vec3d& x) {
            const Vec3d room(std::abs(x[0]) - 6.5, x[1], x[2]);
            return largest(room) < 4.5 || (std::abs(x[0]) < 5.0 && inTunnel(x, neck, -5.0));
        });
    };
    const auto narrow = dumbBell(3.0), wide = dumbBell(3.8);
    const auto two = pocketsOf(narrow, 0.25), one = pocketsOf(wide);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NEAR(one[0].volume, cavityVolume(wide), 1e-9);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_LT(two[0].volume - two[1].volume, 45.0); // the tunnel, as wide everywhere, is of one
    EXPECT_NEAR(two[0].volume + two[1].volume, cavityVolume(narrow), 0.005 * cavityVolume(narrow));
    EXPECT_NEAR(two[0].radius, 3.5, 0.01);
    EXPECT_EQ(two[0].neighbours, std::vector<std::size_t>{2});
    EXPECT_EQ(two[1].neighbours, std::vector<std::size_t>{1});
    EXPECT_FALSE(two[0].open || two[1].open || one[0].open);

    PocketOptions together;
    together.neck = 0.0;
    EXPECT_EQ(pocketsOf(narrow, 0.5, together).size(), 1u);
}

// A closed room is open by the one before it, into which a narrow tunnel leads.
TEST(FindPockets, ARoomBehindAnotherIsOpen)
{
    const auto pockets =
        pocketsOf(boxWith(Vec3d(13.0, 7.0, 7.0),
                          [](const Vec3d& x) {
                              return largest(Vec3d(std::abs(x[0]) - 6.5, x[1], x[2])) < 4.5 ||
                                     inTunnel(x, 3.0, -5.0);
                          }),
                  0.5);
    ASSERT_EQ(pockets.size(), 2u);
    EXPECT_NE(pockets[0].mouths.empty(), pockets[1].mouths.empty());
    EXPECT_TRUE(pockets[0].open && pockets[1].open);
}

TEST(FindPockets, MouthsAreCounted)
{
    const auto open = [](bool second) {
        return boxWith(Vec3d(9.0), [=](const Vec3d& x) {
            return largest(x) < 3.5 || inTunnel(x, 3.3, 0.0) ||
                   (second && inTunnel({x[1], x[0], x[2]}, 3.3, 0.0));
        });
    };
    for (const bool second : {false, true}) {
        const auto pockets = pocketsOf(open(second));
        ASSERT_EQ(pockets.size(), 1u);
        EXPECT_TRUE(pockets[0].open);
        ASSERT_EQ(pockets[0].mouths.size(), second ? 2u : 1u);
        for (const PocketReport::Mouth& mouth : pockets[0].mouths) {
            EXPECT_NEAR(mouth.radius, std::sqrt(13.0) - 1.5, 0.1); // the nearest row lies at (2, 3)
            EXPECT_NEAR(mouth.area, M_PI * 2.1 * 2.1, 3.0);
        }
    }
}

// The way to a mouth is as wide as its narrowest place: a ring of balls in a tunnel that is wider
// on both sides of it.
TEST(FindPockets, AMouthIsAsWideAsTheWayToIt)
{
    auto balls = boxWith(Vec3d(11.0, 9.0, 9.0),
                         [](const Vec3d& x) { return largest(x) < 4.5 || inTunnel(x, 4.3, 0.0); });
    for (int k = 0; k < 12; ++k) {
        const double angle = M_PI * k / 6.0;
        balls.push_back({Vec3d(6.13, 3.6 * std::cos(angle), 3.6 * std::sin(angle)), 1.5,
                         std::int32_t(balls.size())});
    }
    PocketOptions whole;
    whole.neck = 0.0;
    const auto pockets = pocketsOf(balls, 0.6, whole);
    ASSERT_EQ(pockets.size(), 1u);
    ASSERT_EQ(pockets[0].mouths.size(), 1u);
    EXPECT_NEAR(pockets[0].mouths[0].radius, 3.6 - 1.5, 1e-6);
}

// What lies in front of the cut is no pocket; without a cut it is one.
TEST(FindPockets, TheCutLeavesShallowPlacesOut)
{
    const auto dent = boxWith(Vec3d(7.0), [](const Vec3d& x) { return inTunnel(x, 3.3, 5.0); });
    EXPECT_TRUE(pocketsOf(dent).empty());
    PocketOptions shallow;
    shallow.cut = 0.0;
    EXPECT_EQ(pocketsOf(dent, 0.5, shallow).size(), 1u);
}

// A large probe fits into the void but does not get there from outside.
TEST(FindPockets, AVoidForTheLargeProbeIsOne)
{
    // Whether it lies amid the cubes of voxels or between them.
    for (const Vec3d& middle : {Vec3d(0.0), Vec3d(1.0)}) {
        const auto balls =
            boxWith(Vec3d(10.0), [&](const Vec3d& x) { return (x - middle).length() < 7.0; });
        const auto pockets = pocketsOf(balls, 0.6);
        ASSERT_EQ(pockets.size(), 1u);
        EXPECT_NEAR(pockets[0].volume, cavityVolume(balls), 1e-9);
    }
}

// A chamber behind a window that the large probe does not pass is a pocket, though probes on both
// sides of the window overlap; a larger large probe does not make it smaller.
TEST(FindPockets, AChamberBehindAWindowIsOne)
{
    auto balls = boxWith(Vec3d(9.0),
                         [](const Vec3d& x) { return x.length() < 7.3 || inTunnel(x, 4.3, 0.0); });
    for (int k = 0; k < 12; ++k) {
        const double angle = M_PI * k / 6.0;
        balls.push_back({Vec3d(8.0, 4.4 * std::cos(angle), 4.4 * std::sin(angle)), 1.5,
                         std::int32_t(balls.size())});
    }
    double last = 0.0;
    for (const double probe : {3.2, 4.0, 6.0}) {
        PocketOptions options;
        options.probeOut = probe;
        const auto pockets = pocketsOf(balls, 0.6, options);
        ASSERT_FALSE(pockets.empty()) << probe;
        EXPECT_GT(pockets[0].volume, 700.0) << probe;
        EXPECT_GT(pockets[0].volume, last - 1.0) << probe;
        last = pockets[0].volume;
    }
}

// However wide a void is, its middle is of it.
TEST(FindPockets, AWideVoidIsWhole)
{
    std::vector<Ball> balls;
    constexpr int count = 760;
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / count, across = std::sqrt(1.0 - z * z);
        balls.push_back(
            {11.0 * Vec3d(across * std::cos(2.4 * k), across * std::sin(2.4 * k), z), 1.7, k});
    }
    for (const bool isFilled : {false, true}) {
        if (isFilled) balls.push_back({Vec3d(0.0), 1.5, count});
        const auto pockets = pocketsOf(balls, 0.6);
        ASSERT_EQ(pockets.size(), 1u) << isFilled;
        const double body = isFilled ? 4.0 / 3.0 * M_PI * 1.5 * 1.5 * 1.5 : 0.0;
        EXPECT_NEAR(pockets[0].volume, cavityVolume(balls) - body, 1e-6) << isFilled;
        EXPECT_NEAR(pockets[0].radius, isFilled ? 0.5 * (11.0 - 1.7 - 1.5) : 11.0 - 1.7, 0.1);
        EXPECT_NEAR(pockets[0].depth, isFilled ? 12.7 - 1.5 : 12.7, 0.8);
    }
}

TEST(FindPockets, OnlyThatAtSomePlaces)
{
    const auto balls = boxWith(Vec3d(9.0, 5.0, 5.0), [](const Vec3d& x) {
        return largest(Vec3d(std::abs(x[0]) - 4.0, x[1], x[2])) < 2.5;
    });
    const auto at = [&](const Vec3d& x) {
        return findPockets(balls, {}, 0.7, {x}, Progress()).list;
    };
    ASSERT_EQ(pocketsOf(balls, 0.7).size(), 2u);
    ASSERT_EQ(at({5.0, 0.0, 0.0}).size(), 1u);
    EXPECT_NEAR(at({5.0, 0.0, 0.0})[0].centre[0], 4.0, 0.05);
    EXPECT_NEAR(at({-5.0, 0.0, 0.0})[0].centre[0], -4.0, 0.05);
    EXPECT_TRUE(at({0.0, 30.0, 0.0}).empty());
}

// Those of molecules, too, one of which reaches above the cut.
TEST(FindPockets, ClosedCavitiesOfMoleculesAreExact)
{
    for (const char* file : {"1crn.pdb", "1ubq.pdb"}) {
        const std::vector<Ball> balls = test::balls(file);
        double closed = 0.0;
        for (const PocketReport& pocket : pocketsOf(balls))
            if (!pocket.open) closed += pocket.volume;
        EXPECT_NEAR(closed, cavityVolume(balls), 1e-6) << file;
    }
}

// How many there are, how large they are and which are open does not depend on the pose.
TEST(FindPockets, TheyTurnWithTheMolecule)
{
    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    const auto posed = [&](double angle) {
        const auto turn = openvdb::math::rotation<openvdb::Mat3d>(Vec3d(0.48, 0.6, 0.64), angle);
        std::vector<Ball> out = balls;
        for (Ball& ball : out) ball.center = turn * ball.center + Vec3d(0.17, -0.4, 0.29) * angle;
        auto pockets = pocketsOf(out);
        pockets.erase(std::remove_if(pockets.begin(), pockets.end(),
                                     [](const PocketReport& p) { return p.volume < 10.0; }),
                      pockets.end());
        return pockets;
    };
    const auto first = posed(0.0);
    ASSERT_GE(first.size(), 2u);
    for (const double angle : {0.7, 1.9}) {
        const auto turned = posed(angle);
        ASSERT_EQ(turned.size(), first.size());
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_NEAR(turned[i].volume, first[i].volume, 0.02 * first[i].volume) << i;
            EXPECT_NEAR(turned[i].radius, first[i].radius, 2e-3) << i;
        }
    }
}

// The space is that of its definition, point by point.
TEST(FindPockets, AVoxelHasRoomByDefinition)
{
    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    const Pockets pockets = findPockets(balls, {}, 0.5, {}, Progress());
    ASSERT_FALSE(pockets.list.empty());
    const auto gap = [&](const Vec3d& x) {
        double least = 100.0;
        for (const Ball& ball : balls)
            least = std::min(least, (ball.center - x).length() - ball.radius);
        return least;
    };
    std::size_t seen = 0;
    for (auto it = pockets.ids->cbeginValueOn(); it; ++it) {
        if (++seen % 50 != 0) continue;
        const Vec3d x = pockets.ids->indexToWorld(it.getCoord());
        EXPECT_GT(gap(x), 0.0);
        EXPECT_GE(pockets.depths->tree().getValue(it.getCoord()), 2.4);
    }
}

} // namespace
} // namespace molsurf
