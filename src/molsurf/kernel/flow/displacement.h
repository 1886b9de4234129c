// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far a step moved the interface: what the stopping rule of the flow looks at.

#include "molsurf/kernel/core/simd.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace molsurf
{

/// The ways of places of the interface in a step, in voxels. All sums are whole numbers: they have
/// the same bits in any order.
struct Displacements {
    std::uint64_t count = 0;              ///< number of places
    std::uint64_t moved = 0;              ///< sum of the ways, by `unit`
    std::uint64_t square = 0;             ///< sum of the squared ways, by `unit`
    std::array<std::uint64_t, 96> bins{}; ///< numbers of places by the size of their way

    /// @param[in] size  of a way [voxel]
    void add(float size)
    {
        const float seen = smaller(size, clip);
        ++count;
        moved += std::uint64_t(smaller(size, 1.0f) * unit);
        square += std::uint64_t(seen * seen * unit);
        ++bins[std::size_t(binOf(size))];
    }

    Displacements& operator+=(const Displacements& o);

    /// Mean way, each taken for a voxel at most [voxel].
    double mean() const { return count ? double(moved) / unit / double(count) : 0.0; }

    /// Root of the mean squared way, each taken for a quarter of a voxel at most: the
    /// quantile sees those that are longer [voxel].
    double rms() const;

    /// The size that a share of the places does not exceed, to an eighth [voxel].
    double quantile(double share) const;

    /// The share of the places whose way is longer than this [voxel], to an eighth of it.
    double shareAbove(double size) const;

private:
    static constexpr float clip = 0.25f, unit = 0x1p40f;

    // Bins are the exponents of floats and three bits more, from 2^-10 to 4 voxels.
    static constexpr int shift = 20, first = (127 - 10) << 3, last = 95;

    static int binOf(float size)
    {
        std::int32_t bits;
        std::memcpy(&bits, &size, sizeof bits);
        const int bin = (bits >> shift) - first;
        return bin < 0 ? 0 : bin > last ? last : bin;
    }

    /// The largest size in a bin.
    static float endOf(int bin)
    {
        const std::int32_t bits = (bin + 1 + first) << shift;
        float size;
        std::memcpy(&size, &bits, sizeof size);
        return size;
    }
};

} // namespace molsurf
