// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface.h"

#include "molsurf/error.h"
#include "molsurf/kernel/flow/equilibrium.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/mesh/patch_gradients.h"
#include "molsurf/kernel/pipeline/carrier_of.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/topology/gaps_of_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

BallSet sixBalls()
{
    BallSet atoms;
    const float rows[][4] = {{0, 0, 0, 1.7f},          {2.25f, 0.5f, 0.25f, 1.5f},
                             {1, 2.5f, -0.5f, 1.625f}, {-1, 1.5f, 2, 1.25f},
                             {3.5f, 2, 1.5f, 1.75f},   {0.5f, 4.5f, 1.5f, 1.5f}};
    for (const auto& r : rows)
        atoms.balls.push_back({Vec3f(r[0], r[1], r[2]), r[3], int(atoms.balls.size())});
    return atoms;
}

MolecularSurface made(const BallSet& atoms, const SurfaceSpec& spec)
{
    SurfaceOptions options;
    static_cast<SurfaceSpec&>(options) = spec;
    return makeSurface(atoms, options);
}

MolecularSurface::Gradients gradientsOf(const BallSet& atoms, const SurfaceSpec& spec)
{
    return surfaceGradients(atoms, spec, made(atoms, spec).mesh);
}

double rmsOf(const std::vector<Vec3d>& gradients)
{
    double squares = 0.0;
    for (const Vec3d& g : gradients) squares += g.lengthSqr();
    return std::sqrt(squares / double(3 * gradients.size()));
}

/// Holds the derivatives by one coordinate of each of two balls against differences of 0.05 Å.
void expectDifferences(const BallSet& atoms, const SurfaceSpec& spec, double tolerance)
{
    const MolecularSurface::Gradients found = gradientsOf(atoms, spec);
    for (const auto& [ball, axis] : {std::pair(2, 1), {4, 2}}) {
        double area[2], volume[2];
        for (int side = 0; side < 2; ++side) {
            BallSet moved = atoms;
            moved.balls[std::size_t(ball)].center[axis] += side == 0 ? -0.05f : 0.05f;
            const SurfaceReport report = made(moved, spec).report.surface;
            area[side] = report.area;
            volume[side] = report.volume;
        }
        const std::string where = std::string(1, char('x' + axis)) + std::to_string(ball);
        EXPECT_NEAR(found.area[std::size_t(ball)][axis], (area[1] - area[0]) / 0.1,
                    tolerance * rmsOf(found.area))
            << where;
        EXPECT_NEAR(found.volume[std::size_t(ball)][axis], (volume[1] - volume[0]) / 0.1,
                    tolerance * rmsOf(found.volume))
            << where;
    }
}

TEST(SmoothForces, AreDifferences)
{
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SmoothAccessible}) {
        SurfaceSpec spec;
        spec.kind = kind;
        spec.voxel = 0.25;
        SCOPED_TRACE(int(kind));
        expectDifferences(sixBalls(), spec, 0.01);
    }
}

// lambda moves the level of psi by a quarter of it here, and the level depends on the balls.
TEST(SmoothForces, FollowTheLevelAtRest)
{
    SurfaceSpec spec;
    spec.voxel = 0.25;
    spec.epsilon = 0.25;
    spec.evolution.lambda = 0.01;
    expectDifferences(sixBalls(), spec, 0.01);
    spec.epsilon = 0.5;
    spec.evolution.regularizer = Regularizer::Area;
    spec.evolution.lambda = 0.005;
    expectDifferences(sixBalls(), spec, 0.01);
}

TEST(SmoothForces, FollowResolutions)
{
    BallSet atoms = sixBalls();
    atoms.decays.resize(atoms.balls.size());
    for (std::size_t i = 0; i < 3; ++i) atoms.decays[i].rate = 0.4f;
    SurfaceSpec spec;
    spec.voxel = 0.25;
    expectDifferences(atoms, spec, 0.02);
}

TEST(SmoothForces, AddUpToNothing)
{
    SurfaceSpec spec;
    const MolecularSurface::Gradients found = gradientsOf(sixBalls(), spec);
    for (const auto* gradients : {&found.area, &found.volume}) {
        Vec3d sum(0.0);
        double lengths = 0.0;
        for (const Vec3d& g : *gradients) {
            sum += g;
            lengths += g.length();
        }
        EXPECT_GT(lengths, 10.0);
        EXPECT_LT(sum.length(), 1e-9 * lengths);
    }
}

/// psi - v of a surface for balls in other places, with the bumps of their own gaps.
class ByDifferences
{
public:
    ByDifferences(const BallSet& atoms, const SurfaceSpec& spec)
        : balls_(atoms.balls), options_(gaussianOptions(spec)),
          weights_(weightsOf(flowOptions(spec)))
    {
        const std::vector<double> slopes = slopesOf(balls_, options_, {});
        least_ = 0.2 * *std::min_element(slopes.begin(), slopes.end());
        addSum(balls_, spec);
        if (bumps() > 0) step_ = 1.0 / 128.0; // the places of bumps are rounded to 2^-16 Å
        for (std::size_t k = 0; k < 6 * balls_.size(); ++k) {
            std::vector<Ball> moved = balls_;
            moved[k / 6].center[int(k / 2 % 3)] += k % 2 == 0 ? -float(step_) : float(step_);
            addSum(moved, spec);
        }
    }

