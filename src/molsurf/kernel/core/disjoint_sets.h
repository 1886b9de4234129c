// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Disjoint sets of indices (union-find), joined by all threads at once without locks.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Sets of the indices [0, n). The root of a set is its lowest index, whatever the order in which
/// threads join, so results do not depend on it.
class DisjointSets
{
public:
    explicit DisjointSets(std::size_t n) : parent_(n)
    {
        for (std::size_t i = 0; i < n; ++i) parent_[i].store(std::uint32_t(i), relaxed);
    }

    /// The root of the set of i, as far as sets are joined by now; halves the path to it.
    std::uint32_t find(std::uint32_t i)
    {
        while (true) {
            std::uint32_t up = parent_[i].load(relaxed);
            if (up == i) return i;
            const std::uint32_t above = parent_[up].load(relaxed);
            if (above != up) parent_[i].compare_exchange_weak(up, above, relaxed);
            i = above;
        }
    }

    void join(std::uint32_t a, std::uint32_t b)
    {
        while (true) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            std::uint32_t larger = std::max(a, b);
            if (parent_[larger].compare_exchange_strong(larger, std::min(a, b), relaxed)) return;
        }
    }

    /// The number of the set of every index, in the order of their lowest indices.
    /// @param[out] count  of the sets
    std::vector<std::uint32_t> numbers(std::size_t& count)
    {
        count = 0;
        std::vector<std::uint32_t> out(parent_.size());
        for (std::uint32_t i = 0; i < out.size(); ++i) {
            const std::uint32_t root = find(i);
            out[i] = root == i ? std::uint32_t(count++) : out[root];
        }
        return out;
    }

private:
    static constexpr auto relaxed = std::memory_order_relaxed;
    std::vector<std::atomic<std::uint32_t>> parent_;
};

} // namespace molsurf
