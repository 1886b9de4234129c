// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/check_arrays.h"

#include "molsurf/error.h"
#include "support/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

Mesh whole()
{
    Mesh mesh = test::box({0, 0, 0}, {1, 2, 3});
    const std::size_t n = mesh.positions.size();
    mesh.normals.assign(n, openvdb::Vec3f(0, 0, 1));
    mesh.scalars = {{"mean_curvature", std::vector<float>(n)}};
    mesh.labels = {{"atom_id", std::vector<std::int32_t>(n, -1)}};
    mesh.colors.resize(n);
    mesh.parts = {{"all", 0}};
    return mesh;
}

std::string errorOf(const std::function<void(Mesh&)>& change)
{
    Mesh mesh = whole();
    change(mesh);
    try {
        checkArrays(mesh);
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        return e.what();
    }
    return "";
}

TEST(CheckArrays, WholeMeshesPass)
{
    EXPECT_EQ(errorOf([](Mesh&) {}), "");
    EXPECT_EQ(errorOf([](Mesh& m) { m.positions[2][1] = -999999.0f; }), "");
    EXPECT_EQ(errorOf([](Mesh& m) { m.normals.clear(), m.colors.clear(); }), "");
    EXPECT_EQ(errorOf([](Mesh& m) { m = Mesh(); }), "");
}

TEST(CheckArrays, PlacesAreFiniteAndNotTooFar)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    for (const float value : {1e30f, 1e6f, -1e6f, infinite, std::nanf("")})
        for (int a = 0; a < 3; ++a)
            EXPECT_EQ(errorOf([&](Mesh& m) {
                          m.positions[2][a] = value;
                      }).find("vertex 2: expected a finite position below 1e6 Å, got "),
                      0u)
                << value;
    EXPECT_EQ(errorOf([&](Mesh& m) { m.normals[1][2] = infinite; }),
              "normal 1: expected a finite vector");
}

TEST(CheckArrays, CornersAreVertices)
{
    const std::string end = "vertices below " + std::to_string(whole().positions.size()) + ", got ";
    EXPECT_EQ(errorOf([](Mesh& m) { m.triangles[1][2] = 100000000; }),
              "face 1: expected " + end + "100000000");
    EXPECT_EQ(errorOf([](Mesh& m) { m.triangles[0][0] = std::uint32_t(-1); }),
              "face 0: expected " + end + "-1");
    EXPECT_NE(errorOf([](Mesh& m) { m.triangles[3][1] = std::uint32_t(m.positions.size()); }), "");
    EXPECT_NE(errorOf([](Mesh& m) {
                  m.parts[0].firstTriangle = m.triangles.size() + 1;
              }).find("part 0: expected a first triangle up to "),
              std::string::npos);
}

TEST(CheckArrays, AttributesHaveOneValueAVertex)
{
    EXPECT_NE(errorOf([](Mesh& m) { m.normals.pop_back(); }).find("'normal'"), std::string::npos);
    EXPECT_NE(errorOf([](Mesh& m) { m.scalars[0].values.clear(); }).find("'mean_curvature'"),
              std::string::npos);
    EXPECT_NE(errorOf([](Mesh& m) { m.labels[0].values.push_back(1); }).find("'atom_id'"),
              std::string::npos);
    EXPECT_NE(errorOf([](Mesh& m) { m.colors.pop_back(); }).find("'color'"), std::string::npos);
}

std::string manifoldErrorOf(const std::function<void(Mesh&)>& change)
{
    Mesh mesh = whole();
    change(mesh);
    try {
        checkManifold(mesh, Progress());
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        return e.what();
    }
    return "";
}

TEST(CheckManifold, ClosedOrientedManifoldsPass)
{
    EXPECT_EQ(manifoldErrorOf([](Mesh&) {}), "");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { m = Mesh(); }), "");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { m.positions.emplace_back(9, 9, 9); }), "");
}

// A triangle whose edges fold onto each other is a turn about each of its vertices.
TEST(CheckManifold, TrianglesHaveThreeVertices)
{
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) {
                  m.triangles[2] = {0, 0, 0};
              }),
              "face 2: expected three vertices, each another one");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) {
                  m.triangles.push_back({8, 9, 8});
                  m.positions.resize(10);
              }),
              "face 12: expected three vertices, each another one");
}

TEST(CheckManifold, SaysWhatElseTheTrianglesAre)
{
    const std::string expected = "faces: expected a closed, oriented manifold, got ";
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { m.triangles.pop_back(); }),
              expected + "edges that do not have two triangles");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { m.triangles.push_back(m.triangles[0]); }),
              expected + "edges that do not have two triangles");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { std::swap(m.triangles[3][0], m.triangles[3][1]); }),
              expected + "neighbours that run round in opposite ways");
    EXPECT_EQ(manifoldErrorOf([](Mesh& m) { // two boxes that share a corner
                  const Mesh other = test::box({5, 5, 5}, {6, 6, 6});
                  for (auto t : other.triangles) {
                      for (std::uint32_t& v : t) v = v == 0 ? 7 : v + 7;
                      m.triangles.push_back(t);
                  }
                  m.positions.resize(15);
              }),
              expected + "vertices where sheets meet");
}

} // namespace
} // namespace molsurf
