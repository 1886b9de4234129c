// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/topology.h"

#include "molsurf/kernel/mesh/vertex_slices.h"

#include <gtest/gtest.h>

#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

/// Appends an outward oriented tetrahedron on four vertices of the mesh.
void addTetrahedron(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    const auto& p = mesh.positions;
    if ((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) > 0.0f) std::swap(b, c);
    for (const auto& t : {std::array<std::uint32_t, 3>{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}})
        mesh.triangles.push_back(t);
}

Mesh points(std::initializer_list<Vec3f> list)
{
    Mesh mesh;
    mesh.positions = list;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.normals.push_back(Vec3f(0.0f, 0.0f, 1.0f));
    }
    mesh.scalars.push_back({"a", std::vector<float>(mesh.positions.size(), 1.5f)});
    mesh.labels.push_back({"b", std::vector<std::int32_t>(mesh.positions.size(), 7)});
    return mesh;
}

Mesh tetrahedron()
{
    Mesh mesh = points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    addTetrahedron(mesh, 0, 1, 2, 3);
    return mesh;
}

Mesh sharedVertex()
{
    Mesh mesh =
        points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    addTetrahedron(mesh, 0, 1, 2, 3);
    addTetrahedron(mesh, 0, 4, 5, 6);
    return mesh;
}

Mesh sharedEdge()
{
    Mesh mesh =
        points({{0, 0, 0}, {0, 0, 1}, {1, 0, 0.3f}, {1, 1, 0.6f}, {-1, 0, 0.4f}, {-1, -1, 0.7f}});
    addTetrahedron(mesh, 0, 1, 2, 3);
    addTetrahedron(mesh, 0, 1, 4, 5);
    return mesh;
}

Topology check(const Mesh& mesh)
{
    return checkTopology(mesh, Progress());
}

double volume(const Mesh& mesh)
{
    double six = 0.0;
    for (const auto& t : mesh.triangles)
        six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
    return six / 6.0;
}

TEST(CheckTopology, ATetrahedronIsAManifold)
{
    const Topology t = check(tetrahedron());
    EXPECT_TRUE(t.closed);
    EXPECT_TRUE(t.oriented);
    EXPECT_TRUE(t.manifold);
    EXPECT_NEAR(volume(tetrahedron()), 1.0 / 6.0, 1e-6);
}

TEST(CheckTopology, AHoleIsNotClosed)
{
    Mesh mesh = tetrahedron();
    mesh.triangles.pop_back();
    const Topology t = check(mesh);
    EXPECT_FALSE(t.closed);
    EXPECT_FALSE(t.manifold);
}

TEST(CheckTopology, AFlippedTriangleIsNotOriented)
{
    Mesh mesh = tetrahedron();
    std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
    const Topology t = check(mesh);
    EXPECT_TRUE(t.closed);
    EXPECT_FALSE(t.oriented);
    EXPECT_FALSE(t.manifold);
}

TEST(CheckTopology, APinchedVertexIsClosedButNotManifold)
{
    const Topology t = check(sharedVertex());
    EXPECT_TRUE(t.closed);
    EXPECT_TRUE(t.oriented);
    EXPECT_FALSE(t.manifold);
}

TEST(CheckTopology, AnEdgeOfFourTrianglesIsNotManifold)
{
    const Topology t = check(sharedEdge());
    EXPECT_FALSE(t.closed); // not two triangles at that edge
    EXPECT_FALSE(t.manifold);
}

TEST(SplitNonManifold, LeavesAManifoldAlone)
{
    Mesh mesh = tetrahedron();
    const auto before = mesh.triangles;
    EXPECT_EQ(splitNonManifold(mesh).size(), 0u);
    EXPECT_EQ(mesh.triangles, before);
}

void expectSplit(Mesh mesh, std::size_t added, std::size_t pieces)
{
    const double before = volume(mesh);
    std::vector<std::array<Vec3f, 3>> corners;
    for (const auto& t : mesh.triangles)
        corners.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    EXPECT_EQ(splitNonManifold(mesh).size(), added);
    const Topology t = check(mesh);
    EXPECT_TRUE(t.closed);
    EXPECT_TRUE(t.oriented);
    EXPECT_TRUE(t.manifold);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.positions[mesh.triangles[i][k]], corners[i][k]);
    }
    EXPECT_EQ(volume(mesh), before);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.scalars[0].values, std::vector<float>(mesh.positions.size(), 1.5f));
    EXPECT_EQ(mesh.labels[0].values, std::vector<std::int32_t>(mesh.positions.size(), 7));
    std::size_t count = 0;
    connectedPieces(mesh, count, Progress());
    EXPECT_EQ(count, pieces);
    EXPECT_EQ(splitNonManifold(mesh).size(), 0u);
}

