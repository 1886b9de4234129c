// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/surface/field_table.h"

#include "support/runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr double radius = 1.7208; // of the surface about one atom [Å]

std::vector<Ball> atom()
{
    return {{openvdb::Vec3f(0.13f, 0.29f, 0.41f), 1.7f, 7}};
}

template<typename Grid>
typename Grid::Ptr field(const MolecularSurface& result, const std::string& name)
{
    for (const auto& grid : result.fields)
        if (grid->getName() == name) return openvdb::gridPtrCast<Grid>(grid);
    return nullptr;
}

// A voxel has the curvature of the closest point of the surface, however far it is.
TEST(CurvatureGrids, HaveTheValueOfTheSurfaceThroughoutTheBand)
{
    SurfaceOptions options;
    options.voxel = 0.25;
    options.fields = fieldNames();
    const MolecularSurface result = test::runOn(atom(), options);
    // Atoms without chains and groups have no labels of these and no colours, and do not move.
    ASSERT_EQ(result.fields.size(), options.fields.size() - 4);
    const double k = 1.0 / radius;
    for (const auto& [name, expected] : {std::pair("mean_curvature", k),
                                         {"gaussian_curvature", k * k},
                                         {"principal_curvature_1", k},
                                         {"principal_curvature_2", k},
                                         {"shape_index", 1.0},
                                         {"curvedness", k}}) {
        const auto grid = field<openvdb::FloatGrid>(result, name);
        ASSERT_TRUE(grid) << name;
        EXPECT_EQ(grid->background(), 0.0f);
        EXPECT_EQ(grid->activeVoxelCount(), result.surface->activeVoxelCount());
        for (auto it = result.surface->cbeginValueOn(); it; ++it)
            ASSERT_NEAR(grid->tree().getValue(it.getCoord()), expected, 0.04 * expected)
                << name << " at " << *it;
    }
    const auto first = field<openvdb::Vec3SGrid>(result, "principal_direction_1");
    const auto second = field<openvdb::Vec3SGrid>(result, "principal_direction_2");
    ASSERT_TRUE(first && second);
    for (auto it = result.surface->cbeginValueOn(); it; ++it) {
        const Vec3d n = (result.surface->indexToWorld(it.getCoord()) - Vec3d(0.13, 0.29, 0.41));
        const Vec3d d1(first->tree().getValue(it.getCoord()));
        const Vec3d d2(second->tree().getValue(it.getCoord()));
        ASSERT_NEAR(d1.cross(d2).dot(n.unit()), 1.0, 1e-3);
        ASSERT_NEAR(d1.length(), 1.0, 1e-6);
    }
}

TEST(CurvatureGrids, AreFiniteOnAProtein)
{
    SurfaceOptions options;
    options.voxel = 1.0;
    options.fields = fieldNames();
    const MolecularSurface result = test::runOn(test::balls("1crn.pdb"), options);
    for (const CurvatureField& f : curvatureFields()) {
        if (const auto grid = field<openvdb::FloatGrid>(result, f.name)) {
            for (auto it = grid->cbeginValueOn(); it; ++it) ASSERT_TRUE(std::isfinite(*it));
        } else {
            for (auto it = field<openvdb::Vec3SGrid>(result, f.name)->cbeginValueOn(); it; ++it)
                ASSERT_NEAR(it->length(), 1.0f, 1e-5f);
        }
    }
    for (const auto& scalar : result.mesh.scalars)
        for (const float x : scalar.values) ASSERT_TRUE(std::isfinite(x)) << scalar.name;
}

