// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_fem.h"

#include "molsurf/analysis/proximity/embree.h"
#include "molsurf/analysis/proximity/ray_scene.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/show/io/output_buffer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// A wall of a mesh.
struct Wall {
    std::string name; ///< "outer wall", "cavity 1"
    std::size_t marker;
    std::vector<std::uint32_t> vertices, triangles;
};

/// The walls of a mesh: marker 1 of outer ones, if there are any, 2 and on of cavities.
std::vector<Wall> wallsOf(const Mesh& mesh)
{
    const Progress nobody;
    const MeshPieces pieces = piecesOf(mesh, nobody);
    std::vector<std::size_t> cavities;
    for (std::size_t p = 0; p < pieces.measures.size(); ++p)
        if (pieces.measures[p].volume < 0.0) cavities.push_back(p);
    std::stable_sort(cavities.begin(), cavities.end(), [&](std::size_t a, std::size_t b) {
        return pieces.measures[a].volume < pieces.measures[b].volume;
    });
    std::vector<Wall> walls = {{"outer wall", 1, {}, {}}};
    std::vector<std::size_t> wallOf(pieces.measures.size(), 0);
    for (const std::size_t piece : cavities) {
        wallOf[piece] = walls.size();
        walls.push_back({"cavity " + std::to_string(walls.size()), walls.size() + 1, {}, {}});
    }
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        walls[wallOf[pieces.of[v]]].vertices.push_back(v);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        walls[wallOf[pieces.of[mesh.triangles[t][0]]]].triangles.push_back(t);
    if (walls.size() > 1 && walls.front().triangles.empty()) walls.erase(walls.begin());
    return walls;
}

/// A corner of a triangle.
Vec3d corner(const Mesh& mesh, std::uint32_t triangle, std::size_t k)
{
    return Vec3d(mesh.positions[mesh.triangles[triangle][k]]);
}

/// The normal of a triangle, twice its area long.
Vec3d normalOf(const Mesh& mesh, std::uint32_t triangle)
{
    const Vec3d a = corner(mesh, triangle, 0);
    return (corner(mesh, triangle, 1) - a).cross(corner(mesh, triangle, 2) - a);
}

/// A point in the void that a wall encloses: halfway from the middle of one of its triangles to
/// what lies opposite, the one of the few largest triangles for which that is farthest.
Vec3d pointInside(const Mesh& mesh, const RayScene& scene, const Wall& wall)
{
    constexpr std::size_t tries = 4; // rays that are traced at once
    constexpr float least = 1e-3f;   // of a hit, so that the triangle itself is none [Å]
    std::vector<std::uint32_t> large = wall.triangles;
    const std::size_t count = std::min(tries, large.size());
    std::partial_sort(large.begin(), large.begin() + std::ptrdiff_t(count), large.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                          return normalOf(mesh, a).lengthSqr() > normalOf(mesh, b).lengthSqr();
                      });
    std::array<Vec3d, tries> from, along;
    alignas(16) std::array<int, tries> valid{};
    alignas(16) RTCRayHit4 rays{};
    for (std::size_t s = 0; s < count; ++s) {
        const std::uint32_t t = large[s];
        from[s] = (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3.0;
        along[s] = normalOf(mesh, t).unit();
        valid[s] = -1; // Embree's word for a ray that is traced
        setRay(rays.ray, s, from[s], along[s], std::numeric_limits<double>::infinity());
        rays.ray.tnear[s] = least;
        rays.hit.geomID[s] = rays.hit.instID[0][s] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(valid.data(), scene.get(), rays);
    Vec3d best = from[0];
    double farthest = 0.0;
    for (std::size_t s = 0; s < count; ++s) {
        if (rays.hit.geomID[s] == RTC_INVALID_GEOMETRY_ID) continue;
        const double way = double(rays.ray.tfar[s]);
        if (way <= farthest) continue;
        farthest = way;
        best = from[s] + 0.5 * way * along[s];
    }
    return best;
}

/// Writes the numbers of the corners of a triangle, from 1.
void corners(const Mesh& mesh, std::uint32_t triangle, TextOutput& out)
{
    for (const std::uint32_t v : mesh.triangles[triangle]) out << " " << v + 1;
    out << "\n";
}

void place(const openvdb::Vec3f& x, TextOutput& out)
{
    out << x[0] << " " << x[1] << " " << x[2] << "\n";
}

/// Writes all vertices with their numbers, from 1.
void places(const Mesh& mesh, TextOutput& out)
{
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        out << v + 1 << " ";
        place(mesh.positions[v], out);
    }
}