TEST(SplitNonManifold, PartsTwoTetrahedraThatShareAVertex)
{
    expectSplit(sharedVertex(), 1, 2);
}

// Which of the four triangles are paired at the edge decides whether two bodies or one come out;
// either way each point of the edge belongs to a manifold.
TEST(SplitNonManifold, MakesAManifoldOfTwoTetrahedraThatShareAnEdge)
{
    Mesh mesh = sharedEdge();
    const double before = volume(mesh);
    EXPECT_GE(splitNonManifold(mesh).size(), 0u);
    const Topology t = check(mesh);
    EXPECT_TRUE(t.closed && t.oriented && t.manifold);
    EXPECT_EQ(volume(mesh), before);
}

TEST(ConnectedPieces, NumbersThemInTheOrderOfTheirVertices)
{
    Mesh mesh = points(
        {{0, 0, 0}, {5, 0, 0}, {1, 0, 0}, {6, 0, 0}, {0, 1, 0}, {5, 1, 0}, {0, 0, 1}, {5, 0, 1}});
    addTetrahedron(mesh, 1, 3, 5, 7);
    addTetrahedron(mesh, 0, 2, 4, 6);
    std::size_t count = 0;
    EXPECT_EQ(connectedPieces(mesh, count, Progress()),
              (std::vector<std::uint32_t>{0, 1, 0, 1, 0, 1, 0, 1}));
    EXPECT_EQ(count, 2u);
}

TEST(VertexTriangles, ListsThemAllInOrder)
{
    const Mesh mesh = sharedVertex();
    const VertexTriangles around = vertexTriangles(mesh);
    ASSERT_EQ(around.begins.size(), mesh.positions.size() + 1);
    EXPECT_EQ(around.begins.back(), 3 * mesh.triangles.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto& t = mesh.triangles[i];
            if (t[0] == v || t[1] == v || t[2] == v) expected.push_back(i);
        }
        EXPECT_EQ(std::vector<std::uint32_t>(around.triangles.begin() + around.begins[v],
                                             around.triangles.begin() + around.begins[v + 1]),
                  expected);
    }
}

TEST(VertexTriangles, ListsThoseOfSomeVertices)
{
    const Mesh mesh = sharedEdge();
    const VertexTriangles all = vertexTriangles(mesh);
    VertexSet set(mesh.positions.size());
    for (const std::uint32_t v : {5, 1, 2}) set.add(v);
    set.count();
    const std::vector<std::uint32_t> some = set.list();
    EXPECT_EQ(some, (std::vector<std::uint32_t>{1, 2, 5}));
    EXPECT_EQ(set.place(5), 2u);
    const VertexTriangles part = vertexTriangles(mesh, set, Progress());
    ASSERT_EQ(part.begins.size(), some.size() + 1);
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto of = [](const VertexTriangles& t, std::size_t v) {
            return std::vector<std::uint32_t>(t.triangles.begin() + t.begins[v],
                                              t.triangles.begin() + t.begins[v + 1]);
        };
        EXPECT_EQ(of(part, i), of(all, some[i]));
    }
}

/// Many tetrahedra, whose vertices and triangles lie far apart in their lists.
Mesh manyTetrahedra(std::uint32_t count)
{
    Mesh mesh;
    mesh.positions.resize(4 * count);
    for (std::uint32_t i = 0; i < count; ++i)
        addTetrahedron(mesh, i, count + i, 2 * count + i, 3 * count + i);
    return mesh;
}

TEST(CheckTopology, FindsOneFaultAmongMany)
{
    constexpr std::uint32_t count = 50000;
    const Mesh whole = manyTetrahedra(count);
    Topology t = check(whole);
    EXPECT_TRUE(t.closed && t.oriented && t.manifold);

    Mesh torn = whole;
    torn.triangles.erase(torn.triangles.begin() + 4 * 40000 + 1);
    EXPECT_FALSE(check(torn).closed);
    const auto at = [&](std::initializer_list<std::uint32_t> some) {
        std::vector<char> wanted(torn.positions.size());
        for (const std::uint32_t v : some) wanted[v] = 1;
        return checkTopology(torn, wanted, Progress());
    };
    EXPECT_TRUE(at({1, 39999, 40001, count + 7}).closed);
    EXPECT_FALSE(at({1, 40000, count + 40000}).closed);
    t = at({39999});
    EXPECT_TRUE(t.closed && t.oriented && t.manifold);
}

