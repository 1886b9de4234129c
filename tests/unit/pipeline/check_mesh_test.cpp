// SPDX-License-Identifier: MPL-2.0

#include "molsurf/kernel/pipeline/check_mesh.h"

#include "molsurf/error.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/surface.h"

#include "unit/structure/temp_file.h"

#include <functional>

namespace molsurf::test
{
namespace
{

constexpr double voxel = 0.5;

/// Expects that a change of a right mesh, or of its report, is refused.
void expectRefused(const std::function<void(Mesh&)>& change,
                   const std::function<void(SurfaceReport&)>& lie, ErrorKind kind,
                   const std::string& says)
{
    MolecularSurface made = makeSurface({{{0.1, 0.2, 0.3}, 1.7, 0}, {{2.1, 0.2, 0.3}, 1.5, 1}});
    EXPECT_NO_THROW(checkMesh(made.mesh, made.report.surface, voxel, Progress()));
    change(made.mesh);
    SurfaceReport report = measure(made.mesh, Progress());
    lie(report);
    EXPECT_HAS(errorOf(kind, [&] { checkMesh(made.mesh, report, voxel, Progress()); }), says);
}

const auto nothing = [](auto&) {};

TEST(CheckMesh, RefusesAHole)
{
    expectRefused([](Mesh& mesh) { mesh.triangles.pop_back(); }, nothing, ErrorKind::Check,
                  "3 edges have not, the first at (");
}

TEST(CheckMesh, RefusesATriangleThatIsTurned)
{
    expectRefused([](Mesh& mesh) { std::swap(mesh.triangles[7][0], mesh.triangles[7][1]); },
                  nothing, ErrorKind::Check, "3 edges have not");
}

TEST(CheckMesh, RefusesAnEulerNumberOfNoSurfaces)
{
    for (const int chi : {1, 4})
        expectRefused(
            nothing, [=](SurfaceReport& r) { r.meshEulerCharacteristic = chi; }, ErrorKind::Check,
            "its Euler number " + std::to_string(chi));
}

TEST(CheckMesh, RefusesVerticesBesideTheSurface)
{
    expectRefused(
        nothing, [](SurfaceReport& r) { r.maxResidual = 6e-4; }, ErrorKind::Check,
        "a vertex lies 0.0006 Å beside the surface, expected 0.0005 Å at most");
}

TEST(CheckMesh, RefusesNormalsThatPointInward)
{
    expectRefused(
        [](Mesh& mesh) {
            for (auto& n : mesh.normals) n = -n;
        },
        [](SurfaceReport& r) { r.volume *= 0.5; }, ErrorKind::Numeric,
        "enclose volumes that differ [hint: a smaller `voxel`]");
}

// Triangles and arcs may enclose volumes that differ by a tenth of a voxel all over the surface.
TEST(CheckMesh, AllowsVolumesATenthOfAVoxel)
{
    const MolecularSurface made = makeSurface({{{0.1, 0.2, 0.3}, 1.7, 0}});
    SurfaceReport report = made.report.surface;
    const double exact = report.volume, voxels = voxel * report.area;
    report.volume = exact + 0.05 * voxels;
    EXPECT_NO_THROW(checkMesh(made.mesh, report, voxel, Progress()));
    report.volume = exact + 0.2 * voxels;
    EXPECT_THROW(checkMesh(made.mesh, report, voxel, Progress()), Error);
}

// Atoms of rhodopsin (1U19) about a place where psi is flat beside the interface: normals of the
// carrier mean nothing there, and a leaf behind it lies on the side of the leaves about it
// nevertheless.
TEST(CheckMesh, HoldsWhereTheCarrierIsFlat)
{
    const std::vector<Ball> balls = {
        {{77.448, 6.675, -3.616}, 1.7, 0},  {{77.255, 5.929, -2.456}, 1.7, 1},
        {{77.373, 4.543, -2.503}, 1.7, 2},  {{77.168, 3.782, -1.366}, 1.52, 3},
        {{82.942, 7.752, -1.706}, 1.7, 4},  {{82.111, 7.856, -0.793}, 1.52, 5},
        {{82.31, 10.099, -2.399}, 1.7, 6},  {{82.27, 9.141, 2.772}, 1.7, 7},
        {{81.857, 9.059, 1.604}, 1.52, 8},  {{82.222, 11.879, 1.576}, 1.7, 9},
        {{81.316, 11.635, 3.852}, 1.7, 10}, {{81.903, 8.3, 3.741}, 1.55, 11},
        {{80.916, 7.239, 3.517}, 1.7, 12},  {{79.69, 7.62, 4.319}, 1.7, 13},
        {{79.493, 8.81, 4.61}, 1.52, 14},   {{81.408, 5.872, 4.019}, 1.7, 15},
        {{78.88, 6.629, 4.691}, 1.55, 16},  {{77.682, 6.901, 5.482}, 1.7, 17},
        {{76.735, 5.679, 5.502}, 1.7, 18},  {{76.012, 5.378, 4.158}, 1.7, 19},
        {{74.088, 6.583, 3.329}, 1.52, 20}, {{77.762, 13.179, 1.179}, 1.7, 21},
        {{77.994, 11.995, 0.269}, 1.7, 22}, {{74.714, 8.996, -1.218}, 1.7, 23},
        {{75.548, 8.111, -0.337}, 1.7, 24}};
    SurfaceOptions options;
    options.voxel = 0.25;
    const SurfaceReport report = makeSurface(balls, options).report.surface;
    EXPECT_EQ(report.meshEulerCharacteristic, 2 * report.components);
    EXPECT_TRUE(report.cavities.empty());
}

// Probes that all but touch leave a solid in one piece, which voxels cut in 36.
TEST(CheckMesh, WarnsOfOtherPiecesThanTheSurfaceHas)
{
    std::vector<Ball> corners;
    for (int zero = 0; zero < 3; ++zero) {
        for (const double a : {-2.969848480983, 2.969848480983}) {
            for (const double b : {-2.969848480983, 2.969848480983}) {
                openvdb::Vec3d x(0.0);
                x[(zero + 1) % 3] = a;
                x[(zero + 2) % 3] = b;
                corners.push_back({x, 1.2, std::int32_t(corners.size())});
            }
        }
    }
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    const Report report = makeSurface(corners, options).report;
    EXPECT_EQ(report.surface.components, 1);
    EXPECT_EQ(report.surface.meshComponents, 36);
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_HAS(report.warnings[0], "mesh: it has 36 closed pieces, the surface 1:");
    const Report one = makeSurface({corners[0]}, options).report;
    EXPECT_EQ(one.surface.meshComponents, 1);
    EXPECT_TRUE(one.warnings.empty());
}

TEST(CheckMesh, WarnsOfAnAreaFarFromThatOfTheSurface)
{
    SurfaceReport surface;
    surface.components = 1;
    surface.cavities.resize(2);
    surface.meshComponents = 3;
    surface.area = 100.0;
    std::vector<std::string> warnings;
    for (const double near : {95.1, 104.9}) {
        surface.meshArea = near;
        warnOfMesh(surface, voxel, warnings);
    }
    EXPECT_TRUE(warnings.empty());
    surface.meshArea = 90.0;
    warnOfMesh(surface, voxel, warnings);
    surface.meshArea = 120.0;
    warnOfMesh(surface, voxel, warnings);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_HAS(warnings[0], "area is 10.0 % below that of the surface [hint: `voxel` 0.2]");
    EXPECT_HAS(warnings[1], "area is 20.0 % above that of the surface [hint: `voxel` 0.1]");
}

TEST(CheckMesh, TheTrianglesOfABallAreLessThanItsArea)
{
    const SurfaceReport ball = makeSurface({{{0.1, 0.2, 0.3}, 1.7, 0}}).report.surface;
    ASSERT_TRUE(ball.triangleArea);
    EXPECT_LT(*ball.triangleArea, 0.995 * ball.area);
    EXPECT_GT(*ball.triangleArea, 0.97 * ball.area);
}

} // namespace
} // namespace molsurf::test
