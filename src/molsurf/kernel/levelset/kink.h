// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Tells the kinks of a distance: places where it turns because two sheets of the surface are
/// equally near, and not because the surface is curved.

#include <openvdb/math/Vec3.h>

#include <algorithm>

namespace molsurf
{

/// Least spread of the directions to the surface beside a kink: the chord of 20 degrees.
constexpr float kinkSpread = 0.35f;

/// Tells whether the distance has a kink between two voxels on one side of its surface. With the
/// closest points y, y' and the unit vectors m, m' toward the surface there, a ball of radius r
/// that touches the surface at both points has m' - m = (y' - y)/r. A smooth piece of the surface
/// between the points has m' - m = k (y' - y), k being its curvature along y' - y; it explains the
/// spread. There is a kink if half of kinkSpread is left unexplained.
///
/// @param[in] chord      y' - y, in any unit
/// @param[in] spread     m' - m, at least kinkSpread
/// @param[in] curvature  k, positive where the surface bends toward the voxels, in 1 / that unit
inline bool isKink(const openvdb::Vec3f& chord, const openvdb::Vec3f& spread, float curvature)
{
    constexpr float least = 0.5f * kinkSpread;
    const float length2 = chord.lengthSqr();
    const float unexplained = spread.dot(chord) - std::max(curvature, 0.0f) * length2;
    return unexplained > 0.0f && unexplained * unexplained > least * least * length2;
}

} // namespace molsurf
