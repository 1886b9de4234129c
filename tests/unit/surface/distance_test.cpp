// SPDX-License-Identifier: MPL-2.0
// Distances of points from surfaces, against searches through all that the nearest point can lie
// on.

#include "molsurf/error.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace molsurf::test
{
namespace
{

using openvdb::Vec3d;

/// Searches the boundary of a union of balls without any index: feet on spheres, on circles of two
/// and points of three, as far as no ball covers them.
class BruteForce
{
public:
    BruteForce(std::vector<Ball> balls, double probe) : balls_(std::move(balls))
    {
        for (Ball& ball : balls_) ball.radius += probe;
        for (std::size_t i = 0; i < balls_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k) addCorners(i, j, k);
    }

    double distance(const Vec3d& x) const
    {
        double gap = std::numeric_limits<double>::infinity(), best = gap;
        for (const Ball& b : balls_) gap = std::min(gap, (x - b.center).length() - b.radius);
        if (gap >= 0.0) return gap;
        const auto offer = [&](const Vec3d& point) {
            if (isBare(point)) best = std::min(best, (point - x).length());
        };
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const Ball& a = balls_[i];
            offer(a.center + a.radius * (x - a.center).unit());
            for (std::size_t j = 0; j < i; ++j) {
                Vec3d centre, axis;
                const double radius = circle(a, balls_[j], centre, axis);
                if (!(radius > 0.0)) continue;
                const Vec3d offset = x - centre;
                offer(centre + radius * (offset - offset.dot(axis) * axis).unit());
            }
        }
        for (const Vec3d& corner : corners_) offer(corner);
        return -best;
    }

private:
    bool isBare(const Vec3d& point) const
    {
        return std::all_of(balls_.begin(), balls_.end(), [&](const Ball& b) {
            return (point - b.center).length() > b.radius - 1e-9;
        });
    }

    /// The circle of two spheres. @return its radius; 0: they do not meet
    static double circle(const Ball& a, const Ball& b, Vec3d& centre, Vec3d& axis)
    {
        const double d = (b.center - a.center).length();
        axis = (b.center - a.center) / d;
        const double along = (d * d + a.radius * a.radius - b.radius * b.radius) / (2.0 * d);
        centre = a.center + along * axis;
        return along * along < a.radius * a.radius ? std::sqrt(a.radius * a.radius - along * along)
                                                   : 0.0;
    }

    void addCorners(std::size_t i, std::size_t j, std::size_t k)
    {
        Vec3d centre, axis;
        const double radius = circle(balls_[i], balls_[j], centre, axis);
        if (!(radius > 0.0)) return;
        // Where that circle meets the third sphere: u in the plane of the circle.
        const Ball& c = balls_[k];
        const Vec3d to = c.center - centre, flat = to - to.dot(axis) * axis;
        const double wanted =
            (to.lengthSqr() + radius * radius - c.radius * c.radius) / (2.0 * radius);
        const double length = flat.length();
        if (!(std::abs(wanted) < length)) return;
        const Vec3d u = flat / length, v = axis.cross(u);
        const double cosine = wanted / length, sine = std::sqrt(1.0 - cosine * cosine);
        for (const double side : {-1.0, 1.0})
            corners_.push_back(centre + radius * (cosine * u + side * sine * v));
    }

    std::vector<Ball> balls_;
    std::vector<Vec3d> corners_;
};

std::vector<Vec3d> randomPoints(int count, double edge, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.5 * edge, 0.5 * edge);
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i)
        points.emplace_back(place(random), place(random), place(random));
    return points;
}

std::int32_t nearestOf(const std::vector<Ball>& balls, const Vec3d& x)
{
    std::int32_t best = 0;
    const auto gap = [&](const Ball& b) { return (x - b.center).length() - b.radius; };
    for (std::size_t i = 1; i < balls.size(); ++i)
        if (gap(balls[i]) < gap(balls[std::size_t(best)])) best = std::int32_t(i);
    return best;
}

TEST(SurfaceDistance, OfUnionsIsThatOfASearchThroughAllBalls)
{
    BallSet atoms;
    atoms.balls = randomBalls(40, 12.0, Vec3d(0.0), 3);
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals}) {
        SurfaceOptions options;
        options.kind = kind;
        options.grid = false;
        const SurfaceDistance to(atoms, options, makeSurface(atoms, options));
        const BruteForce reference(atoms.balls,
                                   kind == SurfaceKind::VanDerWaals ? 0.0 : options.probe);
        int inside = 0;
        const std::vector<Vec3d> points = randomPoints(600, 18.0, 5);
        const std::vector<PointDistance> found = to.at(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const PointDistance& d = found[i];
            EXPECT_NEAR(d.distance, reference.distance(points[i]), 1e-5) << i;
            EXPECT_NEAR((d.closest - points[i]).length(), std::abs(d.distance), 1e-8);
            EXPECT_NEAR(reference.distance(d.closest), 0.0, 1e-5);
            EXPECT_NEAR(d.normal.length(), 1.0, 1e-12);
            EXPECT_NEAR(d.normal.dot(points[i] - d.closest), d.distance, 1e-6);
            EXPECT_EQ(d.ball, nearestOf(atoms.balls, points[i]));
            inside += d.distance < 0.0;
        }
        EXPECT_GT(inside, 50);
    }
}

