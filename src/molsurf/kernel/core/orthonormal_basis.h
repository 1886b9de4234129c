// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Directions at right angles.

#include <openvdb/Types.h>

#include <array>
#include <cmath>

namespace molsurf
{

/// Two unit vectors at right angles to a unit vector and to each other; the second is the cross
/// product of the given one and the first.
inline std::array<openvdb::Vec3d, 2> perpendicular(const openvdb::Vec3d& axis)
{
    openvdb::Vec3d first =
        axis.cross(std::abs(axis.x()) < 0.6 ? openvdb::Vec3d(1, 0, 0) : openvdb::Vec3d(0, 1, 0));
    first.normalize();
    return {first, axis.cross(first)};
}

} // namespace molsurf
