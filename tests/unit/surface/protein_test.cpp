// SPDX-License-Identifier: MPL-2.0
#include "support/runs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

void printLine(const char* what, const MolecularSurface& r)
{
    if (!getenv("VERBOSE")) return;
    printf("%s: area %.1f volume %.1f steps %d converged %d rise %.2e residual %.2e euler %d\n",
           what, r.report.surface.area, r.report.surface.volume, r.report.evolution->steps,
           r.report.evolution->converged, test::largestRise(*r.report.evolution),
           r.report.surface.maxResidual, *r.report.surface.eulerCharacteristic);
}

TEST(Pipeline, DimerOf1A8O)
{
    const std::vector<Ball> balls = test::balls("1a8o.cif.gz", "1");
    ASSERT_EQ(balls.size(), 1112u);
    const MolecularSurface result = test::runOn(balls);
    printLine("1a8o", result);
    const EvolutionReport& flow = *result.report.evolution;
    EXPECT_TRUE(flow.converged);
    EXPECT_LE(flow.steps, 15);
    EXPECT_LT(test::largestRise(flow), 1e-3);
    const SurfaceReport& surface = result.report.surface;
    EXPECT_NEAR(surface.area, 6151.0, 0.001 * 6151.0);
    EXPECT_NEAR(surface.volume, 19351.0, 0.001 * 19351.0);
    EXPECT_TRUE(surface.closed);
    EXPECT_TRUE(surface.manifold);
    EXPECT_EQ(surface.degenerateTriangles, 0u);
    EXPECT_LT(surface.maxResidual, 1e-3);
}

TEST(PipelineSlow, DimerOf1A8OAgreesWithHalfTheVoxel)
{
    const std::vector<Ball> balls = test::balls("1a8o.cif.gz", "1");
    const MolecularSurface coarse = test::runOn(balls);
    SurfaceOptions options;
    options.voxel = 0.25;
    const MolecularSurface fine = test::runOn(balls, options);
    printLine("1a8o h 0.25", fine);
    EXPECT_TRUE(fine.report.evolution->converged);
    EXPECT_LT(test::largestRise(*fine.report.evolution), 1e-3);
    EXPECT_NEAR(fine.report.evolution->finalEnergy / coarse.report.evolution->finalEnergy, 1.0,
                0.003);
    EXPECT_NEAR(fine.report.surface.area / coarse.report.surface.area, 1.0, 0.001);
    EXPECT_NEAR(fine.report.surface.volume / coarse.report.surface.volume, 1.0, 0.001);
    EXPECT_NEAR(fine.report.surface.area, 6154.5, 3e-4 * 6154.5);
    EXPECT_NEAR(fine.report.surface.volume, 19344.8, 3e-4 * 19344.8);
}

// At a lambda of 1 Å^2 the molecule nearly becomes its hull. The pockets that close on the way
// there are told of a flow that has to end too early.
TEST(Pipeline, TellsHowMuchStillMovesWhereAFlowEndsEarly)
{
    SurfaceOptions options;
    options.voxel = 1.0;
    options.evolution.lambda = 1.0;
    options.evolution.maxSteps = 4;
    const MolecularSurface result = test::runOn(test::balls("1a8o.cif.gz", "1"), options);
    const EvolutionReport& flow = *result.report.evolution;
    EXPECT_FALSE(flow.converged);
    EXPECT_GT(flow.displacementTail, 0.08 * options.voxel);
    EXPECT_GT(flow.unsettledShare, 0.001);
    EXPECT_LT(flow.unsettledShare, 0.5);
    options.evolution.maxSteps.reset();
    EXPECT_TRUE(test::runOn(test::balls("1a8o.cif.gz", "1"), options).report.evolution->converged);
}

TEST(Pipeline, DimerOf1A8OWithALargeLambda)
{
    SurfaceOptions options;
    options.evolution.lambda = 0.1;
    const MolecularSurface result = test::runOn(test::balls("1a8o.cif.gz", "1"), options);
    printLine("1a8o lambda 0.1", result);
    EXPECT_TRUE(result.report.evolution->converged);
    EXPECT_LE(result.report.evolution->steps, 10);
    // 21,757 and 21,772 on voxels of 0.25 and 0.125 Å.
    EXPECT_NEAR(result.report.surface.volume, 21772.0, 0.003 * 21772.0);
}

