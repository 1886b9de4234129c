// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// 512 bits, one a voxel of an 8^3 leaf, in the voxel order of OpenVDB's leaf nodes: word x holds
/// bit 8 y + z.

#include <array>
#include <cstdint>

namespace molsurf
{

/// A set of voxels of one leaf.
struct LeafMask {
    std::array<std::uint64_t, 8> words{};

    bool on(int voxel) const { return (words[voxel >> 6] >> (voxel & 63)) & 1; }
    void set(int voxel) { words[voxel >> 6] |= std::uint64_t(1) << (voxel & 63); }
    void set(int voxel, bool on) { words[voxel >> 6] |= std::uint64_t(on) << (voxel & 63); }

    /// The 8 bits of row 8 x + y, bit z.
    std::uint8_t row(int i) const { return std::uint8_t(words[i >> 3] >> (8 * (i & 7))); }

    bool any() const
    {
        std::uint64_t all = 0;
        for (std::uint64_t w : words) all |= w;
        return all != 0;
    }
    int count() const
    {
        int n = 0;
        for (std::uint64_t w : words) n += __builtin_popcountll(w);
        return n;
    }
    /// How many voxels of the set come before one.
    int countBelow(int voxel) const
    {
        int n = 0;
        for (int i = 0; i < voxel >> 6; ++i) n += __builtin_popcountll(words[i]);
        const std::uint64_t before = (std::uint64_t(1) << (voxel & 63)) - 1;
        return n + __builtin_popcountll(words[voxel >> 6] & before);
    }
    LeafMask& operator|=(const LeafMask& other)
    {
        for (int i = 0; i < 8; ++i) words[i] |= other.words[i];
        return *this;
    }
    LeafMask& operator&=(const LeafMask& other)
    {
        for (int i = 0; i < 8; ++i) words[i] &= other.words[i];
        return *this;
    }
    friend LeafMask operator~(LeafMask mask)
    {
        for (std::uint64_t& w : mask.words) w = ~w;
        return mask;
    }
    friend LeafMask operator&(LeafMask a, const LeafMask& b) { return a &= b; }
    friend LeafMask operator|(LeafMask a, const LeafMask& b) { return a |= b; }

    /// Calls f(voxel) for every voxel of the set, in ascending order.
    template<typename F>
    void forEach(const F& f) const
    {
        for (int x = 0; x < 8; ++x) {
            for (std::uint64_t w = words[x]; w != 0; w &= w - 1) f(64 * x + __builtin_ctzll(w));
        }
    }
};

} // namespace molsurf
