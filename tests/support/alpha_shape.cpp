// SPDX-License-Identifier: MPL-2.0
#include "support/alpha_shape.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>

namespace molsurf::test
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Fixed_alpha_shape_vertex_base_3<Kernel,
                                          CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase =
    CGAL::Fixed_alpha_shape_cell_base_3<Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Simplices = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Shape = CGAL::Fixed_alpha_shape_3<CGAL::Regular_triangulation_3<Kernel, Simplices>>;

} // namespace

int eulerOfUnion(const std::vector<Ball>& balls, double probe)
{
    std::vector<Kernel::Weighted_point_3> points;
    for (const Ball& ball : balls) {
        const double R = double(ball.radius) + probe;
        points.emplace_back(Kernel::Point_3(ball.center.x(), ball.center.y(), ball.center.z()),
                            R * R);
    }
    Shape shape(points.begin(), points.end(), 0.0);
    int euler = 0;
    const auto count = [&](const auto& simplex, int sign) {
        if (shape.classify(simplex) != Shape::EXTERIOR) euler += sign;
    };
    for (auto i = shape.finite_vertices_begin(); i != shape.finite_vertices_end(); ++i) count(i, 1);
    for (auto i = shape.finite_edges_begin(); i != shape.finite_edges_end(); ++i) count(*i, -1);
    for (auto i = shape.finite_facets_begin(); i != shape.finite_facets_end(); ++i) count(*i, 1);
    for (auto i = shape.finite_cells_begin(); i != shape.finite_cells_end(); ++i) count(i, -1);
    return 2 * euler;
}

} // namespace molsurf::test
