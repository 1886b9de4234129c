// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/extract.h"

#include "molsurf/core/parallel.h"
#include "molsurf/mesh/topology.h"
#include "molsurf/spline/curvature.h"

#include <openvdb/tools/VolumeToMesh.h>

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

constexpr int bisections = 30;
constexpr std::size_t chunk = 512; // vertices that share a sampler

/// Finds S = 0 between the corners of the cell of a point: the line from the corner nearest to the
/// point to the nearest one of the other sign.
void bisect(SplineSampler& sampler, double voxel, Vec3d& x, Jet& jet)
{
    const Coord cell = Coord::floor(x / voxel);
    Vec3d ends[2] = {x, x};
    double distance[2] = {1e30, 1e30};
    for (int k = 0; k < 8; ++k) {
        const Vec3d corner = cell.offsetBy(k >> 2, k >> 1 & 1, k & 1).asVec3d() * voxel;
        const int side = sampler.at(corner).value < 0.0 ? 0 : 1;
        const double d = (corner - x).lengthSqr();
        if (d < distance[side]) {
            distance[side] = d;
            ends[side] = corner;
        }
    }
    if (distance[0] < 1e30 && distance[1] < 1e30) {
        for (int i = 0; i < bisections; ++i) {
            x = 0.5 * (ends[0] + ends[1]);
            ends[sampler.at(x).value < 0.0 ? 0 : 1] = x;
        }
    }
    jet = sampler.at(x);
}

struct Vertices {
    Mesh& mesh; ///< its scalars are the mean and the Gaussian curvature
    std::vector<float>& slope;

    void set(std::size_t v, const Vec3d& x, const Jet& jet)
    {
        mesh.positions[v] = Vec3f(x);
        const double length = jet.gradient.length();
        slope[v] = float(length);
        mesh.normals[v] = length > 0.0 ? Vec3f(jet.gradient / length) : Vec3f(0.0f, 0.0f, 1.0f);
        const bool regular = length >= leastSlope;
        mesh.scalars[0].values[v] = regular ? float(meanCurvature(jet)) : 0.0f;
        mesh.scalars[1].values[v] = regular ? float(gaussianCurvature(jet)) : 0.0f;
    }
};

/// Cross product of two edges: the normal of a triangle, twice its area long.
Vec3d normalOf(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    const Vec3d p(mesh.positions[a]);
    return (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p);
}

/// The agreement of a triangle with the normals at its corners, as the cosine of the largest angle
/// between them; 0 for a triangle without area.
double agreement(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    const Vec3d n = normalOf(mesh, a, b, c);
    const double length = n.length();
    if (length == 0.0) return 0.0;
    return std::min({n.dot(Vec3d(mesh.normals[a])), n.dot(Vec3d(mesh.normals[b])),
                     n.dot(Vec3d(mesh.normals[c]))}) /
           length;
}

/// Splits the quad a b c d into two triangles: along the shorter diagonal, unless the other one
/// agrees clearly better with the normals.
void splitQuad(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
               std::array<std::uint32_t, 3>* out)
{
    const auto length2 = [&](std::uint32_t i, std::uint32_t j) {
        return (mesh.positions[i] - mesh.positions[j]).lengthSqr();
    };
    const double ac = std::min(agreement(mesh, a, b, c), agreement(mesh, a, c, d));
    const double bd = std::min(agreement(mesh, b, c, d), agreement(mesh, b, d, a));
    const bool shorter = length2(a, c) <= length2(b, d);
    const bool useAC = std::abs(ac - bd) > 0.2 ? ac > bd : shorter;
    if (useAC) {
        out[0] = {a, b, c};
        out[1] = {a, c, d};
    } else {
        out[0] = {b, c, d};
        out[1] = {b, d, a};
    }
}

/// Twice the area over the square of the longest edge: sqrt(3)/2 at best, near 0 for a needle or a
/// cap.
double quality(const Mesh& mesh, const std::array<std::uint32_t, 3>& t)
{
    double longest2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        longest2 = std::max(
            longest2, double((mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).lengthSqr()));
    }
    return longest2 == 0.0 ? 0.0 : normalOf(mesh, t[0], t[1], t[2]).length() / longest2;
}

constexpr double leastQuality = 0.05, leastAgreement = 0.0;

bool isBad(const Mesh& mesh, const std::array<std::uint32_t, 3>& t)
{
    return quality(mesh, t) < leastQuality || agreement(mesh, t[0], t[1], t[2]) < leastAgreement;
}

