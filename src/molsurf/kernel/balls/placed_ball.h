// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Balls in general position: no four spheres meet in a point, no two touch.

#include "molsurf/ball.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Unit of the places [Å]: balls within 2000 Å of each other have offsets that a double holds.
constexpr double placeUnit = 0x1p-42;

/// The centre of a ball is moved by at most this along each axis [Å].
constexpr double mostMoved = 0x1p-31;

/// Every radius becomes smaller by this [Å]. It is more than two centres can approach each other by
/// their moves, so balls that touch in a point are apart.
constexpr double shrinkage = 0x1p-29;

/// A ball of a union, moved a little.
struct PlacedBall {
    std::array<std::int64_t, 3> place; ///< centre, in units of 2^-42 Å
    double radius;                     ///< of the grown ball, less the shrinkage [Å]
    std::int32_t index;                ///< in the caller's vector

    openvdb::Vec3d centre() const
    {
        return openvdb::Vec3d(double(place[0]), double(place[1]), double(place[2])) * placeUnit;
    }
};

/// From the centre of one ball to that of another one [Å]: exact within 2000 Å.
inline openvdb::Vec3d offset(const PlacedBall& from, const PlacedBall& to)
{
    return openvdb::Vec3d(double(to.place[0] - from.place[0]), double(to.place[1] - from.place[1]),
                          double(to.place[2] - from.place[2])) *
           placeUnit;
}

/// The balls of radius r_i + probe, each moved by an amount that depends on its own place and
/// radius alone, in an order that depends on these alone: along a Z-order curve. Of equal balls the
/// first is kept.
///
/// Symmetric and lattice-like molecules have four and more spheres through one point. Moved, they
/// have none but by a chance of 2^-12 for each such point, to first order; another salt moves them
/// otherwise. The area A of a union of balls changes by at most (2/r A + 2 L) times what the balls
/// are moved, L being the length of its creases, and its volume by A times that.
///
/// @param[in] balls  every coordinate within 1e6 Å
std::vector<PlacedBall> placedBalls(const std::vector<Ball>& balls, double probe,
                                    std::uint64_t salt = 0);

/// The indices of balls in an order that depends on their places and radii, not on their own order
/// (but for equal balls): along a Z-order curve, so that neighbours are near each other.
std::vector<std::int32_t> spatialOrder(const std::vector<Ball>& balls);

/// Values of balls in spatial order, put into that of the caller.
/// @param[in] values  one a ball, or none
/// @param[in] order   of spatialOrder()
std::vector<double> inCallersOrder(const std::vector<double>& values,
                                   const std::vector<std::int32_t>& order);

} // namespace molsurf
