// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The balls of a whole that motions make of fewer, one after another: they are never in memory
/// together.

#include "molsurf/ball.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace molsurf
{

/// Balls [begin, end), moved.
struct BallCopy {
    Motion motion;
    std::size_t begin, end;
};

class RepeatedBalls
{
public:
    /// Each ball once, where it is.
    RepeatedBalls(const std::vector<Ball>& balls) : balls_(balls), size_(balls.size()) {}

    /// The balls of some copies, in their order.
    /// @param[in] copies  at least one
    RepeatedBalls(const std::vector<Ball>& balls, std::vector<BallCopy> copies)
        : balls_(balls), copies_(std::move(copies)), size_(0)
    {
        for (const BallCopy& copy : copies_) size_ += copy.end - copy.begin;
    }

    std::size_t size() const { return size_; }

    /// Those that the copies are made of.
    const std::vector<Ball>& distinct() const { return balls_; }

    /// Calls f(ball, i) for each ball of the whole, i being its number.
    template<typename F>
    void forEach(const F& f) const
    {
        std::size_t n = 0;
        if (copies_.empty())
            for (const Ball& ball : balls_) f(ball, n++);
        for (const BallCopy& copy : copies_) {
            for (std::size_t i = copy.begin; i < copy.end; ++i) {
                const Ball& ball = balls_[i];
                f(Ball{copy.motion.placed(ball.center), ball.radius, ball.atom}, n++);
            }
        }
    }

    /// All of them.
    std::vector<Ball> unfolded() const
    {
        std::vector<Ball> all;
        all.reserve(size_);
        forEach([&](const Ball& ball, std::size_t) { all.push_back(ball); });
        return all;
    }

private:
    const std::vector<Ball>& balls_;
    std::vector<BallCopy> copies_; // empty: each ball once
    std::size_t size_;
};

} // namespace molsurf
