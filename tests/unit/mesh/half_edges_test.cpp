// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/half_edges.h"

#include "molsurf/kernel/mesh/topology.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <random>

namespace molsurf
{
namespace
{

using Id = HalfEdges::Id;

/// Expects a closed manifold of some Euler number whose half-edges know each other.
void expectManifold(const HalfEdges& edges, int euler)
{
    Mesh mesh;
    mesh.positions.resize(edges.vertices());
    int vertices = 0;
    for (std::uint32_t v = 0; v < edges.vertices(); ++v) vertices += edges.valence(v) > 0;
    for (std::size_t t = 0; t < edges.triangles().size(); ++t) {
        if (edges.isGone(t)) continue;
        mesh.triangles.push_back(edges.triangles()[t]);
        for (Id h = Id(3 * t); h < Id(3 * t + 3); ++h) {
            ASSERT_EQ(edges.twin(edges.twin(h)), h);
            ASSERT_EQ(edges.from(edges.twin(h)), edges.to(h));
            ASSERT_EQ(edges.to(edges.twin(h)), edges.from(h));
            int around = 0;
            edges.around(edges.from(h), [&](Id g) {
                ASSERT_EQ(edges.from(g), edges.from(h));
                ++around;
            });
            ASSERT_EQ(around, edges.valence(edges.from(h)));
        }
    }
    const Topology topology = checkTopology(mesh, Progress());
    EXPECT_TRUE(topology.closed && topology.oriented && topology.manifold);
    EXPECT_EQ(vertices - int(mesh.triangles.size()) / 2, euler);
}

// The octahedron: 0 and 1, 2 and 3, 4 and 5 lie opposite to each other.
HalfEdges octahedron()
{
    return HalfEdges({{{0, 2, 4}},
                      {{2, 1, 4}},
                      {{1, 3, 4}},
                      {{3, 0, 4}},
                      {{2, 0, 5}},
                      {{1, 2, 5}},
                      {{3, 1, 5}},
                      {{0, 3, 5}}},
                     6);
}

TEST(HalfEdges, StayAManifoldThroughAnyChanges)
{
    const Mesh mesh = test::meshOf(test::torus(3.4, 1.5), 0.8);
    HalfEdges edges(mesh.triangles, mesh.positions.size());
    expectManifold(edges, 0);
    std::mt19937 random(5);
    for (int change = 0; change < 6000; ++change) {
        const Id h = Id(random() % (3 * edges.triangles().size()));
        if (edges.isGone(h / 3)) continue;
        switch (random() % 5) {
        case 0:
            edges.split(h, std::uint32_t(edges.vertices()));
            break;
        case 1:
        case 2:
            if (edges.canFlip(h)) edges.flip(h);
            break;
        default:
            if (edges.canCollapse(h)) edges.collapse(h);
        }
        if (change % 500 == 0) expectManifold(edges, 0);
    }
    // All that may go: the ring becomes as coarse as a ring can be, and stays one.
    for (bool any = true; any;) {
        any = false;
        for (Id h = 0; h < Id(3 * edges.triangles().size()); ++h) {
            if (edges.isGone(h / 3) || !edges.canCollapse(h)) continue;
            edges.collapse(h);
            any = true;
        }
    }
    expectManifold(edges, 0);
}

TEST(HalfEdges, SplitGivesAnEdgeTwoHalves)
{
    HalfEdges edges = octahedron();
    edges.split(edges.between(0, 2), 6);
    expectManifold(edges, 2);
    EXPECT_EQ(edges.between(0, 2), HalfEdges::none);
    EXPECT_EQ(edges.valence(6), 4);
    for (const std::uint32_t v : {0u, 2u, 4u, 5u})
        EXPECT_NE(edges.between(6, v), HalfEdges::none) << v;
}

TEST(HalfEdges, FlipMakesNoSecondEdgeBetweenTwoVertices)
{
    HalfEdges edges = octahedron();
    const Id h = edges.between(0, 2); // its diagonal is 4-5
    ASSERT_TRUE(edges.canFlip(h));
    edges.flip(h);
    expectManifold(edges, 2);
    EXPECT_NE(edges.between(4, 5), HalfEdges::none);
    // The diagonal of 1-3 is 4-5 as well, and there.
    EXPECT_FALSE(edges.canFlip(edges.between(1, 3)));
}

TEST(HalfEdges, CollapseKeepsRingsOfThreeEdges)
{
    HalfEdges edges = octahedron();
    // Seven edges from now on: 0, 4, 5 is a ring of three without a triangle.
    edges.flip(edges.between(0, 2));
    EXPECT_FALSE(edges.canCollapse(edges.between(0, 4)) && edges.between(4, 5) != HalfEdges::none &&
                 edges.valence(0) > 3);
    HalfEdges tetrahedron({{{0, 1, 2}}, {{0, 3, 1}}, {{1, 3, 2}}, {{2, 3, 0}}}, 4);
    expectManifold(tetrahedron, 2);
    for (Id h = 0; h < 12; ++h) {
        EXPECT_FALSE(tetrahedron.canCollapse(h));
        EXPECT_FALSE(tetrahedron.canFlip(h));
    }
}

} // namespace
} // namespace molsurf
