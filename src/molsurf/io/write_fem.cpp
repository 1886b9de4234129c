// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_fem.h"

#include "molsurf/error.h"
#include "molsurf/io/output_buffer.h"
#include "molsurf/mesh/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// The triangles of a mesh by the wall that they belong to.
struct Walls {
    std::vector<std::vector<std::uint32_t>> triangles; ///< of marker 1, 2, ...

    std::size_t count() const { return triangles.size(); }
    static std::string nameOf(std::size_t wall)
    {
        return wall == 0 ? "outer wall" : "cavity " + std::to_string(wall);
    }
};

Walls wallsOf(const Mesh& mesh)
{
    const Progress nobody;
    const MeshPieces pieces = piecesOf(mesh, nobody);
    std::vector<std::size_t> cavities;
    for (std::size_t p = 0; p < pieces.measures.size(); ++p)
        if (pieces.measures[p].volume < 0.0) cavities.push_back(p);
    std::stable_sort(cavities.begin(), cavities.end(), [&](std::size_t a, std::size_t b) {
        return pieces.measures[a].volume < pieces.measures[b].volume;
    });
    std::vector<std::size_t> wallOf(pieces.measures.size(), 0);
    for (std::size_t n = 0; n < cavities.size(); ++n) wallOf[cavities[n]] = n + 1;
    Walls out;
    out.triangles.resize(cavities.size() + 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        out.triangles[wallOf[pieces.of[mesh.triangles[t][0]]]].push_back(std::uint32_t(t));
    return out;
}

/// A triangle with its corners in double precision.
struct Corners {
    Vec3d a, b, c;

    Corners(const Mesh& mesh, std::uint32_t triangle)
        : a(mesh.positions[mesh.triangles[triangle][0]]),
          b(mesh.positions[mesh.triangles[triangle][1]]),
          c(mesh.positions[mesh.triangles[triangle][2]])
    {
    }
    Vec3d normal() const { return (b - a).cross(c - a); } ///< twice the area long
    Vec3d middle() const { return (a + b + c) / 3.0; }

    /// How far along a ray it is hit; infinity: it is not.
    double hit(const Vec3d& from, const Vec3d& along) const
    {
        constexpr double none = std::numeric_limits<double>::infinity();
        const Vec3d u = b - a, v = c - a, w = from - a, across = along.cross(v);
        const double volume = u.dot(across);
        if (volume == 0.0) return none;
        const double s = w.dot(across) / volume, t = along.dot(w.cross(u)) / volume;
        if (s < 0.0 || t < 0.0 || s + t > 1.0) return none;
        return v.dot(w.cross(u)) / volume;
    }
};

/// A point in the void that a wall encloses: halfway from the middle of one of its triangles to
/// what lies opposite, the one of the few largest triangles for which that is farthest.
Vec3d pointInside(const Mesh& mesh, const std::vector<std::uint32_t>& wall)
{
    constexpr std::size_t tries = 8;
    constexpr double least = 1e-6; // of a hit, so that the triangle itself is none [Å]
    std::vector<std::uint32_t> large = wall;
    const auto some = large.begin() + std::ptrdiff_t(std::min(tries, large.size()));
    std::partial_sort(large.begin(), some, large.end(), [&](std::uint32_t a, std::uint32_t b) {
        return Corners(mesh, a).normal().lengthSqr() > Corners(mesh, b).normal().lengthSqr();
    });
    Vec3d best(Corners(mesh, large[0]).middle());
    double farthest = 0.0;
    for (auto one = large.begin(); one != some; ++one) {
        const Corners corners(mesh, *one);
        const Vec3d along = corners.normal().unit(), from = corners.middle();
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const double at = t == *one ? -1.0 : Corners(mesh, t).hit(from, along);
            if (at > least) nearest = std::min(nearest, at);
        }
        if (!std::isfinite(nearest) || nearest <= farthest) continue;
        farthest = nearest;
        best = from + 0.5 * nearest * along;
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

void groups(const Walls& walls, TextOutput& out)
{
    out << "$PhysicalNames\n" << walls.count() << "\n";
    for (std::size_t n = 0; n < walls.count(); ++n)
        out << "2 " << n + 1 << " \"" << Walls::nameOf(n) << "\"\n";
    out << "$EndPhysicalNames\n";
}

} // namespace

void writePoly(const Mesh& mesh, OutputFile& file)
{
    const Walls walls = wallsOf(mesh);
    TextOutput out(file);
    out << "# vdb_molsurf: markers 1 outer walls, 2 and on cavities [A]\n"
        << mesh.positions.size() << " 3 0 0\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        out << v + 1 << " ";
        place(mesh.positions[v], out);
    }
    out << mesh.triangles.size() << " 1\n";
    for (std::size_t n = 0; n < walls.count(); ++n)
        for (const std::uint32_t t : walls.triangles[n]) {
            out << "1 0 " << n + 1 << "\n3";
            corners(mesh, t, out);
        }
    out << walls.count() - 1 << "\n";
    for (std::size_t n = 1; n < walls.count(); ++n) {
        const Vec3d x = pointInside(mesh, walls.triangles[n]);
        out << n << " " << x[0] << " " << x[1] << " " << x[2] << "\n";
    }
    out << "0\n";
    out.finish();
}

