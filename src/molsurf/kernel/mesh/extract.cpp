// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/extract.h"

#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/surface_vertices.h"
#include "molsurf/kernel/mesh/triangle_shape.h"
#include "molsurf/kernel/mesh/volume_mesher.h"
#include "molsurf/kernel/spline/curvature.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::size_t perSampler = 1024; // vertices that share a sampler

} // namespace

void addCurvature(const Spline& spline, const std::vector<std::string>& names, Mesh& mesh,
                  const Progress& progress)
{
    std::vector<const CurvatureField*> fields;
    std::vector<float*> columns; // one a component
    const std::size_t vertices = mesh.positions.size(), before = mesh.scalars.size();
    for (const std::string& name : names) {
        const auto present = [&](const auto& a) { return a.name.rfind(name, 0) == 0; };
        const CurvatureField* field = findCurvatureField(name);
        if (!field || std::any_of(mesh.scalars.begin(), mesh.scalars.end(), present)) continue;
        fields.push_back(field);
        for (int i = 0; i < field->components; ++i) {
            const std::string suffix = field->components > 1 ? std::string{'_', "xyz"[i]} : "";
            mesh.scalars.push_back({name + suffix, std::vector<float>(vertices)});
        }
    }
    if (fields.empty()) return;
    for (std::size_t i = before; i < mesh.scalars.size(); ++i)
        columns.push_back(mesh.scalars[i].values.data());
    parallelFor((vertices + perSampler - 1) / perSampler, progress, [&](std::size_t c) {
        SplineSampler sampler(spline);
        for (std::size_t v = c * perSampler; v < std::min(vertices, (c + 1) * perSampler); ++v) {
            const Curvature k = curvature(sampler.at(Vec3d(mesh.positions[v])));
            auto column = columns.begin();
            for (const CurvatureField* field : fields) {
                float value[3];
                field->value(k, value);
                for (int i = 0; i < field->components; ++i) (*column++)[v] = value[i];
            }
        }
    });
}

Mesh extractMesh(const openvdb::FloatGrid& surface, const Spline& spline, const Progress& progress,
                 ExtractStats& stats)
{
    openvdb::tools::VolumeToMesh mesher;
    meshVolume(surface, mesher);
    stopIfCancelled(progress);
    openvdb::tools::PolygonPoolList& pools = mesher.polygonPoolList(); // quads alone, by leaf
    std::vector<std::size_t> begins(mesher.polygonPoolListSize() + 1, 0);
    for (std::size_t n = 0; n + 1 < begins.size(); ++n)
        begins[n + 1] = begins[n] + 2 * pools[n].numQuads();

    Mesh mesh;
    const std::size_t count = mesher.pointListSize();
    // What the mesher made gives its memory back before the mesh takes more.
    const auto takePoints = [&] {
        mesh.positions.assign(mesher.pointList().get(), mesher.pointList().get() + count);
        mesher.pointList().reset();
    };
    const auto takeQuads = [&] {
        mesh.triangles.resize(begins.back());
        parallelFor(begins.size() - 1, progress, [&](std::size_t n) {
            for (std::size_t i = 0; i < pools[n].numQuads(); ++i) {
                // OpenVDB's polygons run clockwise seen from outside.
                const auto& q = pools[n].quad(i);
                const auto halves = halvesOf(q[3], q[2], q[1], q[0]);
                std::copy_n(halves.begin(), 2, mesh.triangles.begin() + begins[n] + 2 * i);
            }
            pools[n].clearQuads();
        });
    };
    tbb::parallel_invoke(takePoints, takeQuads);
    trimHeap(); // of quads
    for (const char* name : {"mean_curvature", "gaussian_curvature"})
        mesh.scalars.push_back({name, {}});
    // The first touch of memory takes long: none of these waits for another.
    tbb::parallel_invoke([&] { mesh.normals.resize(count); }, [&] { stats.slopes.resize(count); },
                         [&] { mesh.scalars[0].values.resize(count); },
                         [&] { mesh.scalars[1].values.resize(count); },
                         [&] { stats.cells.resize(stats.keepCells ? count : 0); },
                         [&] { stats.residuals.resize(stats.keepCells ? count : 0); });
    SurfaceVertices vertices{mesh, stats.slopes};
    const double voxel = surface.voxelSize()[0];

    const std::size_t chunks = (count + perSampler - 1) / perSampler;
    std::vector<float> largest(chunks, 0.0f);
    parallelFor(chunks, progress, [&](std::size_t c) {
        const std::size_t first = c * perSampler, end = std::min(count, first + perSampler);
        float residuals[perSampler];
        if (stats.keepCells)
            for (std::size_t v = first; v < end; ++v)
                stats.cells[v] = Coord::floor(Vec3d(mesh.positions[v]) / voxel);
        moveToSurface(spline, voxel, first, end, vertices, residuals);
        largest[c] = *std::max_element(residuals, residuals + (end - first));
        if (stats.keepCells)
            std::copy_n(residuals, end - first, stats.residuals.begin() + std::ptrdiff_t(first));
    });
    for (const float r : largest) stats.maxResidual = std::max(stats.maxResidual, double(r));

    VertexSet bad(count);
    parallelFor(begins.size() - 1, progress,
                [&](std::size_t n) { splitQuads(begins[n], begins[n + 1], mesh, bad); });
    relax(vertices, spline, voxel, std::move(bad), progress);
    return mesh;
}

} // namespace molsurf
