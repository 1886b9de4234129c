// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/walls.h"

#include "molsurf/kernel/levelset/closest_foot.h"
#include "molsurf/kernel/levelset/seed_kinks.h"
#include "support/fields.h"
#include "support/rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

constexpr double probe = test::ringProbe, rim = test::ringRim, C = test::ringRate;

/// psi of a ring.
PsiJetAt psiOf(const std::vector<Vec3d>& centres)
{
    return [centres](const Vec3d& x) {
        double sum = 0.0;
        Vec3d first(0.0);
        Mat3d second = Mat3d::zero();
        for (const Vec3d& c : centres) {
            const Vec3d f = -2.0 * C * (x - c);
            const double e = std::exp(C * (rim * rim - (x - c).lengthSqr()));
            sum += e;
            first += e * f;
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    second(a, b) += e * (f[a] * f[b] - (a == b ? 2.0 * C : 0.0));
        }
        const Vec3d gradient = first / sum;
        second *= 1.0 / sum;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) second(a, b) -= gradient[a] * gradient[b];
        return PsiJet{std::log(sum), gradient, second};
    };
}

TEST(ClosestFoot, OfAnEllipsoidIsNoFartherThanAnyOfItsPoints)
{
    const Vec3d axes(6.0, 4.0, 3.0);
    const auto jetAt = [&](const Vec3d& y) {
        Jet jet{-3.0, Vec3d(0.0), Mat3d::zero()};
        for (int a = 0; a < 3; ++a) {
            jet.value += 3.0 * y[a] * y[a] / (axes[a] * axes[a]);
            jet.gradient[a] = 6.0 * y[a] / (axes[a] * axes[a]);
            jet.hessian(a, a) = 6.0 / (axes[a] * axes[a]);
        }
        return jet;
    };
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 50; ++i) {
        Vec3d way{normal(random), normal(random), normal(random)};
        way.normalize();
        const Vec3d foot = axes * way; // a point of it, and its normal
        Vec3d n = way / axes;
        n.normalize();
        const Vec3d x = foot + 1.0 * n, start = foot + 0.5 * Vec3d(n.y(), n.z(), n.x());
        const auto found = closestFoot(jetAt, x, start);
        ASSERT_TRUE(found);
        EXPECT_LT((*found - foot).length(), 0.01);
    }
    EXPECT_FALSE(closestFoot(jetAt, Vec3d(0.0), Vec3d(0.0))); // no slope there
}

TEST(ThinPlaces, LieAmidTwoOrThreeSheets)
{
    const double depth = 5.6;
    const auto count = [&](const std::vector<Vec3d>& feet, const Vec3d& middle) {
        std::vector<ThinPlace> out;
        findThinPlaces(feet, middle, depth, out);
        return out.size();
    };
    const double c = std::sqrt(0.75);
    const std::vector<Vec3d> wall{{0, 0, depth}, {0.2, 0, depth}, {0, 0.3, -depth}};
    const std::vector<Vec3d> neck{
        {depth, 0, 0}, {-0.5 * depth, c * depth, 0}, {-0.5 * depth, -c * depth, 0}};
    EXPECT_EQ(count(wall, {0.3, 0.2, 0.1}), 1u);
    EXPECT_EQ(count(wall, {2.0, 0.0, 0.0}), 0u);          // the voxels are elsewhere
    EXPECT_EQ(count({wall[0], wall[1]}, Vec3d(0.0)), 0u); // one sheet
    EXPECT_EQ(count(neck, {0.3, 0.2, 0.4}), 1u);          // pairs of them are too near
    const std::vector<Vec3d> ridge{{depth, 0, 0}, {0, depth, 0}, {c * depth, 0.5 * depth, 0}};
    EXPECT_EQ(count(ridge, Vec3d(0.0)), 0u);
    std::vector<Vec3d> thick = wall;
    for (Vec3d& y : thick) y *= 1.6;
    EXPECT_EQ(count(thick, Vec3d(0.0)), 0u);
    std::vector<ThinPlace> out; // each sheet has the mean of its feet
    findThinPlaces({wall[0], wall[2], wall[1], {0.4, 0.3, depth}}, Vec3d(0.1), depth, out);
    ASSERT_EQ(out.size(), 1u);
    ASSERT_EQ(out[0].sheets.size(), 2u);
    EXPECT_LT((out[0].sheets[0] - Vec3d(0.2, 0.1, depth)).length(), 1e-12);
    EXPECT_EQ(out[0].sheets[1], wall[2]);
}