void writeMsh2(const Mesh& mesh, OutputFile& file)
{
    const Walls walls = wallsOf(mesh);
    TextOutput out(file);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    groups(walls, out);
    out << "$Nodes\n" << mesh.positions.size() << "\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        out << v + 1 << " ";
        place(mesh.positions[v], out);
    }
    out << "$EndNodes\n$Elements\n" << mesh.triangles.size() << "\n";
    std::size_t element = 0;
    for (std::size_t n = 0; n < walls.count(); ++n)
        for (const std::uint32_t t : walls.triangles[n]) {
            out << ++element << " 2 2 " << n + 1 << " " << n + 1;
            corners(mesh, t, out);
        }
    out << "$EndElements\n";
    out.finish();
}

void writeMsh4(const Mesh& mesh, OutputFile& file)
{
    const Walls walls = wallsOf(mesh);
    TextOutput out(file);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    groups(walls, out);
    out << "$Entities\n0 0 " << walls.count() << " 0\n";
    std::vector<std::size_t> wallOf(mesh.positions.size(), 0);
    std::vector<std::size_t> nodes(walls.count(), 0);
    for (std::size_t n = 0; n < walls.count(); ++n) {
        openvdb::BBoxd box;
        for (const std::uint32_t t : walls.triangles[n])
            for (const std::uint32_t v : mesh.triangles[t]) {
                wallOf[v] = n;
                box.expand(Vec3d(mesh.positions[v]));
            }
        out << n + 1;
        for (const Vec3d& corner : {box.min(), box.max()})
            out << " " << corner[0] << " " << corner[1] << " " << corner[2];
        out << " 1 " << n + 1 << " 0\n";
    }
    for (const std::size_t n : wallOf) ++nodes[n];
    out << "$EndEntities\n$Nodes\n"
        << walls.count() << " " << mesh.positions.size() << " 1 " << mesh.positions.size() << "\n";
    for (std::size_t n = 0; n < walls.count(); ++n) {
        out << "2 " << n + 1 << " 0 " << nodes[n] << "\n";
        for (std::size_t v = 0; v < wallOf.size(); ++v)
            if (wallOf[v] == n) out << v + 1 << "\n";
        for (std::size_t v = 0; v < wallOf.size(); ++v)
            if (wallOf[v] == n) place(mesh.positions[v], out);
    }
    out << "$EndNodes\n$Elements\n"
        << walls.count() << " " << mesh.triangles.size() << " 1 " << mesh.triangles.size() << "\n";
    std::size_t element = 0;
    for (std::size_t n = 0; n < walls.count(); ++n) {
        out << "2 " << n + 1 << " 2 " << walls.triangles[n].size() << "\n";
        for (const std::uint32_t t : walls.triangles[n]) {
            out << ++element;
            corners(mesh, t, out);
        }
    }
    out << "$EndElements\n";
    out.finish();
}

} // namespace molsurf