    std::size_t bumps() const { return sums_[0].bumps().size(); }

    /// The derivatives of the volume over nodes that move along their normals as psi - v = 0 does,
    /// and with them a share of each ball that makes a translation one of all.
    std::vector<Vec3d> ofVolume(const PatchNodes& nodes) const
    {
        std::vector<Vec3d> out(balls_.size(), Vec3d(0.0));
        for (std::size_t n = 0; n < nodes.points.size(); ++n) add(nodes, n, out);
        return out;
    }

private:
    void addSum(const std::vector<Ball>& balls, const SurfaceSpec& spec)
    {
        GaussianSum& sum = sums_.emplace_back(balls, options_);
        const auto rule = gapRuleOf(spec);
        GapReport report;
        if (rule)
            sum.band(0, Progress(), openvdb::CoordBBox::inf(), [&](const SparseField& psi) {
                return bumpsOfGaps(sum, psi, *rule, Progress(), report);
            });
    }

    double at(std::size_t sum, const Vec3d& x) const
    {
        const PsiJet jet = sums_[sum].jetWithBumps(x);
        return jet.psi - levelAtRest(jet, least_, weights_).v;
    }

    void add(const PatchNodes& nodes, std::size_t n, std::vector<Vec3d>& out) const
    {
        const Vec3d& normal = nodes.normals[n];
        double low = -0.3, high = 0.3; // of a surface without an offset
        while (high - low > 1e-6) {
            const double way = 0.5 * (low + high);
            (at(0, nodes.points[n] + way * normal) > 0.0 ? low : high) = way;
        }
        const Vec3d x = nodes.points[n] + low * normal;
        const double slope =
            std::max((at(0, x - 0.01 * normal) - at(0, x + 0.01 * normal)) / 0.02, least_);
        std::vector<Vec3d> speeds(balls_.size());
        std::vector<double> shares(balls_.size());
        double total = 0.0;
        Vec3d lacks = normal;
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            for (int a = 0; a < 3; ++a) {
                const std::size_t moved = 6 * i + 2 * std::size_t(a) + 1;
                speeds[i][a] = (at(moved + 1, x) - at(moved, x)) / (2.0 * step_ * slope);
            }
            lacks -= speeds[i];
            const double R = balls_[i].radius + options_.probe;
            shares[i] =
                std::exp(options_.rate(R) * (R * R - (x - Vec3d(balls_[i].center)).lengthSqr()));
            total += shares[i];
        }
        const double along = nodes.volume[n].dot(normal);
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const double share = shares[i] / total;
            out[i] +=
                along * (speeds[i] + share * lacks) + share * (nodes.volume[n] - along * normal);
        }
    }

    std::vector<Ball> balls_;
    GaussianOptions options_;
    Weights weights_;
    double least_, step_ = 1.0 / 512.0; // [Å]
    std::deque<GaussianSum> sums_;      // first of the balls themselves
};

/// Holds the derivatives of the volume against differences of psi - v.
void expectTheLevelsDerivatives(const BallSet& atoms, const SurfaceSpec& spec, bool hasBumps)
{
    const ByDifferences wanted(atoms, spec);
    EXPECT_EQ(wanted.bumps() > 0, hasBumps);
    const Mesh mesh = made(atoms, spec).mesh;
    const std::vector<Vec3d> found = surfaceGradients(atoms, spec, mesh).volume,
                             by = wanted.ofVolume(patchNodes(mesh));
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
        worst = std::max(worst, (found[i] - by[i]).length());
    EXPECT_LT(worst, (hasBumps ? 5e-3 : 2e-4) * rmsOf(by));
}

// The interface itself moves as psi - v changes at fixed points, which differences of it show,
// also where the field has bumps that hold a gap and follow the atoms: six atoms about a cavity.
TEST(SmoothForces, AreThoseOfTheLevelAtEachPoint)
{
    SurfaceSpec spec;
    spec.kind = SurfaceKind::SmoothAccessible;
    for (const Regularizer regularizer : {Regularizer::Gradient, Regularizer::Area}) {
        spec.evolution.regularizer = regularizer;
        spec.evolution.lambda = 0.02;
        SCOPED_TRACE(int(regularizer));
        expectTheLevelsDerivatives(sixBalls(), spec, false);
    }
    spec.evolution = {};
    spec.evolution.lambda = 1e-3;
    BallSet cage; // not symmetric: where curvatures are equal, the bump has a kink
    for (int i = 0; i < 6; ++i) {
        Vec3d x(0.13, -0.21, 0.07);
        const double way = 3.7 + 0.06 * (i % 3);
        x[i % 3] += i < 3 ? way : 0.02 - way;
        cage.balls.push_back({x, 1.7f, i});
    }
    expectTheLevelsDerivatives(cage, spec, true);
}

