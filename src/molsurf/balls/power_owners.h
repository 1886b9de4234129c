// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Balls that are shared out among owners, and the parts of space that owners have.

#include "molsurf/ball.h"
#include "molsurf/balls/ball_index.h"

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

/// Balls that are shared out among owners: a point of space belongs to the owner of the ball whose
/// power distance to it is the least. Where two owners meet, the border is plane by plane.
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

private:
    BallIndex index_;
    std::vector<std::int32_t> ownerOf_;
    double leastRadius_;
};

} // namespace molsurf
