// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The rigid motion that lays points on others.

#include "molsurf/ball.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// A rigid motion of points, and how well it lays some of them on others.
struct Superposition : Motion {
    std::size_t pairs = 0; ///< of points
    double rmsd = 0.0;     ///< root mean square distance of the pairs [Å]
};

/// The rotation and shift of the least root mean square distance, without a mirror image: the
/// eigenvector of the largest eigenvalue of Horn's 4 x 4 matrix is the quaternion of the rotation
/// (B. K. P. Horn, J. Opt. Soc. Am. A 4, 629, 1987).
/// @param[in] onto  as many as `points`
/// @return nullopt: fewer than three pairs, or points on one line, so that the rotation is not
///         determined
std::optional<Superposition> superposition(const std::vector<openvdb::Vec3d>& points,
                                           const std::vector<openvdb::Vec3d>& onto);

} // namespace molsurf