TEST(CurvatureFields, BecomeVertexAttributesWhenAskedFor)
{
    const auto names = [](const Mesh& mesh) {
        std::vector<std::string> out;
        for (const auto& scalar : mesh.scalars) out.push_back(scalar.name);
        return out;
    };
    using Names = std::vector<std::string>;
    SurfaceOptions options;
    options.fields = {"spline", "mean_curvature"};
    EXPECT_EQ(names(test::runOn(atom(), options).mesh),
              (Names{"mean_curvature", "gaussian_curvature"}));
    options.fields = {"principal_curvature_1", "principal_direction_2"};
    const MolecularSurface result = test::runOn(atom(), options);
    EXPECT_EQ(names(result.mesh), (Names{"mean_curvature", "gaussian_curvature",
                                         "principal_curvature_1", "principal_direction_2_x",
                                         "principal_direction_2_y", "principal_direction_2_z"}));
    for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        const auto& s = result.mesh.scalars;
        EXPECT_NEAR(s[2].values[v], 1.0 / radius, 0.07 / radius);
        const openvdb::Vec3f d(s[3].values[v], s[4].values[v], s[5].values[v]);
        EXPECT_NEAR(d.length(), 1.0f, 1e-5f);
        EXPECT_NEAR(d.dot(result.mesh.normals[v]), 0.0f, 1e-4f);
    }
}

// One atom is a ball. Its statistics are always there, the integrals when asked for.
TEST(CurvatureReport, OfOneAtom)
{
    SurfaceOptions options;
    options.voxel = 0.25;
    EXPECT_FALSE(test::runOn(atom(), options).report.surface.integrals);
    options.curvatureTotals = true;
    const SurfaceReport report = test::runOn(atom(), options).report.surface;
    EXPECT_NEAR(report.meanCurvature.mean, 1.0 / radius, 0.005 / radius);
    EXPECT_NEAR(report.meanCurvature.percentiles[4], 1.0 / radius, 0.01 / radius);
    EXPECT_NEAR(report.gaussianCurvature.mean, 1.0 / (radius * radius), 0.01 / (radius * radius));
    ASSERT_TRUE(report.integrals);
    EXPECT_NEAR(report.integrals->area, report.area, 1e-3 * report.area);
    EXPECT_NEAR(report.integrals->volume, report.volume, 1e-3 * report.volume);
    EXPECT_NEAR(report.integrals->meanCurvature, 4.0 * M_PI * radius, 0.05);
}

// A protein's surface has cusps where K is concentrated within less than a voxel; at the vertices
// alone it adds up to something else altogether. At 1 Å there are triangles with opposite normals.
TEST(CurvatureReport, GaussBonnetOnAProtein)
{
    for (const double voxel : {1.0, 0.5}) {
        SurfaceOptions options;
        options.voxel = voxel;
        options.curvatureTotals = true;
        const MolecularSurface result = test::runOn(test::balls("1a8o.cif.gz", "1"), options);
        const SurfaceReport& report = result.report.surface;
        ASSERT_TRUE(report.integrals);
        const double chi = *report.eulerCharacteristic;
        EXPECT_NEAR(report.integrals->gaussianCurvature, 2.0 * M_PI * chi,
                    0.01 * 2.0 * M_PI * std::max(std::abs(chi), 2.0));
        EXPECT_EQ(report.integrals->unresolvedArea, 0.0);
        EXPECT_NEAR(report.integrals->area, report.area, 8e-3 * voxel * voxel * report.area);
        EXPECT_NEAR(report.integrals->volume, report.volume, 1e-3 * voxel * report.volume);
        EXPECT_GT(report.integrals->squaredMeanCurvature, 4.0 * M_PI);
        const double atVertices = report.gaussianCurvature.mean * report.area;
        EXPECT_GT(std::abs(atVertices - 2.0 * M_PI * chi), 1.0); // else this test shows nothing
    }
}

/// On voxels of 0.6 Å the accessible surface of crambin loses a sphere's worth in its creases.
TEST(CurvatureReport, WarnsWhereGaussBonnetFails)
{
    SurfaceOptions options;
    options.voxel = 0.6;
    options.curvatureTotals = true;
    const auto warnings = [&](SurfaceKind kind) {
        options.kind = kind;
        std::string out;
        for (const std::string& text :
             test::runOn(test::balls("1crn.pdb"), options).report.warnings)
            if (text.find("total_gaussian_curvature") == 0) out += text;
        return out;
    };
    EXPECT_EQ(warnings(SurfaceKind::Variational), "");
    EXPECT_NE(
        warnings(SurfaceKind::SolventAccessible).find("Euler number of the mesh, 4, got 1.999"),
        std::string::npos);
}

} // namespace
} // namespace molsurf
