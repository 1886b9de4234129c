// SPDX-License-Identifier: MPL-2.0
#include "support/alpha_shape.h"
#include "support/mesh_checks.h"
#include "support/motion.h"
#include "support/runs.h"

#include <openvdb/tools/Interpolation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

SurfaceOptions optionsFor(SurfaceKind kind, double voxel = 0.5)
{
    SurfaceOptions options;
    options.kind = kind;
    options.voxel = voxel;
    return options;
}

/// The largest errors of area and volume of an SES over random places and orientations [%].
std::pair<double, double> worstOf(const std::vector<Vec3d>& centres, double area, double volume,
                                  double voxel, int poses)
{
    std::mt19937 random(11);
    std::pair<double, double> worst{0.0, 0.0};
    for (int pose = 0; pose < poses; ++pose) {
        const test::Motion move = test::randomMotion(random);
        std::vector<Ball> balls;
        for (const Vec3d& c : centres) balls.push_back({move(c), 1.7f, 0});
        const SurfaceReport s =
            test::runOn(balls, optionsFor(SurfaceKind::SolventExcluded, voxel)).report.surface;
        EXPECT_TRUE(s.closed && s.manifold);
        EXPECT_NEAR(s.area, area, 1e-5);
        EXPECT_NEAR(s.volume, volume, 1e-5);
        worst.first = std::max(worst.first, 100.0 * std::abs(*s.meshArea / area - 1.0));
        worst.second = std::max(worst.second, 100.0 * std::abs(*s.meshVolume / volume - 1.0));
    }
    return worst;
}

// One, two and three atoms of radius 1.7 Å, 4 Å apart, probe 1.4 Å: spheres, tori and the triangles
// of the probes that touch three.
TEST(SolventExcluded, MeshesHaveNearlyTheClosedForm)
{
    struct Case {
        std::vector<Vec3d> centres;
        double area, volume;
    };
    const Vec3d third(2.0, 2.0 * std::sqrt(3.0), 0.0);
    const Case cases[] = {{{Vec3d(0.0)}, 36.316811, 20.579526},
                          {{Vec3d(0.0), Vec3d(4.0, 0.0, 0.0)}, 73.076789, 44.317154},
                          {{Vec3d(0.0), Vec3d(4.0, 0.0, 0.0), third}, 107.214561, 71.467744}};
    for (const Case& c : cases) {
        const auto [area, volume] = worstOf(c.centres, c.area, c.volume, 0.5, 20);
        EXPECT_LT(area, 0.4) << c.centres.size();
        EXPECT_LT(volume, 0.6) << c.centres.size();
        const auto [fineArea, fineVolume] = worstOf(c.centres, c.area, c.volume, 0.25, 5);
        EXPECT_LT(fineArea, 0.1) << c.centres.size();
        EXPECT_LT(fineVolume, 0.15) << c.centres.size();
    }
}

