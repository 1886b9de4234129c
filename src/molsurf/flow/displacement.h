// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far the voxels of the interface have to go: what the stopping rule of the flow looks at.

#include "molsurf/core/simd.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace molsurf
{

/// The displacements that a step solves for at the voxels of the interface, in voxels. All sums are
/// whole numbers: they have the same bits in any order.
struct Displacements {
    std::uint64_t count = 0;              ///< number of voxels
    std::uint64_t moved = 0;              ///< sum of the steps, by `unit`
    std::uint64_t square = 0;             ///< sum of the squared displacements, by `unit`
    std::array<std::uint64_t, 96> bins{}; ///< numbers of voxels by the size of displacement

    /// @param[in] size  of the displacement that would bring the voxel to rest [voxel]
    /// @param[in] step  that is made [voxel]
    void add(float size, float step)
    {
        const float seen = smaller(size, clip);
        ++count;
        moved += std::uint64_t(smaller(step, 1.0f) * unit);
        square += std::uint64_t(seen * seen * unit);
        ++bins[std::size_t(binOf(size))];
    }

    Displacements& operator+=(const Displacements& o);

    /// Mean size of the steps that are made [voxel].
    double meanStep() const { return count ? double(moved) / unit / double(count) : 0.0; }

    /// Root of the mean squared displacement, each taken for a quarter of a voxel at most: the
    /// quantile sees those that are longer [voxel].
    double rms() const;

    /// The size that a share of the voxels does not exceed, to an eighth [voxel].
    double quantile(double share) const;

    /// The share of the voxels whose displacement is longer than this [voxel], to an eighth of it.
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