// A ring whose hole tension closes: psi is -0.3 in its middle. A ball far away is none of it.
TEST(SmoothForces, KnowWhichBallsLieBesideAGap)
{
    const double R = 3.1, C = M_LN2 / (0.5 * R), d = std::sqrt(R * R + (std::log(4.0) + 0.3) / C);
    BallSet atoms;
    for (int k = 0; k < 4; ++k) {
        Vec3d x(0.0);
        x[k / 2] = k % 2 ? d : -d;
        atoms.balls.push_back({x, 1.7f, k});
    }
    atoms.balls.push_back({Vec3d(40.0, 0.0, 0.0), 1.7f, 4});
    EXPECT_EQ(gradientsOf(atoms, SurfaceSpec()).besideGap, (std::vector<char>{1, 1, 1, 1, 0}));
    atoms.balls.erase(atoms.balls.begin());
    EXPECT_EQ(gradientsOf(atoms, SurfaceSpec()).besideGap, (std::vector<char>{0, 0, 0, 0}));
}

// Four balls about ridges that are rounded, and one beyond, whose derivatives follow differences.
TEST(SmoothForces, KnowWhichBallsLieBesideARidge)
{
    const double places[][3] = {{0.0, 0.0, -2.5},
                                {-3.5, -1.0, -1.0},
                                {-0.5, -3.0, -4.0},
                                {2.0, 2.5, 0.5},
                                {-3.5, -0.5, 1.0}};
    SurfaceSpec spec;
    spec.voxel = 0.25;
    BallSet atoms;
    for (const auto& x : places)
        atoms.balls.push_back({Vec3d(x[0], x[1], x[2]), 1.7, int(atoms.balls.size())});
    const auto found = gradientsOf(atoms, spec);
    EXPECT_EQ(found.besideRidge, (std::vector<char>{1, 1, 0, 1, 1}));
    EXPECT_EQ(found.besideGap, (std::vector<char>{0, 0, 0, 0, 0}));
    constexpr double step = 0.05; // [Å]
    const auto error = [&](std::size_t ball, int axis) {
        double area[2];
        for (const int side : {0, 1}) {
            BallSet moved = atoms;
            moved.balls[ball].center[axis] += side ? step : -step;
            area[side] = made(moved, spec).report.surface.area;
        }
        return std::abs(found.area[ball][axis] - (area[1] - area[0]) / (2.0 * step)) /
               rmsOf(found.area);
    };
    EXPECT_LT(error(2, 0), 0.02);
    EXPECT_LT(error(2, 2), 0.02);
    EXPECT_GT(std::max(error(0, 0), error(0, 2)), 0.02); // what the mark is for
    spec.kind = SurfaceKind::SmoothAccessible;           // has no ridges
    EXPECT_EQ(gradientsOf(atoms, spec).besideRidge, std::vector<char>(5, 0));
}

// A hole that tension closes stays closed as its ring breathes: the film moves with the atoms.
TEST(SmoothForces, FollowAHeldGap)
{
    const double R = 3.1, C = M_LN2 / (0.5 * R), d = std::sqrt(R * R + (std::log(4.0) + 0.2) / C);
    SurfaceSpec spec;
    spec.kind = SurfaceKind::SmoothAccessible;
    spec.voxel = 0.25;
    BallSet atoms;
    for (int k = 0; k < 4; ++k) {
        Vec3d x(0.0);
        x[k / 2] = (k % 2 ? d : -d) * (1.0 + 0.002 * k);
        atoms.balls.push_back({x, 1.7f, k});
    }
    const MolecularSurface surface = made(atoms, spec);
    ASSERT_EQ(surface.report.evolution->gaps->closed, 1u);
    const auto found = surfaceGradients(atoms, spec, surface.mesh);
    constexpr double step = 0.01; // [Å]
    double area[2], volume[2];
    for (const int side : {0, 1}) {
        BallSet moved = atoms;
        moved.balls[1].center[0] += float(side ? step : -step);
        const SurfaceReport report = made(moved, spec).report.surface;
        area[side] = report.area;
        volume[side] = report.volume;
    }
    EXPECT_NEAR(found.area[1][0] / ((area[1] - area[0]) / (2.0 * step)), 1.0, 0.02);
    EXPECT_NEAR(found.volume[1][0] / ((volume[1] - volume[0]) / (2.0 * step)), 1.0, 0.01);
    for (const char marked : found.besideGap) EXPECT_EQ(marked, 0);
}

TEST(SmoothForces, AreRefusedWhereNothingKnowsThem)
{
    SurfaceSpec fronts, walls, filled, gaussian;
    gaussian.kind = SurfaceKind::Gaussian;
    fronts.evolution.lambda = 0.1;
    walls.minThickness = 2.0;
    filled.kind = SurfaceKind::SolventExcluded;
    filled.fillCavities = true;
    for (const SurfaceSpec& spec : {fronts, walls, filled, gaussian}) {
        try {
            surfaceGradients(sixBalls(), spec, Mesh());
            ADD_FAILURE();
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Usage);
        }
    }
    BallSet unit = sixBalls(); // whose neighbours are its images
    unit.placement.instances.resize(2);
    EXPECT_THROW(surfaceGradients(unit, {}, Mesh()), Error);
}

} // namespace
} // namespace molsurf
