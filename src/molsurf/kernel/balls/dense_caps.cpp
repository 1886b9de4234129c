// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/dense_caps.h"

#include "molsurf/kernel/balls/ball_caps.h"
#include "molsurf/kernel/balls/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace molsurf
{

using openvdb::Vec3d;

/// A convex polyhedron about the centre of a ball, cut out by planes, with three of them at each
/// vertex. It never loses a point that belongs to it by more than `tolerance`, so a ball that it
/// finds beyond it is.
class PowerCell
{
public:
    /// Begins with a cube about the ball.
    /// @param[in] radius  of the ball [Å]
    explicit PowerCell(double radius);

    /// Cuts off the part where x.normal > height.
    /// @param[in] normal  a unit vector
    /// @param[in] height  [Å], from the centre of the ball
    void cut(const Vec3d& normal, double height);

    /// Whether a plane may cut something off the part of the sphere that lies in the polyhedron.
    bool reaches(const Vec3d& normal, double height) const;

    /// Whether a plane touches the polyhedron: one that has cut it and does not any more is not
    /// needed. (Of a face inside the ball, too: beyond it another part of the sphere may lie.)
    bool touches(const Vec3d& normal, double height) const;

    /// Whether the polyhedron lies within the ball, or is empty: no part of the sphere is left.
    bool isHidden() const { return outer_.empty(); }

    /// Points whose convex hull holds the part of the sphere that lies in the polyhedron: vertices
    /// outside of the sphere, and where edges go inside.
    const std::vector<Vec3d>& outerPoints() const { return outer_; }

    static constexpr double tolerance = 1e-9; ///< [Å]

private:
    struct Plane {
        Vec3d normal;
        double height;
    };
    struct Vertex {
        std::array<std::size_t, 3> planes; // ascending
        Vec3d x;
    };

    void findOuterPoints();

    double radius_;
    std::vector<Plane> planes_;
    std::vector<Vertex> vertices_, kept_;
    std::vector<Vec3d> outer_;
};

/// A cube about the sphere.
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

/// Keeps the part of the polyhedron with x . normal <= height.
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

/// The vertices outside the sphere, and the points where edges leave it.
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

DenseCaps::DenseCaps(const std::vector<PlacedBall>& balls) : balls_(balls)
{
    while (leaves_ * bucket < balls.size()) leaves_ *= 2;
    Box empty;
    empty.low.fill(std::numeric_limits<std::int64_t>::max());
    empty.high.fill(std::numeric_limits<std::int64_t>::min());
    empty.largest = 0.0;
    boxes_.assign(2 * leaves_, empty);
    const auto widen = [](Box& box, const Box& by) {
        for (std::size_t a = 0; a < 3; ++a) {
            box.low[a] = std::min(box.low[a], by.low[a]);
            box.high[a] = std::max(box.high[a], by.high[a]);
        }
        box.largest = std::max(box.largest, by.largest);
    };
    for (std::size_t i = 0; i < balls.size(); ++i)
        widen(boxes_[leaves_ + i / bucket], {balls[i].place, balls[i].place, balls[i].radius});
    for (std::size_t n = leaves_; n-- > 1;) {
        widen(boxes_[n], boxes_[2 * n]);
        widen(boxes_[n], boxes_[2 * n + 1]);
    }
}

double DenseCaps::powerFrom(const PlacedBall& ball, const Box& box) const
{
    if (box.low[0] > box.high[0]) return std::numeric_limits<double>::max();
    const molsurf::Box around{offset(ball, {box.low, 0.0, 0}), offset(ball, {box.high, 0.0, 0})};
    return around.squareTo(Vec3d(0.0)) - box.largest * box.largest;
}

bool DenseCaps::mayReach(const PlacedBall& ball, const Box& box, const PowerCell& cell) const
{
    // A ball cuts off the points whose power distance to it is less than to the cell's own ball.
    const Vec3d low = offset(ball, {box.low, 0.0, 0}), high = offset(ball, {box.high, 0.0, 0});
    const double farthest = (Vec3d(std::max(-low.x(), high.x()), std::max(-low.y(), high.y()),
                                   std::max(-low.z(), high.z())))
                                .length();
    const double room = box.largest * box.largest - ball.radius * ball.radius +
                        2.0 * PowerCell::tolerance * farthest;
    for (const Vec3d& x : cell.outerPoints()) {
        if (molsurf::Box{low, high}.squareTo(x) <= x.lengthSqr() + room) return true;
    }
    return false;
}

// Best-first search: boxes by their least power distance, since the first balls cut the cell most.
bool DenseCaps::find(std::int32_t i, std::vector<Cap>& found) const
{
    const PlacedBall& ball = balls_[std::size_t(i)];
    PowerCell cell(ball.radius);
    std::priority_queue<Waiting> waiting;
    waiting.push({powerFrom(ball, boxes_[1]), 1});
    found.clear();
    while (!waiting.empty()) {
        const Waiting next = waiting.top();
        waiting.pop();
        if (!mayReach(ball, boxes_[next.node], cell)) continue;
        if (next.node < leaves_) {
            for (const std::size_t child : {2 * next.node, 2 * next.node + 1}) {
                const double power = powerFrom(ball, boxes_[child]);
                if (power < std::numeric_limits<double>::max()) waiting.push({power, child});
            }
            continue;
        }
        const std::size_t begin = (next.node - leaves_) * bucket;
        for (std::size_t j = begin; j < std::min(begin + bucket, balls_.size()); ++j) {
            Cap cap;
            if (j == std::size_t(i)) continue;
            const Relation relation = relate(ball, balls_[j], std::int32_t(j), cap);
            if (relation == Relation::Around) return false;
            const double height = ball.radius * cap.cosine;
            if (relation == Relation::Apart || !cell.reaches(cap.axis, height)) continue;
            found.push_back(cap);
            cell.cut(cap.axis, height);
            if (cell.isHidden()) return false;
        }
    }
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const Cap& cap) {
                                   return !cell.touches(cap.axis, ball.radius * cap.cosine);
                               }),
                found.end());
    return true;
}

} // namespace molsurf
