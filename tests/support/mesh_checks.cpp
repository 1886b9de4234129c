// SPDX-License-Identifier: MPL-2.0
#include "support/mesh_checks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>

#include <fstream>
#include <ostream>

namespace molsurf::test
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

MeshVerdict judge(const Mesh& mesh, bool intersections)
{
    MeshVerdict verdict;
    std::vector<Kernel::Point_3> points;
    for (const auto& p : mesh.positions) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<std::vector<std::size_t>> polygons;
    for (const auto& t : mesh.triangles) polygons.push_back({t[0], t[1], t[2]});

    verdict.polygonMesh = PMP::is_polygon_soup_a_polygon_mesh(polygons);
    if (!verdict.polygonMesh) return verdict;
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points, polygons, surface);
    verdict.valid = CGAL::is_valid_polygon_mesh(surface);
    verdict.closed = CGAL::is_closed(surface);
    verdict.euler = long(surface.number_of_vertices()) - long(surface.number_of_edges()) +
                    long(surface.number_of_faces());
    for (const auto face : surface.faces())
        verdict.degenerate += PMP::is_degenerate_triangle_face(face, surface);
    if (!verdict.closed) return verdict;
    verdict.volume = CGAL::to_double(PMP::volume(surface));
    if (intersections) {
        std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
        PMP::self_intersections(surface, std::back_inserter(pairs));
        verdict.selfIntersections = pairs.size();
    }
    // does_bound_a_volume() asks for coherent normals, in or out, of a mesh that does not cut
    // itself.
    verdict.outward = verdict.volume > 0.0;
    if (verdict.selfIntersections == 0 && verdict.degenerate == 0)
        verdict.outward = verdict.outward && PMP::does_bound_a_volume(surface);
    return verdict;
}

Mesh readPly(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    CGAL::IO::set_binary_mode(file);
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    if (!CGAL::IO::read_PLY(file, points, polygons))
        throw std::runtime_error("cannot read " + path);
    Mesh mesh;
    for (const auto& p : points) mesh.positions.emplace_back(p.x(), p.y(), p.z());
    for (const auto& t : polygons) {
        if (t.size() != 3) throw std::runtime_error(path + ": a polygon is no triangle");
        mesh.triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
    }
    return mesh;
}

std::ostream& operator<<(std::ostream& out, const MeshVerdict& v)
{
    const auto yesNo = [](bool b) { return b ? "yes" : "NO"; };
    return out << "2-manifold " << yesNo(v.polygonMesh) << ", valid " << yesNo(v.valid)
               << ", closed " << yesNo(v.closed) << ", bounds a volume " << yesNo(v.outward)
               << ", degenerate triangles " << v.degenerate << ", self-intersections "
               << v.selfIntersections << ", Euler number " << v.euler;
}

} // namespace molsurf::test