// One probe that touches all balls about a hole: mesh and closed form have to agree on whether it
// is there. A hole that is a little larger has one, a smaller one has not.
TEST(SolventExcluded, OfAHoleThatAProbeJustFits)
{
    const double third = 1.0 / std::sqrt(3.0);
    std::vector<Vec3d> octahedron, cube, tetrahedron;
    for (int k = 0; k < 6; ++k) {
        Vec3d way(0.0);
        way[k / 2] = k % 2 ? 1.0 : -1.0;
        octahedron.push_back(way);
    }
    for (int k = 0; k < 8; ++k) {
        cube.push_back(third * Vec3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
        if (k == 0 || k == 3 || k == 5 || k == 6) tetrahedron.push_back(cube.back());
    }
    for (const auto* ways : {&octahedron, &cube, &tetrahedron}) {
        for (const double distance : {2.99, 3.0, 3.01}) { // of a probe that touches balls of 1.6 Å
            std::vector<Ball> balls;
            for (const Vec3d& way : *ways)
                balls.push_back({Vec3f(distance * way), 1.6f, std::int32_t(balls.size())});
            const SurfaceReport s =
                test::runOn(balls, optionsFor(SurfaceKind::SolventExcluded, 0.25)).report.surface;
            const bool walled = ways->size() > 4; // between four balls it meets those outside
            EXPECT_EQ(s.cavities.size(), walled && distance > 3.0 ? 1u : 0u) << ways->size();
            EXPECT_EQ(s.eulerCharacteristic, s.meshEulerCharacteristic) << ways->size();
            EXPECT_NEAR(*s.meshArea, s.area, 0.01 * s.area) << ways->size() << ' ' << distance;
        }
    }
}

// Against the area and volume of NanoShaper 1.5 at 0.125 Å.
TEST(SolventExcluded, OfProteins)
{
    const SurfaceOptions options = optionsFor(SurfaceKind::SolventExcluded);
    const MolecularSurface result = test::runOn(test::balls("1crn.pdb"), options);
    const SurfaceReport& s = result.report.surface;
    EXPECT_NEAR(*s.meshArea, 2317.8, 0.005 * 2317.8);
    EXPECT_NEAR(*s.meshVolume, 4664.7, 0.0015 * 4664.7);
    EXPECT_NEAR(s.area, 2317.8, 0.001 * 2317.8);
    EXPECT_NEAR(s.volume, 4664.7, 0.0001 * 4664.7);
    EXPECT_EQ(s.kind, "ses");
    EXPECT_FALSE(result.report.evolution);
    const test::MeshVerdict verdict = test::judge(result.mesh);
    EXPECT_TRUE(verdict.good()) << verdict;
}

// The union of balls is known exactly, whatever the voxels.
TEST(UnionSurfaces, AreExactAtAnyVoxel)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals}) {
        const MolecularSurface coarse = test::runOn(balls, optionsFor(kind, 0.5));
        const MolecularSurface fine = test::runOn(balls, optionsFor(kind, 0.3));
        EXPECT_NEAR(coarse.report.surface.area, fine.report.surface.area, 1e-6);
        EXPECT_NEAR(coarse.report.surface.volume, fine.report.surface.volume, 1e-6);
        // The grid knows the volume too.
        double inside = 0.0;
        for (auto v = fine.surface->cbeginValueOn(); v; ++v) {
            inside += std::clamp(0.5 - *v / 0.3, 0.0, 1.0);
        }
        for (auto v = fine.surface->cbeginValueOff(); v; ++v) {
            if (*v < 0.0f) inside += double(v.getVoxelCount());
        }
        EXPECT_NEAR(inside * 0.027, fine.report.surface.volume, 0.004 * fine.report.surface.volume);
        EXPECT_TRUE(fine.report.surface.closed && fine.report.surface.manifold);
    }
}

// So is its topology, wherever the molecule lies on the grid, and CGAL's alpha shapes agree: a mesh
// of these voxels has 12 to 24 for the Euler number of ubiquitin's solvent-accessible surface, 4.
TEST(UnionSurfaces, TopologyDoesNotTurnWithTheMolecule)
{
    const std::vector<Ball> balls = test::balls("1ubq.pdb");
    for (const SurfaceKind kind : {SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals}) {
        const SurfaceOptions options = optionsFor(kind, 0.7);
        const SurfaceReport first = test::runOn(balls, options).report.surface;
        const double probe = kind == SurfaceKind::SolventAccessible ? options.probe : 0.0;
        EXPECT_EQ(first.eulerCharacteristic, test::eulerOfUnion(balls, probe)) << nameOf(kind);
        std::mt19937 random(5);
        for (int pose = 0; pose < 10; ++pose) {
            const test::Motion move = test::randomMotion(random);
            std::vector<Ball> moved = balls;
            for (Ball& ball : moved) ball.center = move(Vec3d(ball.center));
            const SurfaceReport s = test::runOn(moved, options).report.surface;
            EXPECT_EQ(s.eulerCharacteristic, first.eulerCharacteristic) << nameOf(kind) << pose;
            EXPECT_EQ(s.components, first.components) << nameOf(kind) << pose;
            EXPECT_EQ(s.cavities.size(), first.cavities.size()) << nameOf(kind) << pose;
            EXPECT_NEAR(s.area, first.area, 1e-5 * first.area) << nameOf(kind) << pose;
        }
    }
}

