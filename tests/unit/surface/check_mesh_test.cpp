// SPDX-License-Identifier: MPL-2.0

#include "molsurf/surface/check_mesh.h"

#include "molsurf/error.h"
#include "molsurf/mesh/measure.h"
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

} // namespace
} // namespace molsurf::test
