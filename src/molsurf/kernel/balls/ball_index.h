// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the balls near a box by cell lists, hashed by columns of cells, one for each class of
/// radii.

#include "molsurf/ball.h"

#include <openvdb/math/BBox.h>
#include <openvdb/Types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The largest radius [Å]; 0 if there are no balls.
inline double largestRadius(const std::vector<Ball>& balls)
{
    double largest = 0.0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    return largest;
}

/// The box about all balls; empty if there are none.
/// @param[in] grown  how much larger the radii are [Å]
inline openvdb::BBoxd boxOf(const std::vector<Ball>& balls, double grown = 0.0)
{
    openvdb::BBoxd box;
    for (const Ball& ball : balls) {
        box.expand(ball.center - openvdb::Vec3d(ball.radius + grown));
        box.expand(ball.center + openvdb::Vec3d(ball.radius + grown));
    }
    return box;
}

/// The edge of the cells of a BallIndex: perRadius (r + grown), r being the largest radius that
/// their class admits, and at least `least`.
struct CellSize {
    double perRadius;
    double grown;         ///< [Å]
    double least;         ///< [Å], at least 1
    double largest = 0.0; ///< no radius of a class is above it [Å]; 0: the largest of the balls
};

/// Balls by the cubic cell of their centres. Balls of very different radii have lists of their own,
/// so that a large one does not widen the search for small ones. Immutable once made; safe to read
/// from all threads.
class BallIndex
{
public:
    /// @param[in] balls  every coordinate within 1e6 Å
    BallIndex(const std::vector<Ball>& balls, const CellSize& cell);

    /// Calls f(ball, i), i the ball's index in the vector, for the balls that may come within `gap`
    /// of the box [low, high] [Å]: all whose centres lie within gap + r of it, and some that do
    /// not. In an order that depends on the balls alone.
    template<typename F>
    void forEachNear(const openvdb::Vec3d& low, const openvdb::Vec3d& high, double gap,
                     const F& f) const
    {
        forEachRun(low, high, gap, [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t i = begin; i < end; ++i) f(balls_[i], order_[i]);
        });
    }

    /// Whether f(ball) holds for one of them; it is not called again then.
    template<typename F>
    bool anyNear(const openvdb::Vec3d& low, const openvdb::Vec3d& high, double gap,
                 const F& f) const
    {
        bool found = false;
        forEachRun(low, high, gap, [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t i = begin; i < end && !found; ++i) found = f(balls_[i]);
        });
        return found;
    }

    /// Calls f(begin, end) with the places of the same balls in the order of the index, a run of
    /// them at a time.
    template<typename F>
    void forEachRun(const openvdb::Vec3d& low, const openvdb::Vec3d& high, double gap,
                    const F& f) const
    {
        for (const Level& level : levels_) {
            const double reach = level.largest + gap;
            if (reach < 0.0) continue;
            const openvdb::Coord from = level.cellOf(low - openvdb::Vec3d(reach));
            const openvdb::Coord to = level.cellOf(high + openvdb::Vec3d(reach));
            const auto visit = [&](const Column& c) {
                const int first = std::max(from.z() - c.z, 0);
                const int last = std::min(to.z() - c.z, c.cells - 1);
                if (first > last) return;
                f(begins_[std::size_t(c.cell + first)], begins_[std::size_t(c.cell + last + 1)]);
            };
            if (isWide(from, to, level)) {
                for (const Column& c : level.columns) {
                    const int x = partOf(c.key, 2), y = partOf(c.key, 1);
                    if (x >= from.x() && x <= to.x() && y >= from.y() && y <= to.y()) visit(c);
                }
                continue;
            }
            for (int x = from.x(); x <= to.x(); ++x) {
                for (int y = from.y(); y <= to.y(); ++y) {
                    for (int block = from.z() >> blockBits; block <= to.z() >> blockBits; ++block)
                        visit(level.columns[level.position(columnKey(x, y, block))]);
                }
            }
        }
    }

    /// The ball at a place in the order of the index, and its index in the vector.
    const Ball& ball(std::size_t place) const { return balls_[place]; }
    std::int32_t indexOf(std::size_t place) const { return order_[place]; }
    std::size_t size() const { return balls_.size(); }

private:
    /// Cells above each other, from the first that has a ball to the last in a block of 32: a
    /// shell is hollow, and cells without balls take memory too.
    struct Column {
        std::uint64_t key;
        std::int64_t cell; // of the first cell in begins_
        int z;             // of the first cell
        int cells;         // 0 where the table has no column
    };

    /// The balls of one class of radii.
    struct Level {
        double cell;                 // edge [Å]
        double largest;              // radius [Å]
        std::vector<Column> columns; // open addressing; 2^(64 - shift) of them
        int shift;

        openvdb::Coord cellOf(const openvdb::Vec3d& x) const
        {
            return openvdb::Coord::floor(x / cell);
        }
        /// The place of a column in the table, or the free one where it would stand.
        std::size_t position(std::uint64_t key) const
        {
            // Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4): the highest bits
            // of the product, which depend on x, y and the block.
            std::size_t i = (key ^ key >> 32) * 0x9e3779b97f4a7c15ull >> shift;
            while (columns[i].cells != 0 && columns[i].key != key)
                i = (i + 1) & (columns.size() - 1);
            return i;
        }
    };

    static constexpr int blockBits = 5, keyBits = 21;
    static std::uint64_t columnKey(int x, int y, int block)
    {
        constexpr std::uint64_t mask = (1 << keyBits) - 1;
        return (std::uint64_t(x) & mask) << 2 * keyBits | (std::uint64_t(y) & mask) << keyBits |
               (std::uint64_t(block) & mask);
    }
    /// x for 2, y for 1 of a column's key: 21 bits with a sign, which the two shifts extend.
    static int partOf(std::uint64_t key, int which)
    {
        return int(std::uint32_t(key >> which * keyBits) << (32 - keyBits)) >> (32 - keyBits);
    }

    /// Whether a box has more columns than there are: one about a ball that is very large among
    /// balls of another class.
    static bool isWide(const openvdb::Coord& from, const openvdb::Coord& to, const Level& level)
    {
        constexpr double many = 4096.0;
        const double columns = (double(to.x()) - from.x() + 1.0) *
                               (double(to.y()) - from.y() + 1.0) *
                               ((to.z() >> blockBits) - (from.z() >> blockBits) + 1.0);
        return columns > std::max(many, double(level.columns.size()));
    }

    void addLevel(const std::vector<Ball>& balls, const std::vector<std::int32_t>& members,
                  double cell);

    std::vector<Level> levels_;        // of rising radii
    std::vector<Ball> balls_;          // level by level, cell by cell
    std::vector<std::int32_t> order_;  // their indices in the caller's vector
    std::vector<std::int32_t> begins_; // first ball of each cell of each column, and the end
};

} // namespace molsurf