// psi = 0 of one atom is its sphere; of the same atom twice 2 exp(-(d/r^2)(x^2 - r^2)) = 1.
TEST(Gaussian, OneAtomAndTheSameTwice)
{
    const Vec3f c(0.137f, -0.291f, 0.443f);
    SurfaceOptions options = optionsFor(SurfaceKind::Gaussian, 0.25);
    const SurfaceReport one = test::runOn({{c, 1.7f, 0}}, options).report.surface;
    EXPECT_NEAR(std::sqrt(one.area / (4.0 * M_PI)), 1.7, 0.002);
    options.blobbiness = 1.0;
    const SurfaceReport two = test::runOn({{c, 1.7f, 0}, {c, 1.7f, 1}}, options).report.surface;
    const double radius = 1.7 * std::sqrt(1.0 + std::log(2.0));
    EXPECT_NEAR(std::sqrt(two.area / (4.0 * M_PI)), radius, 0.002);
    EXPECT_NEAR(std::cbrt(two.volume * 3.0 / (4.0 * M_PI)), radius, 0.002);
}

/// Balls on a sphere about a hollow.
std::vector<Ball> shell(double radius)
{
    std::vector<Ball> out;
    for (int k = 0; k < 200; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 200, a = k * M_PI * (3.0 - std::sqrt(5.0));
        const double s = std::sqrt(1.0 - z * z);
        out.push_back({Vec3f(float(radius * s * std::cos(a)), float(radius * s * std::sin(a)),
                             float(radius * z)),
                       1.9f, 0});
    }
    return out;
}

