// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/proximity/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

/// Triangles of all sizes in random places, some of them needles or points.
Mesh soup(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-20.0f, 20.0f), shape(-1.0f, 1.0f);
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3f p{place(random) + 30.0f, place(random), place(random)};
        const float size = std::exp(3.0f * shape(random)) * 0.3f;
        const auto corner = [&] {
            return p + size * Vec3f{shape(random), shape(random), shape(random)};
        };
        const auto n = std::uint32_t(mesh.positions.size());
        mesh.positions.push_back(p);
        mesh.positions.push_back(i % 50 == 7 ? p : corner());
        mesh.positions.push_back(i % 50 == 9 ? 2.0f * mesh.positions.back() - p : corner());
        mesh.triangles.push_back({n, n + 1, n + 2});
    }
    return mesh;
}

/// Distance to one triangle by another way: the best of a plane point inside and three segments.
double plainDistance(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& x)
{
    const auto segment = [&](const Vec3d& p, const Vec3d& q) {
        const Vec3d e = q - p;
        const double t = e.lengthSqr() > 0.0 ? e.dot(x - p) / e.lengthSqr() : 0.0;
        return (x - p - std::min(std::max(t, 0.0), 1.0) * e).length();
    };
    double best = std::min({segment(a, b), segment(b, c), segment(c, a)});
    const Vec3d n = (b - a).cross(c - a);
    if (n.lengthSqr() < 1e-16) return best;
    const auto side = [&](const Vec3d& p, const Vec3d& q) { return n.dot((q - p).cross(x - p)); };
    if (side(a, b) >= 0.0 && side(b, c) >= 0.0 && side(c, a) >= 0.0)
        best = std::min(best, std::abs(n.unit().dot(x - a)));
    return best;
}

TEST(ClosestPoint, IsThatOfASearchThroughAll)
{
    const Mesh mesh = soup(3000, 1);
    const ClosestPoint closest(mesh);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-25.0, 25.0);
    for (int i = 0; i < 300; ++i) {
        const double far = i % 10 == 0 ? 40.0 : 1.0; // some from far away
        const Vec3d x = far * Vec3d{place(random) + 30.0, place(random), place(random)};
        double best = 1e30;
        for (const auto& t : mesh.triangles)
            best = std::min(best,
                            plainDistance(Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                                          Vec3d(mesh.positions[t[2]]), x));
        const MeshPoint found = closest.at(x);
        EXPECT_NEAR((x - found.point).length(), best, 1e-9 * (1.0 + best)) << x;
        Vec3d again(0.0);
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(found.weights[k], 0.0);
            again += found.weights[k] * Vec3d(mesh.positions[mesh.triangles[found.triangle][k]]);
        }
        EXPECT_LT((again - found.point).length(), 1e-9 * (1.0 + found.point.length()));
    }
}

TEST(ClosestPoint, OfACornerIsTheCornerExactly)
{
    const Mesh mesh = soup(500, 3);
    const ClosestPoint closest(mesh);
    for (const Vec3f& p : mesh.positions)
        EXPECT_EQ((closest.at(Vec3d(p)).point - Vec3d(p)).length(), 0.0);
}

TEST(ClosestPoint, OfEquallyNearTrianglesIsTheFirst)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(100, {0, 1, 2});
    EXPECT_EQ(ClosestPoint(mesh).at(Vec3d(0.2, 0.3, 5.0)).triangle, 0u);
}

} // namespace
} // namespace molsurf
