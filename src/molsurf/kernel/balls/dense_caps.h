// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Caps where very many balls are near each other, by the cells of their power diagram.

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/placed_ball.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

class PowerCell;

/// Balls in a binary tree of boxes. Immutable once made; safe to use from all threads.
class DenseCaps
{
public:
    /// @param[in] balls  from placedBalls(), in their order; kept by reference
    explicit DenseCaps(const std::vector<PlacedBall>& balls);

    /// The caps of a ball that take part in the cell of its power diagram, and perhaps some more.
    /// Balls of about the same size in one place take n log n steps in all.
    /// @return false if the ball lies within others
    bool find(std::int32_t i, std::vector<Cap>& found) const;

private:
    static constexpr std::size_t bucket = 8; // balls in a leaf
    struct Box {
        std::array<std::int64_t, 3> low, high; ///< of centres; empty where low is above high
        double largest;                        ///< radius [Å]
    };
    /// A box that waits for the search.
    struct Waiting {
        double power; ///< the least power distance of its balls from the centre, at least [Å^2]
        std::size_t node;
        bool operator<(const Waiting& o) const { return power > o.power; } // the least on top
    };

    double powerFrom(const PlacedBall& ball, const Box& box) const;
    bool mayReach(const PlacedBall& ball, const Box& box, const PowerCell& cell) const;

    const std::vector<PlacedBall>& balls_;
    std::size_t leaves_ = 1; // a power of 2
    std::vector<Box> boxes_; // node n has 2 n and 2 n + 1 below it; the root is 1
};

} // namespace molsurf
