// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The room about points among balls, and where it is largest in a plane.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/ball_index.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace molsurf
{

/// A ball between others.
struct FittedBall {
    openvdb::Vec3d place; ///< its centre [Å]
    double radius;        ///< negative in balls [Å]
};

/// A plane with two directions in it, unit vectors at right angles to each other and to the normal.
struct Plane {
    openvdb::Vec3d origin, normal; ///< [Å], a unit vector
    std::array<openvdb::Vec3d, 2> along;

    Plane(const openvdb::Vec3d& point, const openvdb::Vec3d& unitNormal);
    openvdb::Vec3d at(double a, double b) const { return origin + along[0] * a + along[1] * b; }
};

/// The clearance of points: f(x) = min over balls of |x - c| - r, how large a ball about x may be.
/// Exact but for rounding. Immutable once made; safe to use from all threads.
class Clearance
{
public:
    /// @param[in] balls  at least one, every coordinate within 1e6 Å
    explicit Clearance(const std::vector<Ball>& balls);

    /// f(x) [Å].
    double at(const openvdb::Vec3d& x) const;

    /// The indices of the balls whose surface is at most f(x) + slack away from x, the nearest
    /// first, of equally near ones the lower index.
    std::vector<std::int32_t> nearest(const openvdb::Vec3d& x, double slack) const;

    /// The largest local maximum of f in a plane that is at most `reach` away from x. A ball there
    /// touches three others, from three sides, so all such triples are tried.
    /// @param[in] x  in the plane [Å]
    std::optional<FittedBall> widestIn(const Plane& plane, const openvdb::Vec3d& x,
                                       double reach) const;

    /// The nearest saddle of f that is a minimum along the way and a maximum across it, at most
    /// `reach` away from x: its ball touches three others, and its centre lies in the plane of
    /// theirs. With a clearance below `most`.
    std::optional<FittedBall> neckNear(const openvdb::Vec3d& x, double reach, double most) const;

private:
    double leastNear(const openvdb::Vec3d& x, const std::vector<std::int32_t>& balls) const;

    std::vector<Ball> balls_;
    BallIndex index_;
};

} // namespace molsurf
