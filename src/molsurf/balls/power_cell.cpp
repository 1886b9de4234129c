// SPDX-License-Identifier: MPL-2.0
#include "molsurf/balls/power_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

PowerCell::PowerCell(double radius) : radius_(radius)
{
    const double half = 1.01 * radius;
    for (int a = 0; a < 3; ++a) {
        for (const double sign : {-1.0, 1.0}) {
            Vec3d normal(0.0);
            normal[a] = sign;
            planes_.push_back({normal, half});
        }
    }
    for (std::size_t k = 0; k < 8; ++k) {
        const std::size_t x = k & 1, y = k >> 1 & 1, z = k >> 2;
        vertices_.push_back(
            {{x, 2 + y, 4 + z}, half * Vec3d(x ? 1.0 : -1.0, y ? 1.0 : -1.0, z ? 1.0 : -1.0)});
    }
    findOuterPoints();
}

bool PowerCell::reaches(const Vec3d& normal, double height) const
{
    return std::any_of(outer_.begin(), outer_.end(),
                       [&](const Vec3d& x) { return x.dot(normal) > height - tolerance; });
}

bool PowerCell::touches(const Vec3d& normal, double height) const
{
    return std::any_of(vertices_.begin(), vertices_.end(),
                       [&](const Vertex& v) { return v.x.dot(normal) > height - tolerance; });
}

void PowerCell::cut(const Vec3d& normal, double height)
{
    // An edge, two planes, has two vertices: those met once among what goes are cut.
    using Edge = std::pair<std::size_t, std::size_t>;
    std::vector<Edge> open;
    kept_.clear();
    for (const Vertex& v : vertices_) {
        if (v.x.dot(normal) <= height + tolerance) {
            kept_.push_back(v);
            continue;
        }
        for (const Edge& edge : {Edge(v.planes[0], v.planes[1]), Edge(v.planes[0], v.planes[2]),
                                 Edge(v.planes[1], v.planes[2])}) {
            const auto found = std::find(open.begin(), open.end(), edge);
            if (found == open.end()) {
                open.push_back(edge);
            } else {
                *found = open.back();
                open.pop_back();
            }
        }
    }
    if (kept_.size() == vertices_.size()) return;
    const std::size_t added = planes_.size();
    for (const Edge& edge : open) {
        const Plane &p = planes_[edge.first], &q = planes_[edge.second];
        const Vec3d along = p.normal.cross(q.normal);
        const double det = along.dot(normal);
        constexpr double flat = 1e-9;
        // Planes this flat to each other meet nowhere to be trusted: the cell stays larger.
        if (std::abs(det) < flat) return;
        kept_.push_back({{edge.first, edge.second, added},
                         (p.height * q.normal.cross(normal) + q.height * normal.cross(p.normal) +
                          height * along) /
                             det});
    }
    planes_.push_back({normal, height});
    vertices_.swap(kept_);
    findOuterPoints();
}

void PowerCell::findOuterPoints()
{
    // Let s be a point of the sphere in the polyhedron. Beyond the plane that touches the sphere in
    // s all is outside, so the part of the polyhedron there has outer vertices and points of edges
    // outside alone; s is one of its points.
    const double radius = radius_ - tolerance;
    outer_.clear();
    for (const Vertex& v : vertices_) {
        if (v.x.lengthSqr() < radius * radius) continue;
        outer_.push_back(v.x);
        for (const Vertex& u : vertices_) {
            if (u.x.lengthSqr() >= radius * radius) continue;
            int common = 0;
            for (const std::size_t plane : u.planes)
                common += std::count(v.planes.begin(), v.planes.end(), plane) != 0;
            if (common < 2) continue;
            // |u + t (v - u)| = radius
            const Vec3d along = v.x - u.x;
            const double a = along.lengthSqr(), b = u.x.dot(along);
            const double c = u.x.lengthSqr() - radius * radius;
            outer_.push_back(u.x + (std::sqrt(b * b - a * c) - b) / a * along);
        }
    }
}

} // namespace molsurf
