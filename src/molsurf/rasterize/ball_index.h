// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which balls are near a box: a cell list, hashed by columns of cells.

#include "molsurf/selection/ball.h"

#include <openvdb/Types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The largest radius [Å]; 0 if there are no balls.
inline float largestRadius(const std::vector<Ball>& balls)
{
    float largest = 0.0f;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    return largest;
}

/// Balls by the cubic cell of their centres. Immutable once made; safe to read from all threads.
class BallIndex
{
public:
    /// @param[in] balls  every coordinate within 1e6 Å
    /// @param[in] cell   edge of a cell [Å], at least 1
    BallIndex(const std::vector<Ball>& balls, double cell);

    /// Calls f(ball, i), i the ball's index in the vector, for the balls whose centres may lie
    /// within `reach` of the box [low, high] [Å]: all that do, and some that do not. In an order
    /// that depends on the balls alone.
    template<typename F>
    void forEachNear(const openvdb::Vec3d& low, const openvdb::Vec3d& high, double reach,
                     const F& f) const
    {
        const openvdb::Coord from = cellOf(low - openvdb::Vec3d(reach));
        const openvdb::Coord to = cellOf(high + openvdb::Vec3d(reach));
        for (int x = from.x(); x <= to.x(); ++x) {
            for (int y = from.y(); y <= to.y(); ++y) {
                for (int block = from.z() >> blockBits; block <= to.z() >> blockBits; ++block) {
                    const Column& c = columns_[position(columnKey(x, y, block))];
                    const int first = std::max(from.z() - c.z, 0);
                    const int last = std::min(to.z() - c.z, c.cells - 1);
                    if (first > last) continue;
                    const std::int32_t end = begins_[c.cell + last + 1];
                    for (std::int32_t i = begins_[c.cell + first]; i < end; ++i)
                        f(balls_[i], order_[i]);
                }
            }
        }
    }

private:
    /// Cells above each other, from the first that has a ball to the last in a block of 32: a
    /// shell is hollow, and cells without balls take memory too.
    struct Column {
        std::uint64_t key;
        std::int64_t cell; // of the first cell in begins_
        int z;             // of the first cell
        int cells;         // 0 where the table has no column
    };
    openvdb::Coord cellOf(const openvdb::Vec3d& x) const
    {
        return openvdb::Coord::floor(x / cell_);
    }
    static constexpr int blockBits = 5;
    static std::uint64_t columnKey(int x, int y, int block)
    {
        constexpr std::uint64_t mask = (1 << 21) - 1;
        return (std::uint64_t(x) & mask) << 42 | (std::uint64_t(y) & mask) << 21 |
               (std::uint64_t(block) & mask);
    }
    /// The place of a column in the table, or the free one where it would stand.
    std::size_t position(std::uint64_t key) const
    {
        // Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4), all bits folded down.
        const std::uint64_t hash = key * 0x9e3779b97f4a7c15ull;
        std::size_t i = (hash ^ hash >> 32) & (columns_.size() - 1);
        while (columns_[i].cells != 0 && columns_[i].key != key)
            i = (i + 1) & (columns_.size() - 1);
        return i;
    }

    double cell_;
    std::vector<Ball> balls_;          // cell by cell
    std::vector<std::int32_t> order_;  // their indices in the caller's vector
    std::vector<std::int32_t> begins_; // first ball of each cell of each column, and the end
    std::vector<Column> columns_;      // open addressing
};

} // namespace molsurf
