// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Areas of triangles on the unit sphere.

#include <openvdb/Types.h>

#include <cmath>

namespace molsurf
{

/// The area of the triangle of three directions, of unit length, on the unit sphere: positive if
/// they run anticlockwise seen from outside (van Oosterom, Strackee, The solid angle of a plane
/// triangle, IEEE Trans. Biomed. Eng. 30(2):125-126, 1983).
inline double sphericalArea(const openvdb::Vec3d& a, const openvdb::Vec3d& b,
                            const openvdb::Vec3d& c)
{
    return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

} // namespace molsurf
