// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Curves of places that touch one, two or three balls, and where they come to touch another one.

#include "molsurf/ball.h"

#include <openvdb/Types.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace molsurf
{

/// A curve of places x(d) whose clearance d grows along each of its two halves. In a frame at the
/// centre of the first ball it is x = fixed + grow d + side n sqrt(Q(d)), Q(d) = square d^2 +
/// 2 linear d + constant:
/// - of three balls a conic, as |x - c_i| = r_i + d are two linear equations in x and d, of the
///   plane of the centres, and a square one; n is normal to the plane, and Q = 0 is in it;
/// - of two balls a hyperbola in the plane of their line and a direction n away from it;
/// - of one ball a ray, with Q = 0.
class VoidCurve
{
public:
    /// Of three balls. None if their centres are on a line: d is the same all about it then.
    static std::optional<VoidCurve> ofThree(const Ball& a, const Ball& b, const Ball& c);
    /// Of two balls, through a place beside their line.
    static std::optional<VoidCurve> ofTwo(const Ball& a, const Ball& b, const openvdb::Vec3d& x);
    /// Of one ball, through a place beside its centre.
    static std::optional<VoidCurve> ofOne(const Ball& a, const openvdb::Vec3d& x);

    double square(double d) const { return (square_ * d + 2.0 * linear_) * d + constant_; }
    openvdb::Vec3d at(double d, int side) const
    {
        const double height = std::sqrt(std::max(square(d), 0.0));
        return origin_ + fixed_ + grow_ * d + normal_ * (side * height);
    }
    /// Where the halves meet, d being the least: a place in the plane of the balls [Å].
    double bottom() const { return bottom_; }
    /// Where they meet again, if it is an ellipse; else infinite [Å].
    double top() const { return top_; }
    const openvdb::Vec3d& normal() const { return normal_; }
    const openvdb::Vec3d& origin() const { return origin_; }

    /// A ball as the curve sees it: it is nearer than those of the curve where L(d) = constant +
    /// slope d + side height sqrt(Q(d)) is above 0, L being (d + r)^2 - |x - c|^2.
    struct Seen {
        double constant, slope, height;
    };
    Seen seen(const openvdb::Vec3d& centre, double radius) const
    {
        const openvdb::Vec3d way = centre - origin_;
        return {radius * radius - radius_ * radius_ - way.lengthSqr() + 2.0 * fixed_.dot(way),
                2.0 * (radius - radius_) + 2.0 * grow_.dot(way), 2.0 * normal_.dot(way)};
    }
    /// How L changes with d on a half, times a positive number.
    double turn(const Seen& ball, double d, int side) const
    {
        const double height = std::sqrt(std::max(square(d), 0.0));
        return 2.0 * height * ball.slope + side * ball.height * 2.0 * (square_ * d + linear_);
    }
    /// The places where L = 0, on any half: the roots of (constant + slope d)^2 = height^2 Q(d).
    /// @return not a number where there is none
    std::array<double, 2> roots(const Seen& ball) const;
    /// Whether a root is of a half.
    static bool isOn(const Seen& ball, double root, int side)
    {
        return (ball.constant + ball.slope * root) * ball.height * side <= 0.0;
    }

private:
    void findEnds();

    openvdb::Vec3d origin_{0.0}, fixed_{0.0}, grow_{0.0}, normal_{0.0};
    double radius_ = 0.0;                                 // of the first ball
    double square_ = 0.0, linear_ = 0.0, constant_ = 0.0; // of Q
    double bottom_ = 0.0, top_ = std::numeric_limits<double>::infinity();
};

} // namespace molsurf