// The jet of the spline from both sides of cell faces near the surface, some of them between
// leaves, in units of voxels: the surface is C2.
TEST(Pipeline, TheSurfaceIsC2AcrossCellsAndLeaves)
{
    SurfaceOptions options;
    options.fields = {"spline"};
    const MolecularSurface result = test::runOn(test::balls("1a8o.cif.gz", "1"), options);
    const Spline spline = test::splineFrom(result);
    ASSERT_GT(spline.table().size(), 100u);
    SplineSampler sampler(spline);
    const double h = spline.voxelSize();
    double value = 0.0, gradient = 0.0, hessian = 0.0, residual = 0.0;
    std::size_t leafFaces = 0, samples = 0;
    for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        const Vec3d x(result.mesh.positions[v]);
        residual = std::max(residual, std::abs(sampler.at(x).value));
        const int axis = int(v % 3);
        Vec3d below = x / h, above = below; // onto the nearest face across the axis
        const double face = std::round(below[axis]);
        leafFaces += (int(face) & 7) == 0;
        below[axis] = face - 1e-10;
        above[axis] = face + 1e-10;
        const Jet a = sampler.at(below * h), b = sampler.at(above * h);
        value = std::max(value, std::abs(a.value - b.value) / h);
        gradient = std::max(gradient, (a.gradient - b.gradient).length());
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j)
                hessian = std::max(hessian, h * std::abs(a.hessian(i, j) - b.hessian(i, j)));
        }
        ++samples;
    }
    EXPECT_GT(leafFaces, samples / 16);
    EXPECT_LT(value, 1e-5);
    EXPECT_LT(gradient, 1e-5);
    EXPECT_LT(hessian, 1e-5);
    EXPECT_LT(residual, 1e-3); // Å, of the vertices as floats
    if (getenv("VERBOSE"))
        printf("jumps %.2e %.2e %.2e residual %.2e\n", value, gradient, hessian, residual);
}

bool sameBits(const Mesh& a, const Mesh& b)
{
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    bool equal = same(a.positions, b.positions) && same(a.normals, b.normals) &&
                 same(a.triangles, b.triangles) && a.scalars.size() == b.scalars.size() &&
                 a.labels.size() == b.labels.size();
    for (std::size_t i = 0; equal && i < a.scalars.size(); ++i)
        equal = same(a.scalars[i].values, b.scalars[i].values);
    for (std::size_t i = 0; equal && i < a.labels.size(); ++i)
        equal = same(a.labels[i].values, b.labels[i].values);
    return equal;
}

TEST(Pipeline, GivesTheSameBitsForAnyNumberOfThreads)
{
    const std::vector<Ball> balls = test::balls("1a8o.cif.gz", "1");
    std::vector<MolecularSurface> results;
    for (const int threads : {1, 2, 4}) {
        tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(threads));
        results.push_back(test::runOn(balls));
    }
    const MolecularSurface& one = results[0];
    for (std::size_t k = 1; k < results.size(); ++k) {
        const MolecularSurface& many = results[k];
        EXPECT_TRUE(sameBits(one.mesh, many.mesh));
        EXPECT_EQ(one.report.evolution->energy, many.report.evolution->energy);
        EXPECT_EQ(one.report.surface.area, many.report.surface.area);
        EXPECT_EQ(one.report.surface.volume, many.report.surface.volume);
        EXPECT_TRUE(one.surface->tree().hasSameTopology(many.surface->tree()));
        auto read = many.surface->getConstAccessor();
        std::size_t different = 0;
        for (auto it = one.surface->cbeginValueAll(); it; ++it)
            different += read.getValue(it.getCoord()) != *it;
        EXPECT_EQ(different, 0u);
    }
}

// Moving and turning a molecule changes the grid under it, not its surface.
TEST(Pipeline, HardlyDependsOnThePlaceInTheGrid)
{
    std::vector<Ball> balls = test::balls("1crn.pdb");
    const SurfaceReport a = test::runOn(balls).report.surface;
    for (Ball& ball : balls) {
        const Vec3d x(ball.center);
        ball.center = openvdb::Vec3f(Vec3d(-x.y() + 1000.17, x.x() - 500.31, x.z() + 200.23));
    }
    const SurfaceReport b = test::runOn(balls).report.surface;
    EXPECT_NEAR(b.area / a.area, 1.0, 2e-3);
    EXPECT_NEAR(b.volume / a.volume, 1.0, 1e-3);
}

} // namespace
} // namespace molsurf