// Of balls that are equally near it is the first one.
TEST(SurfaceDistance, OfBallsAsNearTheFirstIsMeant)
{
    for (const double away : {2.5, 6.0, 40.0}) {
        BallSet atoms;
        for (const double side : {away, -away}) // in one order, then in the other
            for (int axis = 0; axis < 3; ++axis) {
                Vec3d x(0.0);
                x[axis] = side;
                atoms.balls.push_back({x, 1.5, std::int32_t(atoms.balls.size())});
            }
        SurfaceOptions options;
        options.kind = SurfaceKind::VanDerWaals;
        options.grid = false;
        for (int turn = 0; turn < 6; ++turn) {
            const SurfaceDistance to(atoms, options, makeSurface(atoms, options));
            const PointDistance found = to.at({Vec3d(0.0)})[0];
            EXPECT_EQ(found.ball, 0) << away << " " << turn;
            EXPECT_NEAR(found.distance, away - 1.5, 1e-12);
            std::rotate(atoms.balls.begin(), atoms.balls.begin() + 1, atoms.balls.end());
        }
    }
}

TEST(SurfaceDistance, FarFromEverythingIsExact)
{
    BallSet atoms;
    atoms.balls = {{{0.0, 0.0, 0.0}, 2.0, 0}, {{3.0, 0.0, 0.0}, 1.0, 1}};
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    const SurfaceDistance to(atoms, options, makeSurface(atoms, options));
    const auto found = to.at({{9e5, 0.0, 0.0}, {0.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}});
    EXPECT_NEAR(found[0].distance, 9e5 - 4.0, 1e-9);
    EXPECT_EQ(found[0].ball, 1);
    EXPECT_NEAR(found[1].distance, -2.0, 1e-7);
    EXPECT_NEAR(found[2].distance, 0.0, 1e-7);
}

TEST(SurfaceDistance, OfOtherKindsIsThatOfTheirSurface)
{
    BallSet atoms; // one ball: its solvent-excluded surface is its own
    atoms.balls = {{{0.3, 0.1, -0.2}, 3.0, 0}};
    for (const SurfaceKind kind : {SurfaceKind::SolventExcluded, SurfaceKind::Variational}) {
        SurfaceOptions options;
        options.kind = kind;
        options.voxel = 0.4;
        const MolecularSurface surface = makeSurface(atoms, options);
        const double radius = kind == SurfaceKind::SolventExcluded
                                  ? 3.0
                                  : std::cbrt(0.75 * surface.report.surface.volume / M_PI);
        const SurfaceDistance to(atoms, options, surface);
        const std::vector<Vec3d> points = randomPoints(300, 12.0, 7);
        const std::vector<PointDistance> found = to.at(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double exact = (points[i] - atoms.balls[0].center).length() - radius;
            EXPECT_NEAR(found[i].distance, exact, 0.01) << nameOf(kind) << " " << i;
            EXPECT_GT(found[i].normal.dot((found[i].closest - atoms.balls[0].center).unit()), 0.99);
        }
    }
}

TEST(SurfaceDistance, FilledCavitiesAreInside)
{
    BallSet atoms; // a hollow shell
    for (int k = 0; k < 400; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 400, turn = k * M_PI * (3.0 - std::sqrt(5.0));
        const double rim = std::sqrt(1.0 - z * z);
        atoms.balls.push_back({8.0 * Vec3d(rim * std::cos(turn), rim * std::sin(turn), z), 1.5, k});
    }
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventAccessible;
    EXPECT_GT(
        SurfaceDistance(atoms, options, makeSurface(atoms, options)).at({Vec3d(0.0)})[0].distance,
        4.0);
    options.fillCavities = true;
    EXPECT_LT(
        SurfaceDistance(atoms, options, makeSurface(atoms, options)).at({Vec3d(0.0)})[0].distance,
        -10.0);
}

TEST(SurfaceDistance, RefusesPointsThatAreNone)
{
    BallSet atoms;
    atoms.balls = {{{0.0, 0.0, 0.0}, 2.0, 0}};
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    const SurfaceDistance to(atoms, options, makeSurface(atoms, options));
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 2e6}) {
        try {
            to.at({Vec3d(0.0), {0.0, bad, 0.0}});
            ADD_FAILURE() << bad << " was taken";
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
            EXPECT_EQ(std::string(e.what()).find("point 1: "), 0u) << e.what();
        }
    }
    EXPECT_TRUE(to.at({}).empty());
}

} // namespace
} // namespace molsurf::test
