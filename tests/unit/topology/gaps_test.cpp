// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/gaps_of_sum.h"

#include "support/fields.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;

constexpr double tolerance = 0.5, tension = 0.01, R = 3.1; // radius with the probe

GaussianOptions optionsWith(double voxel)
{
    GaussianOptions options;
    options.epsilon = tolerance;
    options.voxelSize = voxel;
    options.reach = 4.5 * voxel;
    return options;
}

/// psi in a band about its zero, once gaps are decided.
SparseField bandOf(GaussianSum& sum, double gradient, GapReport* report = nullptr)
{
    GapReport unused;
    return sum.band(3, Progress(), openvdb::CoordBBox::inf(), [&](const SparseField& psi) {
        return bumpsOfGaps(sum, psi, {gradient}, Progress(), report ? *report : unused);
    });
}

/// A turn and a shift by less than an Å, drawn at random.
struct Pose {
    Mat3d turn;
    Vec3d shift;
    explicit Pose(std::mt19937& random)
    {
        std::normal_distribution<double> normal;
        const openvdb::math::Quat<double> q(normal(random), normal(random), normal(random),
                                            normal(random));
        turn = Mat3d(q.unit());
        shift = Vec3d{normal(random), normal(random), normal(random)} * 0.5;
    }
    Vec3d of(const Vec3d& x) const { return turn * x + shift; }
};

/// Six atoms on the axes: psi in the middle is `level`, and they leave no tunnel.
std::vector<Ball> cage(double level, const Pose& pose)
{
    const double C = M_LN2 / (tolerance * R), r = std::sqrt(R * R + (std::log(6.0) - level) / C);
    std::vector<Ball> balls;
    for (int a = 0; a < 3; ++a) {
        for (const double side : {-r, r}) {
            Vec3d x(0.0);
            x[a] = side;
            balls.push_back({pose.of(x), R - 1.4, 0});
        }
    }
    return balls;
}

/// Number of voxels outside within so many Å of a place.
int outsideNear(const SparseField& psi, const Vec3d& x, double reach)
{
    int count = 0;
    test::forEachActive(psi.table, psi.voxelSize, [&](std::size_t n, int v, const Vec3d& y) {
        count += (y - x).length() < reach && psi.leaf(n)[v] < 0.0f;
    });
    return count;
}

TEST(Gaps, JetsAreDerivativesOfPsi)
{
    std::mt19937 random(3);
    const std::vector<Ball> balls = cage(-0.3, Pose(random));
    const GaussianSum sum(balls, optionsWith(0.5));
    constexpr double step = 1e-4;
    const Vec3d x = balls[0].center * 0.3 + balls[2].center * 0.2 + balls[5].center * 0.1;
    const PsiJet jet = sum.jet(x);
    for (int a = 0; a < 3; ++a) {
        Vec3d way(0.0);
        way[a] = step;
        const PsiJet up = sum.jet(x + way), down = sum.jet(x - way);
        EXPECT_NEAR(jet.gradient[a], (up.psi - down.psi) / (2.0 * step), 1e-6);
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(jet.hessian(a, b), (up.gradient[b] - down.gradient[b]) / (2.0 * step),
                        1e-5);
    }
}

TEST(Gaps, TheMiddleOfACageIsFoundFromWhereverItIsNear)
{
    std::mt19937 random(4);
    const Pose pose(random);
    const GaussianSum sum(cage(-0.4, pose), optionsWith(0.5));
    const PsiJetAt jet = [&](const Vec3d& x) { return sum.jet(x); };
    std::uniform_real_distribution<double> near(-0.2, 0.2);
    for (int i = 0; i < 20; ++i) {
        const Vec3d from = pose.shift + Vec3d{near(random), near(random), near(random)};
        const auto gap = gapNear(jet, from, 0.75);
        ASSERT_TRUE(gap);
        EXPECT_LT((gap->place - pose.shift).length(), 4e-5);
        EXPECT_NEAR(gap->psi, -0.4, 1e-6);
        EXPECT_GT(gap->curvatures[0], 0.0); // a cavity
    }
    EXPECT_FALSE(gapNear(jet, pose.of({1.5, 1.0, 0.5}), 0.75));
}

