// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The cell of a ball in the power diagram, where very many balls are near each other.

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <vector>

namespace molsurf
{

/// A convex polyhedron about the centre of a ball, cut out by planes, with three of them at each
/// vertex. It never loses a point that belongs to it by more than `tolerance`, so what it tells to
/// be beyond it is.
class PowerCell
{
public:
    /// Begins with a cube about the ball.
    /// @param[in] radius  of the ball [Å]
    explicit PowerCell(double radius);

    /// Cuts off the part where x.normal > height.
    /// @param[in] normal  a unit vector
    /// @param[in] height  [Å], from the centre of the ball
    void cut(const openvdb::Vec3d& normal, double height);

    /// Whether a plane may cut something off the part of the sphere that lies in the polyhedron.
    bool reaches(const openvdb::Vec3d& normal, double height) const;

    /// Whether a plane touches the polyhedron: one that has cut it and does not any more is not
    /// needed. (Of a face inside the ball, too: beyond it another part of the sphere may lie.)
    bool touches(const openvdb::Vec3d& normal, double height) const;

    /// Whether the polyhedron lies within the ball, or is empty: no part of the sphere is left.
    bool isHidden() const { return outer_.empty(); }

    /// Points whose convex hull holds the part of the sphere that lies in the polyhedron: vertices
    /// outside of the sphere, and where edges go inside.
    const std::vector<openvdb::Vec3d>& outerPoints() const { return outer_; }

    static constexpr double tolerance = 1e-9; ///< [Å]

private:
    struct Plane {
        openvdb::Vec3d normal;
        double height;
    };
    struct Vertex {
        std::array<std::size_t, 3> planes; // ascending
        openvdb::Vec3d x;
    };

    void findOuterPoints();

    double radius_;
    std::vector<Plane> planes_;
    std::vector<Vertex> vertices_, kept_;
    std::vector<openvdb::Vec3d> outer_;
};

} // namespace molsurf
