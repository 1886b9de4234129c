// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/covered_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

CapLists listsOf(std::vector<Cap> caps)
{
    std::sort(caps.begin(), caps.end(),
              [](const Cap& a, const Cap& b) { return a.cosine < b.cosine; });
    CapLists lists;
    lists.resize(caps.size());
    for (std::size_t k = 0; k < caps.size(); ++k) lists.set(k, caps[k]);
    return lists;
}

bool isCovered(const CapLists& caps)
{
    return isSphereSurelyCovered(caps, std::size_t(caps.size()));
}

/// Six caps about the axes; they cover a sphere if their half angle is above acos(1/sqrt(3)).
std::vector<Cap> sixCaps(double halfAngle)
{
    std::vector<Cap> caps;
    for (int a = 0; a < 3; ++a) {
        for (const double sign : {-1.0, 1.0}) {
            Vec3d axis(0.0);
            axis[a] = sign;
            caps.push_back({axis, std::cos(halfAngle), 0});
        }
    }
    return caps;
}

TEST(CoveredSphere, SixCaps)
{
    const double least = std::acos(1.0 / std::sqrt(3.0)), cell = 0.3;
    EXPECT_FALSE(isCovered(listsOf(sixCaps(least - 1e-3))));
    EXPECT_TRUE(isCovered(listsOf(sixCaps(least + cell))));
    EXPECT_FALSE(isCovered(CapLists()));
    std::vector<Cap> open = sixCaps(least + cell);
    for (std::size_t k = 0; k < 6; ++k) { // one small cap does not make up for a large one
        std::vector<Cap> caps = open;
        caps[k].cosine = std::cos(0.05);
        EXPECT_FALSE(isCovered(listsOf(caps))) << k;
    }
}

/// A sphere with a free point is never covered; one that is covered with room nearly always is.
TEST(CoveredSphere, NoFreePoint)
{
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(0.15, 1.2);
    const auto direction = [&] {
        Vec3d u(normal(random), normal(random), normal(random));
        u.normalize();
        return u;
    };
    int covered = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<Cap> caps;
        const Vec3d free = direction();
        while (caps.size() < 60) {
            const Cap cap{direction(), std::cos(angle(random)), 0};
            const bool keepsFree = trial % 2 == 0;
            if (keepsFree && cap.axis.dot(free) > cap.cosine) continue;
            caps.push_back(cap);
        }
        const bool found = isCovered(listsOf(caps));
        if (trial % 2 == 0) {
            EXPECT_FALSE(found) << trial;
        } else {
            covered += found;
        }
    }
    EXPECT_GT(covered, 500) << "of 1000";
}

} // namespace
} // namespace molsurf