void groups(const std::vector<Wall>& walls, TextOutput& out)
{
    out << "$PhysicalNames\n" << walls.size() << "\n";
    for (const Wall& wall : walls) out << "2 " << wall.marker << " \"" << wall.name << "\"\n";
    out << "$EndPhysicalNames\n";
}

} // namespace

void writePoly(const Mesh& mesh, OutputFile& file)
{
    const std::vector<Wall> walls = wallsOf(mesh);
    TextOutput out(file);
    out << "# vdb_molsurf: markers 1 outer walls, 2 and on cavities [A]\n"
        << mesh.positions.size() << " 3 0 0\n";
    places(mesh, out);
    out << mesh.triangles.size() << " 1\n";
    for (const Wall& wall : walls)
        for (const std::uint32_t t : wall.triangles) {
            out << "1 0 " << wall.marker << "\n3";
            corners(mesh, t, out);
        }
    const auto isCavity = [](const Wall& wall) { return wall.marker > 1; };
    out << std::count_if(walls.begin(), walls.end(), isCavity) << "\n";
    const RayScene scene(mesh);
    for (const Wall& wall : walls) {
        if (!isCavity(wall)) continue;
        const Vec3d x = pointInside(mesh, scene, wall);
        out << wall.marker - 1 << " " << x[0] << " " << x[1] << " " << x[2] << "\n";
    }
    out << "0\n";
    out.finish();
}

void writeMsh2(const Mesh& mesh, OutputFile& file)
{
    const std::vector<Wall> walls = wallsOf(mesh);
    TextOutput out(file);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    groups(walls, out);
    out << "$Nodes\n" << mesh.positions.size() << "\n";
    places(mesh, out);
    out << "$EndNodes\n$Elements\n" << mesh.triangles.size() << "\n";
    std::size_t element = 0;
    for (const Wall& wall : walls)
        for (const std::uint32_t t : wall.triangles) {
            out << ++element << " 2 2 " << wall.marker << " " << wall.marker;
            corners(mesh, t, out);
        }
    out << "$EndElements\n";
    out.finish();
}

void writeMsh4(const Mesh& mesh, OutputFile& file)
{
    const std::vector<Wall> walls = wallsOf(mesh);
    TextOutput out(file);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    groups(walls, out);
    out << "$Entities\n0 0 " << walls.size() << " 0\n";
    for (const Wall& wall : walls) {
        openvdb::BBoxd box;
        for (const std::uint32_t v : wall.vertices) box.expand(Vec3d(mesh.positions[v]));
        out << wall.marker;
        for (const Vec3d& end : {box.min(), box.max()})
            out << " " << end[0] << " " << end[1] << " " << end[2];
        out << " 1 " << wall.marker << " 0\n";
    }
    out << "$EndEntities\n$Nodes\n"
        << walls.size() << " " << mesh.positions.size() << " 1 " << mesh.positions.size() << "\n";
    for (const Wall& wall : walls) {
        out << "2 " << wall.marker << " 0 " << wall.vertices.size() << "\n";
        for (const std::uint32_t v : wall.vertices) out << v + 1 << "\n";
        for (const std::uint32_t v : wall.vertices) place(mesh.positions[v], out);
    }
    out << "$EndNodes\n$Elements\n"
        << walls.size() << " " << mesh.triangles.size() << " 1 " << mesh.triangles.size() << "\n";
    std::size_t element = 0;
    for (const Wall& wall : walls) {
        out << "2 " << wall.marker << " 2 " << wall.triangles.size() << "\n";
        for (const std::uint32_t t : wall.triangles) {
            out << ++element;
            corners(mesh, t, out);
        }
    }
    out << "$EndElements\n";
    out.finish();
}

} // namespace molsurf
