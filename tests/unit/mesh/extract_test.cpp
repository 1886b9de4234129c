// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/extract.h"

#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/surface_vertices.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/spline/curvature.h"
#include "support/convergence.h"
#include "support/digital_euler.h"
#include "support/surfaces.h"

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

// The spline is of fourth order, so its zero set is; the mesher alone would be of second.
TEST(ExtractMesh, PutsVerticesOnTheSurfaceAtFourthOrder)
{
    const test::Shape ring = test::torus(3.4, 1.5);
    const std::vector<double> h = {0.5, 0.25, 0.125};
    std::vector<double> error;
    for (const double voxel : h) {
        ExtractStats stats;
        const Mesh mesh = test::meshOf(ring.distance, ring.centre, ring.extent, voxel, stats);
        EXPECT_LT(stats.maxResidual, 1e-5 * voxel + 1e-7);
        double worst = 0.0;
        for (const Vec3f& p : mesh.positions)
            worst = std::max(worst, std::abs(ring.distance(Vec3d(p))));
        error.push_back(worst);
    }
    EXPECT_GT(test::observedOrder(h, error), 3.3) << test::table(h, error);
    EXPECT_LT(error.back(), 1e-5) << test::table(h, error);
}

// Leaf by leaf in float, points come to where the walk of one point in double leads, with what the
// spline has there.
TEST(MoveToSurface, OfManyPointsGoesTheWayOfOne)
{
    const test::Shape ring = test::torus(3.4, 1.5);
    const double voxel = 0.5;
    const Spline spline =
        test::splineOf(ring.distance, ring.distance, ring.centre, ring.extent, voxel, 6.0 * voxel);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(-ring.extent, ring.extent);
    std::vector<openvdb::Vec3s> starts;
    while (starts.size() < 2000) {
        const Vec3d x = ring.centre + Vec3d{anywhere(random), anywhere(random), anywhere(random)};
        if (std::abs(ring.distance(x)) < 0.9 * voxel) starts.emplace_back(x);
    }
    Mesh mesh;
    mesh.positions = starts;
    mesh.normals.resize(starts.size());
    for (const char* name : {"mean", "gauss"})
        mesh.scalars.push_back({name, std::vector<float>(starts.size())});
    std::vector<float> slopes(starts.size()), residuals(starts.size());
    SurfaceVertices vertices{mesh, slopes};
    moveToSurface(spline, voxel, 0, starts.size(), vertices, residuals.data());
    SplineSampler sampler(spline);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        Vec3d x(starts[i]);
        Jet jet;
        ASSERT_TRUE(moveToSurface(sampler, voxel, 1.0, x, jet));
        EXPECT_LT((Vec3d(mesh.positions[i]) - x).length(), 2e-5 * voxel);
        EXPECT_LT((Vec3d(mesh.normals[i]) - jet.gradient.unit()).length(), 1e-4);
        EXPECT_NEAR(slopes[i], jet.gradient.length(), 1e-4);
        EXPECT_NEAR(mesh.scalars[0].values[i], meanCurvature(jet), 1e-3);
        EXPECT_NEAR(mesh.scalars[1].values[i], gaussianCurvature(jet), 1e-3);
        EXPECT_LE(residuals[i], 1.001e-5 * voxel);
        EXPECT_LT(std::abs(sampler.at(Vec3d(mesh.positions[i])).value), 1.2e-5 * voxel);
    }
}

// The level set may have another sign than its spline where both are zero but for rounding.
TEST(MoveToSurface, FindsAZeroThatHasNoSign)
{
    const double voxel = 0.5;
    const auto field = [](const Vec3d& x) { return 0.2 * x.lengthSqr() + 1e-7; };
    const Spline spline = test::splineOf(field, field, Vec3d(0.0), 3.0, voxel, 6.0 * voxel);
    Mesh mesh;
    mesh.positions = {{0.2f, 0.25f, 0.3f}}; // the gradient leads toward a minimum
    mesh.normals.resize(1);
    for (const char* name : {"mean", "gauss"}) mesh.scalars.push_back({name, {0.0f}});
    std::vector<float> slopes(1);
    float residual = 1.0f;
    SurfaceVertices vertices{mesh, slopes};
    moveToSurface(spline, voxel, 0, 1, vertices, &residual);
    EXPECT_LT(residual, 1e-6f);
    EXPECT_LT(mesh.positions[0].length(), 1e-6f);
}

TEST(ExtractMesh, OrientsOutwardWithNormalsAndCurvatures)
{
    const test::Shape ball = test::sphere(2.7);
    const Mesh mesh = test::meshOf(ball, 0.25);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.scalars.size(), 2u);
    EXPECT_EQ(mesh.scalars[0].name, "mean_curvature");
    EXPECT_EQ(mesh.scalars[1].name, "gaussian_curvature");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3d out = (Vec3d(mesh.positions[v]) - ball.centre).unit();
        EXPECT_GT(out.dot(Vec3d(mesh.normals[v])), 0.9999);
        EXPECT_NEAR(mesh.scalars[0].values[v], 1.0 / 2.7, 0.01);
        EXPECT_NEAR(mesh.scalars[1].values[v], 1.0 / (2.7 * 2.7), 0.01);
    }
    for (const auto& t : mesh.triangles) {
        const Vec3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        EXPECT_GT((b - a).cross(c - a).dot(mesh.normals[t[0]]), 0.0f);
    }
}

