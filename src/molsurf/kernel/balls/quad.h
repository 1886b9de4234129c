// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Quadruple precision, for what doubles cannot decide.

#include "molsurf/kernel/balls/placed_ball.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace molsurf
{

using Quad = boost::multiprecision::cpp_bin_float_quad;

/// A vector of three numbers in quadruple precision.
struct QuadVector {
    Quad x, y, z;

    Quad dot(const QuadVector& o) const { return x * o.x + y * o.y + z * o.z; }
    QuadVector cross(const QuadVector& o) const
    {
        return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
    }
    QuadVector operator*(const Quad& s) const { return {x * s, y * s, z * s}; }
    QuadVector operator+(const QuadVector& o) const { return {x + o.x, y + o.y, z + o.z}; }
    QuadVector operator-(const QuadVector& o) const { return {x - o.x, y - o.y, z - o.z}; }
};

/// The plane of the circle in which two spheres meet, relative to the first centre. The second ball
/// covers the points of the first sphere with x.way > height.
struct QuadPlane {
    QuadVector way; ///< from the first centre to the second [Å], exact
    Quad height;    ///< [Å^2]
};

inline QuadPlane quadPlane(const PlacedBall& ball, const PlacedBall& other)
{
    const auto component = [&](std::size_t a) {
        return Quad(other.place[a] - ball.place[a]) * Quad(placeUnit);
    };
    QuadPlane plane{{component(0), component(1), component(2)}, 0};
    const Quad r(ball.radius), R(other.radius);
    plane.height = (plane.way.dot(plane.way) + (r - R) * (r + R)) / 2;
    return plane;
}

} // namespace molsurf
