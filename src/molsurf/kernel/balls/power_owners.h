// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Balls that are shared out among owners, and the parts of space that owners have.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The least power distance |x - c|^2 - r^2 of a point to the balls of an owner [Å^2].
struct OwnersPower {
    std::int32_t owner = -1;    ///< -1: none is near
    double power = 1e6;         ///< [Å^2]
    openvdb::Vec3d centre{0.0}; ///< c of the ball that has it [Å]
};

/// How much more power an owner has than another one, with the gradient of that.
struct PowerExcess {
    double value;         ///< [Å^2]
    openvdb::Vec3d slope; ///< [Å]
    std::int32_t other;   ///< the other one; -1: none is near
};

/// Balls that are shared out among owners: a point of space belongs to the owner of the ball whose
/// power distance to it is the least. Where two owners meet, the border is plane by plane.
///
/// This is the rule of whose a point of a surface is wherever a mesh is cut: borders of colours in
/// pictures and mesh files, and the border of a unit. Balls are those that the surface is of, grown
/// by the probe for a union. Attributes and sums that nothing is cut by (labels of vertices and
/// voxels, colours that run smoothly, areas by atom) belong to the ball whose own surface is
/// nearest (kernel/balls/nearest_ball.h), or in closed form to the ball whose patch it is.
///
/// Immutable once made; safe to use from all threads.
class PowerOwners
{
public:
    /// @param[in] balls    every coordinate within 1e6 Å
    /// @param[in] ownerOf  of each ball, >= 0
    PowerOwners(const std::vector<Ball>& balls, std::vector<std::int32_t> ownerOf);

    /// The owners near a point, those first whose power is less; of equal ones the lower number.
    /// Owners whose power is above that of the first by more than `slack` may be left out.
    /// @param[in]  x     [Å]; within 30 Å of a ball
    /// @param[out] near  at least one entry, if a ball is within 30 Å
    void at(const openvdb::Vec3d& x, double slack, std::vector<OwnersPower>& near) const;

    /// The excess of one owner over another one, or over the strongest other one if that is -1; at
    /// most 16 Å^2 either way, where the slope is 0.
    /// @param[out] near  room to compute in
    PowerExcess excess(const openvdb::Vec3d& x, std::int32_t owner, std::int32_t other,
                       std::vector<OwnersPower>& near) const;

    /// The owner of each of some points, which lie within 30 Å of a ball.
    std::vector<std::int32_t> ownersOf(const std::vector<openvdb::Vec3f>& points,
                                       const Progress& progress) const;

private:
    BallIndex index_;
    std::vector<std::int32_t> ownerOf_;
    double leastRadius_;
};

} // namespace molsurf