TEST(UnionSurfaces, CavitiesAreListedOrFilled)
{
    for (const SurfaceKind kind : {SurfaceKind::SolventExcluded, SurfaceKind::SolventAccessible,
                                   SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
        SurfaceOptions options = optionsFor(kind);
        const MolecularSurface hollow = test::runOn(shell(8.0), options);
        const SurfaceReport& s = hollow.report.surface;
        ASSERT_EQ(s.cavities.size(), 1u) << nameOf(kind);
        EXPECT_EQ(s.components, 1);
        EXPECT_GT(s.cavities[0].volume, 100.0);

        options.fillCavities = true;
        const MolecularSurface filled = test::runOn(shell(8.0), options);
        const SurfaceReport& f = filled.report.surface;
        EXPECT_TRUE(f.cavities.empty()) << nameOf(kind);
        EXPECT_EQ(f.eulerCharacteristic, 2) << nameOf(kind);
        // What is left of ses is measured by the mesh.
        const double within = kind == SurfaceKind::SolventExcluded ? 0.003 : 0.001;
        EXPECT_NEAR(f.area, s.outerArea, within * s.outerArea) << nameOf(kind);
        EXPECT_NEAR(f.volume, s.outerVolume, 0.001 * s.outerVolume) << nameOf(kind);
        // Voxels of the cavity are inner ones.
        EXPECT_LT(filled.surface->tree().getValue(openvdb::Coord(0)), 0.0f) << nameOf(kind);
        EXPECT_GT(hollow.surface->tree().getValue(openvdb::Coord(0)), 0.0f) << nameOf(kind);
    }
}

// It is the level set at rest, which the variational surface lies inside of by the probe radius.
TEST(SmoothAccessible, IsTheLevelSetAtRest)
{
    const std::vector<Ball> balls = test::balls("1crn.pdb");
    SurfaceOptions options = optionsFor(SurfaceKind::Variational);
    options.fields = {"sas"};
    const MolecularSurface inside = test::runOn(balls, options);
    const auto rest = openvdb::gridPtrCast<openvdb::FloatGrid>(inside.fields.at(0));
    const MolecularSurface smooth = test::runOn(balls, optionsFor(SurfaceKind::SmoothAccessible));
    openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::QuadraticSampler> phi(*rest);
    double sum = 0.0, farthest = 0.0; // where creases are rounded
    for (const Vec3f& p : smooth.mesh.positions) {
        const double beside = phi.wsSample(Vec3d(p));
        sum += beside * beside;
        farthest = std::max(farthest, std::abs(beside));
    }
    EXPECT_LT(std::sqrt(sum / double(smooth.mesh.positions.size())), 0.015);
    EXPECT_LT(farthest, 0.15);
    const SurfaceReport& s = smooth.report.surface;
    EXPECT_TRUE(s.closed && s.manifold);
    EXPECT_EQ(s.kind, "smooth-sas");
    const SurfaceReport exact =
        test::runOn(balls, optionsFor(SurfaceKind::SolventAccessible)).report.surface;
    EXPECT_NEAR(s.area, exact.area, 0.1 * exact.area);
    EXPECT_GT(s.volume, exact.volume);
}

// The field "sas" is the solvent-accessible surface, whichever surface is made: of one atom a ball
// of its radius and the probe's, up to what lambda takes off a variational one.
TEST(Sas, OfOneAtomIsThatOfTheProbe)
{
    constexpr double voxel = 0.5, radius = 1.7;
    const Vec3d centre(0.1, -0.2, 0.3);
    for (const double probe : {1.4, 1.0}) {
        for (const SurfaceKind kind :
             {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
              SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
            SurfaceOptions options = optionsFor(kind, voxel);
            options.probe = probe;
            options.fields = {"sas"};
            const MolecularSurface result = test::runOn({{centre, float(radius), 0}}, options);
            const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(result.fields.at(0));
            ASSERT_GT(grid->activeVoxelCount(), 500u) << nameOf(kind);
            for (auto it = grid->cbeginValueOn(); it; ++it) {
                const double d = (it.getCoord().asVec3d() * voxel - centre).length();
                ASSERT_NEAR(*it, d - radius - probe, 0.03) << nameOf(kind) << " " << probe;
            }
        }
    }
}

// A ball that has to be 6 Å thick becomes one of radius 3 Å, beyond the band of its own surface.
TEST(MinWall, OfASmallBallIsABallOfTheWall)
{
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
                                   SurfaceKind::VanDerWaals, SurfaceKind::SmoothAccessible}) {
        SurfaceOptions options = optionsFor(kind, 0.25);
        options.minThickness = 6.0;
        const SurfaceReport s = test::runOn({{Vec3d(0.0), 1.0f, 0}}, options).report.surface;
        EXPECT_TRUE(s.closed && s.manifold) << nameOf(kind);
        EXPECT_EQ(s.eulerCharacteristic, 2) << nameOf(kind);
        EXPECT_NEAR(s.area, 36.0 * M_PI, 0.36 * M_PI) << nameOf(kind);
        EXPECT_NEAR(s.volume, 36.0 * M_PI, 0.36 * M_PI) << nameOf(kind);
    }
}

TEST(UnionSurfaces, OfSpecialPositions)
{
    const auto at = [](float x, float y, float z) { return Ball{Vec3f(x, y, z), 1.7f, 0}; };
    const std::vector<std::vector<Ball>> cases = {
        {at(0, 0, 0), at(0, 0, 0)},                                  // equal
        {at(0, 0, 0), at(3.4f, 0, 0)},                               // touching
        {at(0, 0, 0), at(2, 0, 0), at(0, 2, 0), at(2, 2, 0)},        // four spheres, one point
        {at(0, 0, 0), at(1.5f, 0, 0), at(3, 0, 0), at(4.5f, 0, 0)}}; // collinear
    for (const SurfaceKind kind : {SurfaceKind::SolventExcluded, SurfaceKind::SolventAccessible,
                                   SurfaceKind::VanDerWaals, SurfaceKind::Gaussian}) {
        for (const auto& balls : cases) {
            const MolecularSurface result = test::runOn(balls, optionsFor(kind));
            const SurfaceReport& s = result.report.surface;
            EXPECT_TRUE(s.closed && s.manifold) << nameOf(kind) << " " << balls.size();
            EXPECT_GT(s.volume, 20.0);
            EXPECT_LT(s.volume, 1.1 * double(balls.size()) * 124.8);
        }
    }
}

} // namespace
} // namespace molsurf
