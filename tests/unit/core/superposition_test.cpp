// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/superposition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

std::vector<Vec3d> randomPoints(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 10.0);
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < count; ++i)
        points.emplace_back(normal(random), normal(random), normal(random));
    return points;
}

/// Turned about an axis by an angle (Rodrigues), and shifted.
Vec3d moved(const Vec3d& x, const Vec3d& axis, double angle, const Vec3d& shift)
{
    const Vec3d n = axis.unit();
    return std::cos(angle) * x + std::sin(angle) * n.cross(x) +
           (1.0 - std::cos(angle)) * n.dot(x) * n + shift;
}

double rmsdOf(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).lengthSqr();
    return std::sqrt(sum / double(a.size()));
}

} // namespace

TEST(Superposition, UndoesARigidMotion)
{
    // Half turns about the axes make two entries of the quaternion zero.
    for (const Vec3d& axis : {Vec3d(1, 2, 3), Vec3d(1, 0, 0), Vec3d(0, 0, -1), Vec3d(-1, 1, 0)}) {
        for (const double angle : {0.0, 1e-7, 0.4, M_PI / 2, M_PI}) {
            const std::vector<Vec3d> onto = randomPoints(20, 1);
            std::vector<Vec3d> points;
            for (const Vec3d& x : onto) points.push_back(moved(x, axis, angle, {900, -40, 3}));
            const auto found = superposition(points, onto);
            ASSERT_TRUE(found);
            EXPECT_EQ(found->pairs, 20u);
            EXPECT_LT(found->rmsd, 1e-11);
            for (std::size_t i = 0; i < points.size(); ++i)
                EXPECT_LT((found->placed(points[i]) - onto[i]).length(), 1e-11);
        }
    }
}

TEST(Superposition, HasTheLeastDistance)
{
    std::vector<Vec3d> points = randomPoints(30, 2), onto = randomPoints(30, 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        onto[i] = moved(points[i], {3, -1, 2}, 1.2, {5, 5, 5}) + 0.1 * onto[i];
    const auto found = superposition(points, onto);
    ASSERT_TRUE(found);
    std::vector<Vec3d> laid;
    for (const Vec3d& x : points) laid.push_back(found->placed(x));
    EXPECT_NEAR(rmsdOf(laid, onto), found->rmsd, 1e-12);
    const Vec3d middle = [&] {
        Vec3d sum(0.0);
        for (const Vec3d& x : onto) sum += x;
        return sum / double(onto.size());
    }();
    for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}) {
        for (const double step : {-0.01, 0.01}) {
            std::vector<Vec3d> turned, shifted;
            for (const Vec3d& x : laid) {
                turned.push_back(moved(x - middle, axis, step, middle));
                shifted.push_back(x + step * axis);
            }
            EXPECT_GT(rmsdOf(turned, onto), found->rmsd);
            EXPECT_GT(rmsdOf(shifted, onto), found->rmsd);
        }
    }
}

TEST(Superposition, IsNoMirrorImage)
{
    const std::vector<Vec3d> onto = randomPoints(12, 4);
    std::vector<Vec3d> points;
    for (const Vec3d& x : onto) points.emplace_back(-x[0], x[1], x[2]);
    const auto found = superposition(points, onto);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->matrix().det(), 1.0, 1e-12);
    EXPECT_GT(found->rmsd, 1.0);
}

TEST(Superposition, TakesPointsOfAPlane)
{
    const std::vector<Vec3d> onto = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}};
    std::vector<Vec3d> points;
    for (const Vec3d& x : onto) points.push_back(moved(x, {1, 1, 1}, 2.0, {1, 2, 3}));
    const auto found = superposition(points, onto);
    ASSERT_TRUE(found);
    EXPECT_LT(found->rmsd, 1e-12);
}

TEST(Superposition, NeedsThreePointsThatAreNotOnALine)
{
    const std::vector<Vec3d> two = {{0, 0, 0}, {1, 0, 0}},
                             line = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {5, 5, 0}},
                             same = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    EXPECT_FALSE(superposition(two, two));
    EXPECT_FALSE(superposition(line, line));
    EXPECT_FALSE(superposition(same, same));
}

} // namespace molsurf