// A third sheet that bounds no neck takes nothing from a wall of the other two.
TEST(ThinPlaces, OfTwoSheetsAreSeenBesideAThird)
{
    const double depth = 5.6;
    const std::vector<Vec3d> wall{{0, 0, depth}, {0, 0, -depth}};
    const Vec3d third(0.5 * depth, 0, 0);
    for (int place = 0; place < 3; ++place) {
        std::vector<Vec3d> feet = wall;
        feet.insert(feet.begin() + place, third);
        std::vector<ThinPlace> out;
        findThinPlaces(feet, Vec3d(0.1, -0.2, 0.3), depth, out);
        ASSERT_EQ(out.size(), 1u) << place;
        EXPECT_EQ(out[0].sheets, wall);
    }
}

// A slab twice as thick as a depth, wherever its middle lies between voxels: voxels tell of it, by
// a foot on either side, and by all feet about those.
TEST(ThinPlaces, OfASlabLieInItsMiddle)
{
    constexpr double voxel = 0.7, depth = 1.4;
    for (const double middle : {0.01, 0.5, 0.99}) { // [voxel]
        test::Pose square;
        square.turn = Mat3d::identity();
        square.centre = Vec3d(0.1, 0.2, middle * voxel);
        const test::Shape slab = test::ellipsoid(Vec3d(6.0, 6.0, depth), square);
        const LeafTable table =
            test::bandTable(slab.distance, slab.centre, slab.extent, voxel, 4.0 * voxel);
        const NearestSeeds near =
            nearestSeeds(test::filled(table, voxel, slab.distance), {2.0 * depth, voxel}, -depth,
                         openvdb::CoordBBox::inf(), Progress());
        const std::vector<ThinPlace> places =
            thinPlaces(near, kinksOf(near, Progress()).turns, depth / voxel, Progress());
        std::size_t walls = 0;
        for (const ThinPlace& place : places) {
            if (place.sheets.size() != 2) continue;
            const Vec3d centre = rimOf(place.sheets).centre;
            if (std::hypot(centre.x(), centre.y()) > 2.0) continue;
            ++walls;
            EXPECT_NEAR(centre.z(), middle, 0.05);
            for (const Vec3d& sheet : place.sheets) {
                EXPECT_TRUE(std::any_of(place.near.begin(), place.near.end(), [&](const Vec3d& y) {
                    return (y - sheet).length() < 0.8;
                }));
            }
        }
        EXPECT_GT(walls, 8u) << middle;
    }
}

TEST(Walls, AreFoundOnceAndWhereNoOtherSheetIsNearer)
{
    const double h = 0.5;
    for (const int atoms : {5, 6}) {
        const double depth = 1.45;
        const PsiJetAt psi = psiOf(test::ring(atoms, depth));
        const Vec3d up(0.3, -0.2, depth / h), down(-0.2, 0.4, -depth / h);
        std::vector<ThinPlace> places{{{up, down}, {up, down}}, {{down, up}, {}}};
        const std::vector<Decision> walls = decideWalls(psi, places, probe, h, Progress());
        ASSERT_EQ(walls.size(), 1u);
        EXPECT_LT(walls[0].place.length(), 1.5e-3);
        EXPECT_NEAR(walls[0].beyond, depth - probe - thinnestWall, 1e-5);
        EXPECT_TRUE(decideWalls(psi, places, probe + 0.3, h, Progress()).empty()); // wide open
        EXPECT_TRUE(decideWalls(psi, places, probe - 0.7, h, Progress()).empty()); // thick
    }
    // The ends of an ellipsoid are not closest to its centre.
    const Vec3d axes(1.45, 1.0, 1.0); // [Å]
    const PsiJetAt psi = [&](const Vec3d& x) {
        PsiJet jet{3.0, Vec3d(0.0), Mat3d::zero()};
        for (int a = 0; a < 3; ++a) {
            jet.psi -= 3.0 * x[a] * x[a] / (axes[a] * axes[a]);
            jet.gradient[a] = -6.0 * x[a] / (axes[a] * axes[a]);
            jet.hessian(a, a) = -6.0 / (axes[a] * axes[a]);
        }
        return jet;
    };
    ThinPlace ends{{{2.9, 0.0, 0.0}, {-2.9, 0.0, 0.0}}, {}};
    EXPECT_EQ(decideWalls(psi, {ends}, probe, h, Progress()).size(), 1u);
    ends.near = {{0.0, 2.0, 0.0}};
    EXPECT_TRUE(decideWalls(psi, {ends}, probe, h, Progress()).empty());
}

