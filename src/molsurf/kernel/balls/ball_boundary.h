// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The boundary of a union of balls: patches of spheres, arcs where two spheres meet, vertices
/// where three do (the contact, re-entrant and saddle parts of Connolly, Analytical molecular
/// surface calculation, J. Appl. Cryst. 16:548-558, 1983, are the points at a probe radius from
/// them).

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/placed_ball.h"
#include "molsurf/kernel/core/simd.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace molsurf
{

/// A part of a sphere that lies in another ball: the directions u with u.axis > cosine.
struct Cap {
    openvdb::Vec3d axis; ///< unit vector to the other ball
    double cosine;       ///< in (-1, 1)
    std::int32_t other;  ///< place of the other ball in BallBoundary::balls
};

/// Caps of spheres as floats, a list for each number. Eight can be read at any place.
struct CapLists {
    std::vector<float> x, y, z; ///< of the axis; each list has room for eight more at the end
    std::vector<float> cosine, sine;

    CapLists() { resize(0); }
    int size() const { return count_; }
    void clear() { resize(0); }
    /// Keeps the first ones; what follows them covers nothing. Gives no memory back.
    void resize(std::size_t count);
    void add(float ax, float ay, float az, float capCosine, float capSine);
    void set(std::size_t i, const Cap& cap);

private:
    int count_ = 0;
};

/// A sphere with a part that no other ball covers.
struct Patch {
    openvdb::Vec3d centre;
    double radius;
    std::int32_t ball;                ///< place in BallBoundary::balls
    std::int32_t component;           ///< the part of the union that hangs together, from 0;
                                      ///< -1: not known, as BallBoundary::components
    std::uint32_t capsBegin, capsEnd; ///< its caps: the covered part, hardly any cap within another
    std::uint32_t arcsBegin, arcsEnd; ///< with later balls
    std::uint32_t cornersBegin, cornersEnd; ///< with two later balls
};

/// A part of the circle of two spheres that no third ball covers: the points centre + radius u with
/// u a unit vector, u.axis = 0 and the angle between u and middle at most half.
struct Arc {
    openvdb::Vec3d centre;
    double radius;
    openvdb::Vec3d axis;   ///< unit vector from the first ball to the second
    openvdb::Vec3d middle; ///< unit vector to the middle of the arc
    double half;           ///< half its angle, in (0, pi]
    std::int32_t balls[2]; ///< places in BallBoundary::balls, ascending
    std::int32_t ends[2];  ///< balls that cover the circle before and after it; -1: a whole circle

    /// The direction of an end from the centre: 0 the first, 1 the last about the axis.
    openvdb::Vec3d end(int which) const;
};

/// A point of three spheres, as it is told from three balls: there are two such points, one on
/// either side of the plane of the centres.
struct CornerName {
    std::int32_t balls[3]; ///< ascending
    bool above;            ///< on the side of (c_1 - c_0) x (c_2 - c_0)

    bool operator<(const CornerName& o) const
    {
        for (int k = 0; k < 3; ++k) {
            if (balls[k] != o.balls[k]) return balls[k] < o.balls[k];
        }
        return above < o.above;
    }
    bool operator==(const CornerName& o) const { return !(*this < o) && !(o < *this); }
};

/// The corner at an end of an arc, which is no whole circle: the same from all three arcs there.
CornerName cornerAt(const Arc& arc, int which);

/// A point of three spheres that no fourth ball covers.
struct Corner {
    openvdb::Vec3d position;
    std::int32_t balls[3]; ///< places in BallBoundary::balls, ascending
};

/// Everything that a point of the boundary can lie on. Lengths in Å.
struct BallBoundary {
    std::vector<PlacedBall> balls; ///< whose boundary this is
    std::vector<Patch> patches;    ///< in ascending order of the balls
    CapLists caps;
    std::vector<std::int32_t> capOthers; ///< of each cap the other ball, its place in `balls`
    std::vector<Arc> arcs;
    std::vector<Corner> corners;
    /// Parts of the union that hang together, from overlaps; none where very many balls are near
    /// each other.
    std::optional<std::size_t> components;
};

/// Finds the boundary of the union of the balls of radius r_i + probe. Balls within another one,
/// and all but the first of equal ones, have no part in it.
///
/// It is that of the balls of placedBalls(), in general position: whether a circle is covered, and
/// in what order balls cover it, is decided for these without error, in quadruple precision where
/// doubles cannot tell. So three arcs end in each corner, whatever the balls. Their own order does
/// not matter.
///
/// @param[in] balls  every coordinate within 1e6 Å, radii > 0, both finite
/// @param[in] probe  added to every radius [Å]
/// @throws Error(ErrorKind::Check) if the parts do not fit together
BallBoundary ballBoundary(const std::vector<Ball>& balls, double probe, const Progress& progress);

/// Whether another ball covers the point of a sphere in a direction, with the rounding of floats.
inline bool isCovered(const BallBoundary& boundary, const Patch& patch,
                      const openvdb::Vec3d& direction)
{
    const CapLists& caps = boundary.caps;
    for (std::uint32_t k = patch.capsBegin; k < patch.capsEnd; ++k) {
        if (caps.x[k] * direction.x() + caps.y[k] * direction.y() + caps.z[k] * direction.z() >
            caps.cosine[k])
            return true;
    }
    return false;
}

/// Whether two caps of a sphere have a point in common, decided as in ballBoundary().
bool capsOverlap(const BallBoundary& boundary, const Patch& patch, const Cap& a, const Cap& b);

} // namespace molsurf
