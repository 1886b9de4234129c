// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A set of the vertices of a mesh, which all threads may fill at once.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// A bit for each vertex, and with count() the place of each among those of the set.
class VertexSet
{
public:
    /// @param[in] vertices  of the mesh
    explicit VertexSet(std::size_t vertices) : words_((vertices + 63) / 64) {}

    void add(std::uint32_t v)
    {
        if (!has(v)) words_[v / 64].fetch_or(bit(v), std::memory_order_relaxed);
    }

    bool has(std::uint32_t v) const { return (word(v / 64) & bit(v)) != 0; }

    /// Makes size() and place() know what was added.
    void count()
    {
        before_.resize(words_.size());
        size_ = 0;
        for (std::size_t w = 0; w < words_.size(); ++w) {
            before_[w] = std::uint32_t(size_);
            size_ += std::size_t(__builtin_popcountll(word(w)));
        }
    }

    std::size_t size() const { return size_; }

    /// The number of vertices of the set that come before one of them.
    std::uint32_t place(std::uint32_t v) const
    {
        return before_[v / 64] + std::uint32_t(__builtin_popcountll(word(v / 64) & (bit(v) - 1)));
    }

    /// All of them, in ascending order.
    std::vector<std::uint32_t> list() const
    {
        std::vector<std::uint32_t> out;
        out.reserve(size_);
        for (std::size_t w = 0; w < words_.size(); ++w)
            for (std::uint64_t left = word(w); left != 0; left &= left - 1)
                out.push_back(std::uint32_t(64 * w) + std::uint32_t(__builtin_ctzll(left)));
        return out;
    }

private:
    static std::uint64_t bit(std::uint32_t v) { return std::uint64_t(1) << (v % 64); }
    std::uint64_t word(std::size_t w) const { return words_[w].load(std::memory_order_relaxed); }

    std::vector<std::atomic<std::uint64_t>> words_;
    std::vector<std::uint32_t> before_; // of each word
    std::size_t size_ = 0;
};

} // namespace molsurf