/// The largest depth d at which no level set about a quadratic psi = -d + m r^2/2 rests: with r^n
/// the area of a slit, a cylinder or a ball, r^n w has no minimum but 0.
double depthWithoutRest(int n, double m, double gradient, double area)
{
    const auto rests = [&](double d) {
        const double widest = std::sqrt(2.0 * d / m);
        const auto energy = [&](double r) {
            const double psi = 0.5 * m * r * r - d, slope = m * r;
            return std::pow(r, n) * (psi * psi + gradient * slope * slope + area);
        };
        constexpr int steps = 4000;
        for (int i = 1; i < 2 * steps; ++i) {
            const double h = widest / steps, r = i * h;
            if (energy(r) < energy(r + h) && energy(r) < (i == 1 ? energy(1e-9) : energy(r - h)))
                return true;
        }
        return false;
    };
    double low = 0.0, high = 3.0;
    for (int i = 0; i < 40; ++i) {
        const double d = 0.5 * (low + high);
        (rests(d) ? high : low) = d;
    }
    return high;
}

TEST(Gaps, CloseWhereNoLevelSetRests)
{
    constexpr double walls = 2.0; // of real gaps, see docs/math.md
    for (const double m : {1.0, 4.0}) {
        for (int n = 0; n < 3; ++n) {
            Gap gap{};
            for (int i = 0; i < 3; ++i) gap.curvatures[2 - i] = i <= n ? m : -0.5;
            EXPECT_NEAR(-gap.closedAbove(tension, 0.0) / walls,
                        depthWithoutRest(n, m, tension, 0.0), 0.03 * tension * m * (1 + 3 * n))
                << n << " " << m;
            if (n > 0) {
                EXPECT_NEAR(-gap.closedAbove(0.0, tension) / walls,
                            depthWithoutRest(n, m, 0.0, tension), 0.01)
                    << n << " " << m;
            }
        }
    }
}

TEST(Gaps, AreNeverClosedFartherThanTheEstimateHolds)
{
    Gap gap{};
    gap.curvatures = openvdb::Vec3d(1.0, 2.0, 3.0);
    EXPECT_EQ(gap.closedAbove(10.0, 0.0), -1.5);
    EXPECT_EQ(gap.closedAbove(0.0, 10.0), -1.5);
}

TEST(Gaps, ThatLieNearEachOtherAreTwo)
{
    Gap one{}, other{};
    other.place = openvdb::Vec3d(0.3, 0.2, 0.0);
    EXPECT_EQ(distinct({one, other, one, other}).size(), 2u);
    other.place = openvdb::Vec3d(3e-4, 2e-4, 0.0); // the same, but for rounding
    EXPECT_EQ(distinct({one, other}).size(), 1u);
    // One between the two by x, as in a molecule that stands square.
    Gap beside{};
    beside.place = openvdb::Vec3d(2e-5, 0.5, 0.0);
    other.place = openvdb::Vec3d(4e-5, 0.0, 0.0);
    EXPECT_EQ(distinct({one, beside, other}).size(), 2u);
}

// On voxels of any size and in any pose, a cavity is there or not by its depth alone.
TEST(Gaps, OfACageAreOpenOrClosedInAllPoses)
{
    std::mt19937 random(5);
    for (const double lambda : {0.003, tension}) {
        for (const double voxel : {0.75, 0.5, 0.25}) {
            for (int i = 0; i < 24; ++i) {
                const bool open = i % 2;
                const Pose pose(random);
                // The curvature at the middle of a cage is the same all round.
                const GaussianSum about(cage(-0.3, pose), optionsWith(voxel));
                Gap middle{};
                middle.curvatures = Vec3d(about.jet(pose.shift).hessian(0, 0));
                const double edge = middle.closedAbove(lambda, 0.0);
                GaussianSum sum(cage((open ? 1.15 : 0.85) * edge, pose), optionsWith(voxel));
                GapReport report;
                const SparseField psi = bandOf(sum, lambda, &report);
                EXPECT_EQ(outsideNear(psi, pose.shift, 1.2) > 0, open)
                    << lambda << " " << voxel << " " << i;
                EXPECT_EQ(report.closed, open ? 0u : 1u);
                EXPECT_NEAR(report.nearest, 0.15 * -edge, 0.02);
            }
        }
    }
}