// What is counted: all that were decided, those that a decision closes, and the nearest.
TEST(Decisions, AreCounted)
{
    const Vec3d x(0.0);
    const GapReport report =
        reportOf({{x, 0.4}, {x, -0.2}, {x, 0.3, true}, {x, -0.5}, {x, 0.0}}, 1.6);
    EXPECT_EQ(report.found, 5u);
    EXPECT_EQ(report.closed, 1u); // not the one that is so by itself
    EXPECT_EQ(report.nearest, 0.0);
    EXPECT_EQ(reportOf({{x, 0.4}, {x, -0.2}}, 1.6).nearest, 0.2);
    EXPECT_EQ(reportOf({}, 1.6).nearest, 1.6);
    EXPECT_EQ(reportOf({{x, -2.0}}, 1.6).nearest, 1.6);
}

/// S of one value in 16^3 voxels.
SparseField flatField(double voxel, double value)
{
    std::vector<openvdb::Coord> origins;
    for (int k = 0; k < 8; ++k) origins.emplace_back(8 * (k >> 2), 8 * (k >> 1 & 1), 8 * (k & 1));
    LeafTable table(std::move(origins));
    for (std::size_t n = 0; n < table.size(); ++n) table.active(n) = ~LeafMask();
    return test::filled(table, voxel, [value](const Vec3d&) { return value; });
}

double valueAt(const SparseField& S, int x)
{
    const openvdb::Coord c(x, 8, 8);
    return S.leaf(std::size_t(S.table.find(c)))[openvdb::FloatTree::LeafNodeType::coordToOffset(c)];
}

// An open wall is opened to 0.25 Å outside by its depth, and half of the 1.5 Å from there
// (1 - t^2)^3 of the change is left, whatever the voxel is; a closed one is left alone, and what is
// open farther, or open already by another one's bump.
TEST(Walls, AreOpenedByLengths)
{
    for (const double voxel : {0.5, 0.25}) {
        for (const double before : {-0.05, -0.09, 0.3}) {
            SparseField S = flatField(voxel, before);
            const Decision wall{Vec3d(8.0 * voxel), -before - thinnestWall};
            openWalls({wall, wall}, S);
            const double change = before == -0.05 ? 0.25 - before : 0.0;
            EXPECT_NEAR(valueAt(S, 8) - before, change, 1e-5) << voxel;
            const int half = int(0.75 / voxel);
            const double t2 = half * half * voxel * voxel / 2.25;
            EXPECT_NEAR(valueAt(S, 8 + half) - before, change * std::pow(1.0 - t2, 3), 1e-5)
                << voxel;
        }
    }
}

// S between voxels is too high beside a ridge: what a wall lacks does not depend on where voxels
// lie beside it.
TEST(Walls, AreOpenedTheSameBesideVoxels)
{
    constexpr double voxel = 0.5;
    double change[2];
    for (int k = 0; k < 2; ++k) {
        const Vec3d middle(8.0, 8.0, 8.0 + 0.5 * k);
        SparseField S = flatField(voxel, 0.2); // as at the foot of a ridge
        openWalls({{middle * voxel, 0.02 - thinnestWall}}, S);
        const double t2 = 0.25 * k * k * voxel * voxel / 2.25;
        change[k] = (valueAt(S, 8) - 0.2) / std::pow(1.0 - t2, 3);
        EXPECT_NEAR(change[k], 0.27, 1e-5);
    }
}

// The middle of a closed wall lies 0.7 voxels inside, that of an open one 0.25 outside, and half a
// radius from there (1 - t^2)^3 of the change is left.
TEST(Walls, AreHeldByBumps)
{
    constexpr double h = 0.5, flat = 0.05;
    for (const bool closed : {true, false}) {
        SparseField S = flatField(h, flat);
        holdWalls({{Vec3d(8.0 * h), closed ? 0.03 : -0.03}}, S);
        const double change = (closed ? -0.7 * h : 0.25 * h) - flat;
        EXPECT_NEAR(valueAt(S, 8) - flat, change, 1e-5) << closed;
        const double t2 = 1.0 / 9.0; // a voxel of the bump's three
        EXPECT_NEAR(valueAt(S, 9) - flat, change * std::pow(1.0 - t2, 3), 1e-5) << closed;
        EXPECT_NEAR(valueAt(S, 12), flat, 1e-6);
    }
}

} // namespace
} // namespace molsurf