/// Two cones with a common rim of n vertices; their tips are the first two vertices.
Mesh doubleCone(std::uint32_t n)
{
    Mesh mesh;
    mesh.positions.resize(n + 2);
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t a = 2 + k, b = 2 + (k + 1) % n;
        mesh.triangles.push_back({0, a, b});
        mesh.triangles.push_back({1, b, a});
    }
    return mesh;
}

// Small fans are seen at a glance, large ones are not.
TEST(CheckTopology, OfFansOfAllSizes)
{
    for (std::uint32_t n = 3; n <= 80; ++n) {
        const Mesh mesh = doubleCone(n);
        const Topology t = check(mesh);
        EXPECT_TRUE(t.closed && t.oriented && t.manifold) << n;
        Mesh open = mesh;
        open.triangles.pop_back();
        std::vector<char> tip(mesh.positions.size(), 0);
        tip[1] = 1;
        EXPECT_FALSE(checkTopology(open, tip, Progress()).closed) << n;
        for (std::uint32_t i = 0; i < 2 * n; i += 5) {
            Mesh torn = mesh;
            torn.triangles.erase(torn.triangles.begin() + i);
            EXPECT_FALSE(check(torn).closed) << n;
            Mesh turned = mesh;
            std::swap(turned.triangles[i][1], turned.triangles[i][2]);
            const Topology u = check(turned);
            EXPECT_TRUE(u.closed && !u.oriented) << n;
        }
    }
    // Two turns about a tip, of m and n - m triangles.
    for (std::uint32_t m = 3; m <= 6; ++m) {
        Mesh pinched = doubleCone(m);
        const Mesh other = doubleCone(9 - m);
        for (const auto& t : other.triangles) {
            std::array<std::uint32_t, 3> moved;
            for (int k = 0; k < 3; ++k) moved[k] = t[k] == 0 ? 0 : t[k] + m + 1;
            pinched.triangles.push_back(moved);
        }
        pinched.positions.resize(12);
        const Topology t = check(pinched);
        EXPECT_TRUE(t.closed && t.oriented && !t.manifold) << m;
    }
}

// The way about vertex 0 enters a turn of two triangles, and does not come back to the first.
TEST(CheckTopology, OfAWayThatDoesNotComeBack)
{
    Mesh mesh;
    mesh.positions.resize(4);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 2}};
    std::vector<char> wanted = {1, 0, 0, 0};
    const Topology t = checkTopology(mesh, wanted, Progress());
    EXPECT_FALSE(t.closed || t.manifold);
}

TEST(VertexSlices, GiveEachSliceAllTrianglesAtItsVertices)
{
    const Mesh mesh = manyTetrahedra(20000);
    const VertexSlices slices(mesh, Progress());
    EXPECT_GT(slices.size(), 4u);
    std::size_t met = 0;
    for (std::size_t s = 0; s < slices.size(); ++s) {
        std::size_t last = 0;
        slices.forEachTriangle(s, [&](std::size_t i) {
            EXPECT_TRUE(i == 0 || i > last);
            last = i;
            for (const std::uint32_t v : mesh.triangles[i])
                met += v >= slices.first(s) && v < slices.first(s + 1);
        });
    }
    EXPECT_EQ(met, 3 * mesh.triangles.size());
    EXPECT_EQ(slices.first(slices.size()), mesh.positions.size());
}

TEST(ConnectedPieces, CountsMany)
{
    constexpr std::uint32_t count = 50000;
    Mesh mesh = manyTetrahedra(count);
    addTetrahedron(mesh, 7, 3 * count + 9, 11, 2 * count + 13); // joins four
    std::size_t pieces = 0;
    const std::vector<std::uint32_t> piece = connectedPieces(mesh, pieces, Progress());
    EXPECT_EQ(pieces, count - 3);
    EXPECT_EQ(piece[count + 8], 8u);
    EXPECT_EQ(piece[3 * count + 9], 7u);
    EXPECT_EQ(piece[2 * count + 14], 11u); // 9, 11 and 13 are no pieces of their own
}

} // namespace
} // namespace molsurf
