// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/sphere_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

Vec3d unit(double x, double y, double z)
{
    Vec3d u(x, y, z);
    u.normalize();
    return u;
}

SphereRegion regionOf(const std::vector<SphereCap>& caps, const Vec3d& inside)
{
    RegionScratch scratch;
    SphereRegion region;
    findRegion(caps, inside, scratch, region);
    EXPECT_EQ(regionArea(caps, inside, scratch), region.area);
    return region;
}

/// What is outside of an octant.
std::vector<SphereCap> octant()
{
    return {{Vec3d(-1, 0, 0), 0.0}, {Vec3d(0, -1, 0), 0.0}, {Vec3d(0, 0, -1), 0.0}};
}

TEST(SphereRegion, AnOctant)
{
    const SphereRegion region = regionOf(octant(), unit(1, 1, 1));
    EXPECT_NEAR(region.area, 0.5 * M_PI, 1e-14);
    EXPECT_LT(region.mismatch, 1e-14);
    ASSERT_EQ(region.faces.size(), 1u);
    EXPECT_EQ(region.faces[0].characteristic, 1);
    EXPECT_NEAR(region.faces[0].normal.length(), 0.25 * M_PI * std::sqrt(3.0), 1e-14);
    EXPECT_EQ(region.arcs.size(), 3u);
}

TEST(SphereRegion, OneCapAndTwo)
{
    for (const double c : {-0.4, 0.0, 0.3}) {
        const SphereRegion region =
            regionOf({{Vec3d(0, 0, -1), c}, {Vec3d(0, 0, 1), 0.6}}, unit(0.001, 0.002, 1));
        EXPECT_NEAR(region.area, 2.0 * M_PI * (c + 0.6), 1e-13);
        EXPECT_LT(region.mismatch, 1e-13);
        ASSERT_EQ(region.faces.size(), 1u);
        EXPECT_EQ(region.faces[0].characteristic, 0); // a ring
        EXPECT_NEAR(region.faces[0].normal.z(), M_PI * ((1.0 - c * c) - (1.0 - 0.36)), 1e-13);
    }
}

TEST(SphereRegion, HolesBelongToTheFaceAboutThem)
{
    const double near = std::cos(0.05);
    std::vector<SphereCap> caps = octant();
    caps.push_back({unit(1, 1, 1), near});
    SphereRegion region = regionOf(caps, unit(1, 1, 1));
    ASSERT_EQ(region.faces.size(), 1u);
    EXPECT_EQ(region.faces[0].characteristic, 0);
    EXPECT_NEAR(region.area, 0.5 * M_PI - 2.0 * M_PI * (1.0 - near), 1e-14);

    // A chain of caps parts the octant, with two holes on one side of it.
    caps.pop_back();
    for (int k = 0; k <= 30; ++k) {
        const double a = 0.5 * M_PI * k / 30.0;
        caps.push_back({unit(std::cos(a), std::sin(a), 0.75), near});
    }
    for (const bool below : {true, false}) {
        std::vector<SphereCap> all = caps;
        all.push_back({below ? unit(1, 1, 0.4) : unit(0.5, 0.5, 1), near});
        all.push_back({below ? unit(1, 0.2, 0.3) : unit(0.1, 0.5, 1), near});
        region = regionOf(all, unit(1, 1, 1));
        EXPECT_LT(region.mismatch, 1e-10);
        ASSERT_EQ(region.faces.size(), 2u);
        const auto& [a, b] = std::pair(region.faces[0], region.faces[1]);
        EXPECT_EQ(std::min(a.characteristic, b.characteristic), -1);
        EXPECT_EQ(std::max(a.characteristic, b.characteristic), 1);
        // The mean height of a face is that of its normal over its area.
        const RegionFace& holed = a.characteristic < 0 ? a : b;
        const RegionFace& other = a.characteristic < 0 ? b : a;
        EXPECT_EQ(holed.normal.z() / holed.area < other.normal.z() / other.area, below);
        EXPECT_NEAR(a.area + b.area, region.area, 1e-14);
    }
}

// Where two rims of nearly one plane cross is ill-conditioned; what they bound is not.
TEST(SphereRegion, PlanesThatAreNearlyOneAreOne)
{
    const Vec3d whole = regionOf(octant(), unit(1, 1, 1)).faces[0].normal;
    for (double apart = 1e-3; apart > 1e-12; apart /= 3.0) { // nearer ones are left out
        for (const double at : {0.3, 0.9}) { // where along the side they cross [rad]
            std::vector<SphereCap> caps = octant();
            const Vec3d across(0.0, std::sin(at), -std::cos(at));
            caps.push_back({unit(-1.0, apart * across.y(), apart * across.z()), 0.0});
            for (const bool first : {false, true}) {
                if (first) std::reverse(caps.begin(), caps.end());
                const SphereRegion region = regionOf(caps, unit(1, 1, 1));
                EXPECT_NEAR(region.area, 0.5 * M_PI, apart + 1e-14) << apart;
                ASSERT_EQ(region.faces.size(), 1u);
                EXPECT_LT((region.faces[0].normal - whole).length(), apart + 1e-14) << apart;
            }
        }
        // A lune, between planes that face each other.
        const Vec3d one = unit(-1, 0.2, 0.1), other = unit(1, -0.2 + apart, -0.1);
        const double lune = regionOf({{one, 0.0}, {other, 0.0}}, unit(0.3, 1.0, 0.99)).area;
        EXPECT_NEAR(lune, 2.0 * std::asin(one.cross(other).length()), 1e-3 * apart);
    }
}

TEST(SphereRegion, NothingIsLeft)
{
    std::vector<SphereCap> caps = octant();
    caps.push_back({unit(1, 1, 1), 0.5}); // the octant's corners are at 0.577
    const SphereRegion region = regionOf(caps, unit(1, 1, 1));
    EXPECT_TRUE(region.arcs.empty());
    EXPECT_TRUE(region.faces.empty());
    EXPECT_EQ(region.area, 0.0);
}

TEST(SphereRegion, RimsThatNearlyMeetMoveTheAreaLittle)
{
    for (const double apart : {1e-3, 1e-6, 1e-9, 1e-12}) {
        std::vector<SphereCap> caps = octant();
        caps.push_back({unit(-1.0, apart, -0.7 * apart), 0.3 * apart}); // all but the first rim
        const SphereRegion region = regionOf(caps, unit(1, 1, 1));
        EXPECT_NEAR(region.area, 0.5 * M_PI, 2.0 * apart + 1e-14) << apart;
    }
}

} // namespace
} // namespace molsurf