// In the middle between voxels all eight are as far from it as can be.
TEST(Gaps, OfACageThatStandsSquareOnTheVoxelsAreFoundWhereverItIs)
{
    std::mt19937 random(8);
    Pose pose(random);
    pose.turn = Mat3d::identity();
    for (const double place : {0.0, 0.1, 0.25}) {
        pose.shift = Vec3d(place);
        GaussianSum sum(cage(-0.36, pose), optionsWith(0.5));
        GapReport report;
        bandOf(sum, tension, &report);
        EXPECT_EQ(report.found, 9u) << place;
        EXPECT_EQ(report.closed, 1u) << place;
    }
}

// Steps from voxels lead to what steps from everywhere lead to.
TEST(Gaps, AmongLooseAtomsAreThoseOfADenseSearch)
{
    constexpr double edge = 11.0, step = 0.4; // [Å]
    for (unsigned seed = 4; seed < 8; ++seed) {
        GaussianSum sum(test::randomBalls(20, edge, Vec3d(1.3, -2.1, 0.4), seed), optionsWith(0.5));
        GapReport report;
        bandOf(sum, tension, &report);
        const PsiJetAt jet = [&](const Vec3d& x) { return sum.jet(x); };
        std::vector<Gap> dense;
        const Coord half(int(0.5 * edge / step) + 1);
        for (auto place = openvdb::CoordBBox(-half, half).begin(); place; ++place) {
            const Vec3d x = Vec3d(1.3, -2.1, 0.4) + (*place).asVec3d() * step;
            if (std::abs(jet(x).psi) > 4.0) continue;
            if (const auto gap = gapNear(jet, x, 0.75)) dense.push_back(*gap);
        }
        dense = distinct(dense);
        EXPECT_GT(dense.size(), 0u);
        EXPECT_EQ(report.found, dense.size()) << seed;
    }
}

// Without the rule the voxels decide: the test above is one.
TEST(Gaps, AreLeftToTheVoxelsWithoutARule)
{
    std::mt19937 random(6);
    int open = 0;
    for (int i = 0; i < 30; ++i) {
        const Pose pose(random);
        GaussianSum sum(cage(-0.2, pose), optionsWith(0.75));
        open += outsideNear(sum.band(3, Progress()), pose.shift, 1.2) > 0;
    }
    EXPECT_GT(open, 2);
    EXPECT_LT(open, 28);
}

// psi with bumps is one field, however it is asked for.
TEST(Gaps, BumpsAreInAllSamples)
{
    std::mt19937 random(7);
    const Pose pose(random);
    GaussianSum sum(cage(-0.1, pose), optionsWith(0.5));
    bandOf(sum, tension);
    ASSERT_GT(sum.bumps().size(), 0u);
    const Coord origin = Coord::floor(pose.shift / 0.5) & ~7;
    float psi[leafSize];
    sum.evaluate(origin, 2.25, psi);
    std::vector<GaussianSum::Point> points;
    for (int v = 0; v < leafSize; ++v)
        points.push_back({float(v >> 6), float(v >> 3 & 7), float(v & 7)});
    float largest = 0.0f;
    sum.sample(origin, points, [&](std::size_t i, float value, float slope2) {
        const Vec3d x = origin.offsetBy(int(i) >> 6, int(i) >> 3 & 7, int(i) & 7).asVec3d() * 0.5;
        const PsiJet jet = sum.jetWithBumps(x);
        largest = std::max(largest, std::abs(float(jet.psi - sum.jet(x).psi)));
        if (std::abs(value) > 3.0f) return;
        EXPECT_NEAR(value, psi[i], 1e-3);
        EXPECT_NEAR(value, jet.psi, 1e-3);
        EXPECT_NEAR(slope2, jet.gradient.lengthSqr(), 1e-2);
    });
    EXPECT_GT(largest, 0.1f);
}

TEST(Bumps, HaveTheirDerivatives)
{
    Bumps bumps(0.5);
    bumps.add({{0.2, 0.1, -0.3}, 0.7, 1.1});
    bumps.add({{-0.4, 0.3, 0.2}, -0.5, 0.6});
    constexpr double step = 1e-5;
    const Vec3d x(0.3, 0.5, -0.1);
    const PsiJet jet = bumps.jet(x);
    EXPECT_DOUBLE_EQ(jet.psi, jetOf(bumps.all()[0], x).psi + jetOf(bumps.all()[1], x).psi);
    for (int a = 0; a < 3; ++a) {
        Vec3d low = x, high = x;
        low[a] -= step;
        high[a] += step;
        const PsiJet above = bumps.jet(high), below = bumps.jet(low);
        EXPECT_NEAR((above.psi - below.psi) / (2.0 * step), jet.gradient[a], 1e-8);
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR((above.gradient[b] - below.gradient[b]) / (2.0 * step), jet.hessian(a, b),
                        1e-8);
    }
}