/// Slides the vertices of bad triangles along the surface to the centroid of their neighbours.
void relax(Vertices& vertices, SplineSampler& sampler, double voxel, const Progress& progress)
{
    constexpr int rounds = 8;
    Mesh& mesh = vertices.mesh;
    auto bad = parallelCollect<std::uint32_t>(
        mesh.triangles.size(), progress, [&](std::size_t i, auto& corners) {
            const auto& t = mesh.triangles[i];
            if (isBad(mesh, t)) corners.insert(corners.end(), t.begin(), t.end());
        });
    for (int round = 0; round < rounds && !bad.empty(); ++round) {
        std::sort(bad.begin(), bad.end());
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        const VertexTriangles around = vertexTriangles(mesh, bad, progress);
        std::vector<std::uint32_t> still;
        for (std::size_t k = 0; k < bad.size(); ++k) {
            const std::uint32_t v = bad[k];
            const auto begin = around.triangles.begin() + around.begins[k];
            const auto end = around.triangles.begin() + around.begins[k + 1];
            const auto worst = [&] {
                double least = 1.0;
                for (auto i = begin; i != end; ++i) {
                    const auto& t = mesh.triangles[*i];
                    least = std::min({least, quality(mesh, t),
                                      agreement(mesh, t[0], t[1], t[2]) + leastQuality});
                }
                return least;
            };
            const double before = worst();
            if (before >= leastQuality) continue;
            Vec3d centroid(0.0);
            for (auto i = begin; i != end; ++i) {
                for (const std::uint32_t w : mesh.triangles[*i]) {
                    if (w != v) centroid += Vec3d(mesh.positions[w]);
                }
            }
            centroid /= 2.0 * double(end - begin); // each neighbour lies on two triangles
            const Vec3f oldPosition = mesh.positions[v], oldNormal = mesh.normals[v];
            const float oldSlope = vertices.slope[v];
            const float oldMean = mesh.scalars[0].values[v], oldGauss = mesh.scalars[1].values[v];
            Vec3d x = centroid;
            Jet jet;
            if (!moveToSurface(sampler, voxel, 1.0, x, jet)) continue;
            vertices.set(v, x, jet);
            if (worst() <= before) {
                mesh.positions[v] = oldPosition;
                mesh.normals[v] = oldNormal;
                vertices.slope[v] = oldSlope;
                mesh.scalars[0].values[v] = oldMean;
                mesh.scalars[1].values[v] = oldGauss;
                continue;
            }
            for (auto i = begin; i != end; ++i) {
                const auto& t = mesh.triangles[*i];
                if (isBad(mesh, t)) still.insert(still.end(), t.begin(), t.end());
            }
        }
        bad = std::move(still);
    }
}

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
    parallelFor((vertices + chunk - 1) / chunk, progress, [&](std::size_t c) {
        SplineSampler sampler(spline);
        for (std::size_t v = c * chunk; v < std::min(vertices, (c + 1) * chunk); ++v) {
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
    mesher(surface);
    if (progress.cancelled()) throw Cancelled();
    const openvdb::Vec3s* starts = mesher.pointList().get();
    openvdb::tools::PolygonPoolList& pools = mesher.polygonPoolList(); // quads alone, by leaf
    std::vector<std::size_t> begins(mesher.polygonPoolListSize() + 1, 0);
    for (std::size_t n = 0; n + 1 < begins.size(); ++n)
        begins[n + 1] = begins[n] + pools[n].numQuads();

    Mesh mesh;
    const std::size_t count = mesher.pointListSize();
    for (const char* name : {"mean_curvature", "gaussian_curvature"})
        mesh.scalars.push_back({name, {}});
    // The first touch of memory takes long: none of these waits for another.
    tbb::parallel_invoke([&] { mesh.positions.resize(count); }, [&] { mesh.normals.resize(count); },
                         [&] { stats.slopes.resize(count); },
                         [&] { mesh.scalars[0].values.resize(count); },
                         [&] { mesh.scalars[1].values.resize(count); },
                         [&] { stats.cells.resize(stats.keepCells ? count : 0); },
                         [&] { stats.residuals.resize(stats.keepCells ? count : 0); });
    Vertices vertices{mesh, stats.slopes};
    const double voxel = surface.voxelSize()[0];

    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::vector<double> residual(chunks, 0.0);
    const auto project = [&](std::size_t c) {
        SplineSampler sampler(spline);
        for (std::size_t v = c * chunk; v < std::min(count, (c + 1) * chunk); ++v) {
            const Vec3d start(starts[v]);
            Vec3d x = start;
            Jet jet;
            if (!moveToSurface(sampler, voxel, 1.0, x, jet)) {
                x = start;
                bisect(sampler, voxel, x, jet);
            }
            vertices.set(v, x, jet);
            residual[c] = std::max(residual[c], std::abs(jet.value));
            if (!stats.keepCells) continue;
            stats.cells[v] = Coord::floor(start / voxel);
            stats.residuals[v] = float(std::abs(jet.value));
        }
    };
    tbb::parallel_invoke([&] { mesh.triangles.resize(2 * begins.back()); },
                         [&] { parallelFor(chunks, progress, project); });
    mesher.pointList().reset();
    for (const double r : residual) stats.maxResidual = std::max(stats.maxResidual, r);

    parallelFor(begins.size() - 1, progress, [&](std::size_t n) {
        for (std::size_t i = 0; i < pools[n].numQuads(); ++i) {
            // OpenVDB's polygons run clockwise seen from outside.
            const auto& q = pools[n].quad(i);
            splitQuad(mesh, q[3], q[2], q[1], q[0], &mesh.triangles[2 * (begins[n] + i)]);
        }
        pools[n].clearQuads();
    });

    SplineSampler sampler(spline);
    relax(vertices, sampler, voxel, progress);
    return mesh;
}

} // namespace molsurf
