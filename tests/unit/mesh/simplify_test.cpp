// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/simplify.h"
#include "molsurf/kernel/mesh/topology.h"
#include "support/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

/// A torus about the z axis: n times 2 n vertices.
Mesh torus(int n, double large, double small)
{
    Mesh mesh;
    const int m = 2 * n;
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < n; ++j) {
            const double a = 2.0 * M_PI * i / m, b = 2.0 * M_PI * (j + 0.3 * i) / n;
            const Vec3d out(std::cos(a), std::sin(a), 0.0);
            const Vec3d normal = std::cos(b) * out + Vec3d(0.0, 0.0, std::sin(b));
            mesh.positions.push_back(Vec3f(large * out + small * normal));
            mesh.normals.push_back(Vec3f(normal));
        }
    }
    const auto at = [&](int i, int j) {
        // After one turn the rows are shifted by 0.3 m vertices.
        const int shift = i == m ? int(std::lround(0.3 * m)) : 0;
        return std::uint32_t(i % m * n + (j + shift) % n);
    };
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < n; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

Mesh meshOf(const Mesh& mesh, const ThinnedMesh& thin)
{
    Mesh out;
    for (const std::uint32_t v : thin.vertices) {
        out.positions.push_back(mesh.positions[v]);
        out.normals.push_back(mesh.normals[v]);
    }
    out.triangles = thin.triangles;
    return out;
}

int eulerOf(const Mesh& mesh)
{
    return int(mesh.positions.size()) - int(mesh.triangles.size()) / 2;
}

TEST(Thinned, KeepsTheTopologyAndTheNumber)
{
    const Mesh full = torus(40, 5.0, 2.0);
    ASSERT_TRUE(checkTopology(full, Progress()).manifold);
    for (const std::size_t wanted : {2000u, 800u, 200u, 60u}) {
        const ThinnedMesh thin = thinned(full, wanted, Progress());
        EXPECT_EQ(thin.vertices.size(), wanted);
        EXPECT_TRUE(std::is_sorted(thin.vertices.begin(), thin.vertices.end()));
        const Mesh mesh = meshOf(full, thin);
        const Topology topology = checkTopology(mesh, Progress());
        EXPECT_TRUE(topology.closed && topology.oriented && topology.manifold) << wanted;
        EXPECT_EQ(eulerOf(mesh), 0) << wanted;
        for (const auto& t : mesh.triangles) {
            const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
            for (const std::uint32_t v : t)
                EXPECT_GT((b - a).cross(c - a).dot(Vec3d(mesh.normals[v])), 0.0) << wanted;
        }
    }
}

TEST(Thinned, SpreadsVerticesEvenly)
{
    const Mesh full = torus(40, 5.0, 2.0);
    const Mesh mesh = meshOf(full, thinned(full, 800, Progress()));
    const double area = 4.0 * M_PI * M_PI * 5.0 * 2.0;
    const double even = std::sqrt(area / 800.0 * 2.0 / std::sqrt(3.0)); // of equal triangles
    double shortest = 1e9, longest = 0.0;
    for (const auto& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const double length =
                (Vec3d(mesh.positions[t[k]]) - Vec3d(mesh.positions[t[(k + 1) % 3]])).length();
            shortest = std::min(shortest, length);
            longest = std::max(longest, length);
        }
    }
    EXPECT_GT(shortest, 0.5 * even);
    EXPECT_LT(longest, 2.3 * even);
}

TEST(Thinned, LeavesATetrahedronOfEveryPiece)
{
    Mesh mesh;
    for (const float x : {0.0f, 10.0f}) {
        const Mesh box = test::box({x, 0, 0}, {x + 1, 1, 1});
        const auto first = std::uint32_t(mesh.positions.size());
        for (const Vec3f& p : box.positions) {
            mesh.positions.push_back(p);
            Vec3f normal = p - Vec3f(x + 0.5f, 0.5f, 0.5f);
            normal.normalize();
            mesh.normals.push_back(normal);
        }
        for (const auto& t : box.triangles)
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    const Mesh thin = meshOf(mesh, thinned(mesh, 0, Progress()));
    EXPECT_GE(thin.positions.size(), 8u);
    EXPECT_LT(thin.positions.size(), 16u);
    EXPECT_EQ(eulerOf(thin), 4);
    EXPECT_TRUE(checkTopology(thin, Progress()).manifold);
}

TEST(Thinned, LeavesWhatIsFewEnough)
{
    const Mesh full = torus(10, 5.0, 2.0);
    const ThinnedMesh thin = thinned(full, full.positions.size(), Progress());
    EXPECT_EQ(thin.vertices.size(), full.positions.size());
    EXPECT_EQ(thin.triangles, full.triangles);
}

} // namespace
} // namespace molsurf