TEST(ExtractMesh, OfALevelSetWithoutAZeroIsEmpty)
{
    const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(0.5, 3.0);
    Spline spline;
    spline.coefficients.voxelSize = 0.5;
    ExtractStats stats;
    const Mesh mesh = extractMesh(*grid, spline, Progress(), stats);
    EXPECT_TRUE(mesh.positions.empty());
    EXPECT_TRUE(mesh.triangles.empty());
}

/// Signs at random in a cube, outside about it: every ambiguous configuration of a cell occurs. The
/// values are not those of a smooth function, and the mesh is what the tables say.
struct Noise {
    openvdb::FloatGrid::Ptr grid;
    Spline spline;
};

Noise noise(unsigned seed, int share)
{
    const double voxel = 1.0;
    std::mt19937 random(seed);
    std::vector<Coord> origins;
    for (int k = 0; k < 27; ++k)
        origins.emplace_back(8 * (k / 9) - 8, 8 * (k / 3 % 3) - 8, 8 * (k % 3) - 8);
    const LeafTable table(origins);
    SparseField field{table, LeafField(table.size()), voxel};
    for (std::size_t n = 0; n < field.table.size(); ++n) {
        field.table.active(n) = ~LeafMask();
        for (int v = 0; v < leafSize; ++v) {
            const Coord c = field.table.origin(n).offsetBy(v >> 6, v >> 3 & 7, v & 7);
            bool rim = false;
            for (int i = 0; i < 3; ++i) rim |= c[i] < -5 || c[i] > 12;
            field.leaf(n)[v] = !rim && int(random() % 100) < share ? -0.5f : 0.5f;
        }
    }
    return {toLevelSet(field, 3.0, Progress()), {prefilter(field, Progress())}};
}

// Where a cell is ambiguous, OpenVDB's tables decide: test::mesherEuler() states their rule. On
// noise all its cases occur, and no plain connectivity of the voxels gives the mesh's Euler number.
TEST(ExtractMesh, OfNoiseIsAManifoldWithTheTopologyOfTheSigns)
{
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Noise n = noise(seed, 10 + 7 * int(seed));
        ExtractStats stats;
        const Mesh mesh = extractMesh(*n.grid, n.spline, Progress(), stats);
        const Topology t = checkTopology(mesh, Progress());
        EXPECT_TRUE(t.closed && t.oriented && t.manifold) << "seed " << seed;
        EXPECT_GT(test::digitalEuler(*n.grid).ambiguousCells, 100u);
        EXPECT_EQ(measure(mesh, Progress()).eulerCharacteristic, test::mesherEuler(*n.grid))
            << "seed " << seed;
    }
}

// Nearly all vertices of noise are moved: where two threads moved neighbours at once, bits would
// depend on which was the first.
TEST(ExtractMesh, OfNoiseIsTheSameForAnyNumberOfThreads)
{
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Noise n = noise(seed, 10 + 7 * int(seed));
        std::vector<Mesh> meshes;
        for (const int threads : {1, 2, 4}) {
            tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                        std::size_t(threads));
            ExtractStats stats;
            meshes.push_back(extractMesh(*n.grid, n.spline, Progress(), stats));
        }
        for (const Mesh& mesh : meshes) {
            EXPECT_EQ(mesh.positions, meshes[0].positions) << "seed " << seed;
            EXPECT_EQ(mesh.triangles, meshes[0].triangles) << "seed " << seed;
        }
    }
}

TEST(DigitalEuler, OfSimpleBodies)
{
    const auto gridOf = [](const std::vector<Coord>& inside) {
        auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(1.0, 3.0);
        auto write = grid->getAccessor();
        for (int k = 0; k < 512; ++k) write.setValue(Coord(k >> 6, k >> 3 & 7, k & 7), 0.5f);
        for (const Coord& c : inside) write.setValue(c, -0.5f);
        return grid;
    };
    const auto expect = [&](const std::vector<Coord>& inside, int six, int eighteen, int all,
                            int mesher) {
        const test::DigitalEuler e = test::digitalEuler(*gridOf(inside));
        EXPECT_EQ(e.six, six);
        EXPECT_EQ(e.eighteen, eighteen);
        EXPECT_EQ(e.twentySix, all);
        EXPECT_EQ(test::mesherEuler(*gridOf(inside)), mesher);
    };
    expect({Coord(3)}, 1, 1, 1, 2);
    expect({Coord(2), Coord(2, 2, 3)}, 1, 1, 1, 2); // share a face
    expect({Coord(2), Coord(2, 3, 3)}, 2, 1, 1, 4); // an edge: the mesher parts them
    expect({Coord(2), Coord(3)}, 2, 2, 1, 4);       // a corner
    std::vector<Coord> shell, ring;
    for (int k = 0; k < 27; ++k) {
        const Coord c(2 + k / 9, 2 + k / 3 % 3, 2 + k % 3);
        if (k != 13) shell.push_back(c);
        if (k % 3 == 1 && k != 13) ring.push_back(c);
    }
    expect(shell, 2, 2, 2, 4);
    expect(ring, 0, 0, 0, 0);
}

} // namespace
} // namespace molsurf