// Saddles amid two atoms on their axis: psi there is ln 2 + C (R^2 - D^2/4), and those below 1.6
// count, on voxels of any size and also where the atoms cover them.
TEST(Gaps, BetweenTwoAtomsCountUpToTheirLimit)
{
    const double C = M_LN2 / (tolerance * R);
    for (const double level : {-1.3, 0.4, 1.45, 1.9}) {
        const double half = std::sqrt(R * R - (level - M_LN2) / C);
        const std::vector<Ball> balls = {{Vec3d(0.11, -half, 0.23), float(R - 1.4), 0},
                                         {Vec3d(0.11, half, 0.23), float(R - 1.4), 1}};
        for (const double voxel : {0.75, 0.5, 0.25, 0.15}) {
            GaussianSum sum(balls, optionsWith(voxel));
            GapReport report;
            bandOf(sum, tension, &report);
            EXPECT_EQ(report.found, level < farthestGap ? 1u : 0u) << level << " " << voxel;
        }
    }
}

// A closed and an open gap so near that the bump of one undoes that of the other: both are held.
TEST(Gaps, NearEachOtherAreBothHeld)
{
    constexpr double voxel = 0.5, flat = -0.05;
    const PsiJetAt jet = [](const Vec3d&) { return PsiJet{flat, Vec3d(0.0), Mat3d::zero()}; };
    for (const double apart : {0.45, 0.6, 0.9}) {
        std::vector<Gap> gaps(2);
        gaps[1].place = Vec3d(0.0, apart, 0.0);
        for (Gap& gap : gaps) gap.psi = flat;
        for (const bool first : {true, false}) {
            const std::vector<Decision> decisions = {{gaps[0].place, first ? 0.1 : -0.1},
                                                     {gaps[1].place, first ? -0.1 : 0.1}};
            Bumps bumps(voxel);
            holdGaps(jet, gaps, decisions, voxel, bumps);
            for (std::size_t i = 0; i < 2; ++i) {
                const double psi = flat + bumps.at(gaps[i].place);
                EXPECT_GT(decisions[i].closed() ? psi : -psi, 0.02) << apart << " " << i;
            }
        }
    }
}

// A neck that is closed, across which psi falls, becomes as thick as voxels hold, 0.7 of one on
// each side of its middle; an open slit, across which it rises, as wide.
TEST(Gaps, AreHeldAcrossTheirThinAxis)
{
    std::mt19937 random(9);
    for (const double voxel : {0.7, 0.5, 0.25}) {
        for (const double side : {1.0, -1.0}) { // closed, open
            const Pose pose(random);
            const Vec3d curvatures = side * Vec3d(-8.0, 1.5, 3.0); // along the pose's axes
            const PsiJetAt jet = [&](const Vec3d& x) {
                const Vec3d y = pose.turn.transpose() * (x - pose.shift);
                Mat3d hessian = Mat3d::zero();
                for (int a = 0; a < 3; ++a) hessian(a, a) = curvatures[a];
                return PsiJet{side * 0.05 + 0.5 * y.dot(hessian * y), pose.turn * (hessian * y),
                              pose.turn * hessian * pose.turn.transpose()};
            };
            const auto gap = gapAt(pose.shift, jet(pose.shift));
            ASSERT_TRUE(gap);
            Bumps bumps(voxel);
            holdGaps(jet, {*gap}, {{gap->place, side * 0.1}}, voxel, bumps);
            const double reach = std::min(0.7 * voxel, 0.5);
            for (const double t : {-reach, 0.0, reach}) {
                const Vec3d x = pose.of({t, 0.0, 0.0});
                EXPECT_GT(side * (jet(x).psi + bumps.at(x)), 0.1) << voxel << " " << t;
            }
        }
    }
}

} // namespace
} // namespace molsurf
