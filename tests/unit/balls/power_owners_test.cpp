// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/power_owners.h"

#include <gtest/gtest.h>

#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

TEST(PowerOwners, TwoBallsMeetInThePlaneOfEqualPower)
{
    // |x|^2 - 4 = |x - 5|^2 - 1: x = 2.8.
    const PowerOwners owners({{Vec3f(0, 0, 0), 2.0f, 0}, {Vec3f(5, 0, 0), 1.0f, 1}}, {3, 1});
    std::vector<OwnersPower> near;
    owners.at({2.79, 1.0, 0.5}, 0.0, near);
    EXPECT_EQ(near[0].owner, 3);
    owners.at({2.81, 1.0, 0.5}, 1.0, near);
    ASSERT_EQ(near.size(), 2u);
    EXPECT_EQ(near[0].owner, 1);
    EXPECT_NEAR(near[0].power, 2.19 * 2.19 + 1.25 - 1.0, 1e-9);
    EXPECT_NEAR(near[1].power, 2.81 * 2.81 + 1.25 - 4.0, 1e-9);
    EXPECT_EQ(near[1].centre, Vec3d(0.0));
}

TEST(PowerOwners, TheLowerOfTwoOwnersHasWhatIsBetween)
{
    const std::vector<Ball> balls = {{Vec3f(-2, 0, 0), 1.5f, 0}, {Vec3f(2, 0, 0), 1.5f, 1}};
    std::vector<OwnersPower> near;
    for (const std::int32_t first : {3, 1}) {
        PowerOwners(balls, {first, 4 - first}).at({0.0, 0.7, 0.0}, 0.0, near);
        EXPECT_EQ(near[0].owner, 1);
    }
}

// Of two owners of which one is too far to be looked at, the near one has the point.
TEST(PowerOwners, TheOneThatIsThereHasThePoint)
{
    const PowerOwners owners({{Vec3f(0, 0, 0), 1.0f, 0}, {Vec3f(40, 0, 0), 1.0f, 1}}, {0, 1});
    std::vector<OwnersPower> near;
    EXPECT_EQ(owners.excess({1.0, 0.0, 0.0}, 0, 1, near).value, -16.0);
    EXPECT_EQ(owners.excess({1.0, 0.0, 0.0}, 1, 0, near).value, 16.0);
    EXPECT_EQ(owners.excess({1.0, 0.0, 0.0}, 0, -1, near).other, -1);
    EXPECT_NEAR(owners.excess({20.5, 0.0, 0.0}, 1, 0, near).value, 19.5 * 19.5 - 20.5 * 20.5, 1e-9);
}

// However large other balls are, and however far the point is from all.
TEST(PowerOwners, TellsAllOwnersWithinTheSlack)
{
    const PowerOwners owners(
        {{Vec3f(0, 0, 0), 1.0f, 0}, {Vec3f(5, 0, 0), 0.5f, 1}, {Vec3f(-90, 0, 0), 9.0f, 2}},
        {0, 1, 2});
    std::vector<OwnersPower> near;
    owners.at({1.5, 0.0, 0.0}, 16.0, near); // powers 1.25 and 12
    ASSERT_EQ(near.size(), 2u);
    EXPECT_EQ(near[0].owner, 0);
    EXPECT_NEAR(near[1].power, 12.0, 1e-9);
    owners.at({34.0, 3.0, 0.0}, 0.0, near); // 29 Å from the nearest ball
    ASSERT_FALSE(near.empty());
    EXPECT_EQ(near[0].owner, 1);
}

TEST(PowerOwners, AgreesWithAllBalls)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-12.0, 12.0), radius(0.5, 9.0);
    std::vector<Ball> balls;
    std::vector<std::int32_t> ownerOf;
    for (std::int32_t i = 0; i < 60; ++i) {
        balls.push_back(
            {Vec3f(Vec3d{place(random), place(random), place(random)}), float(radius(random)), i});
        ownerOf.push_back(i % 5);
    }
    const PowerOwners owners(balls, ownerOf);
    std::vector<OwnersPower> near;
    constexpr double slack = 10.0;
    for (int n = 0; n < 500; ++n) {
        const Vec3d x{place(random), place(random), place(random)};
        std::vector<double> least(5, 1e9);
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const double r = double(balls[i].radius);
            double& power = least[std::size_t(ownerOf[i])];
            power = std::min(power, (x - Vec3d(balls[i].center)).lengthSqr() - r * r);
        }
        const double first = *std::min_element(least.begin(), least.end());
        owners.at(x, slack, near);
        std::size_t expected = 0;
        for (const double power : least) expected += power <= first + slack;
        ASSERT_GE(near.size(), expected);
        for (std::size_t k = 0; k < expected; ++k)
            EXPECT_NEAR(near[k].power, least[std::size_t(near[k].owner)], 1e-9);
        EXPECT_EQ(near[0].power, first);
    }
}

} // namespace
} // namespace molsurf
