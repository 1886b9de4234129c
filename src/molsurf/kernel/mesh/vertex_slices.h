// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The triangles of a mesh by slices of its vertices, for what is gathered at vertices by all
/// threads at once: each slice takes what its own vertices need, in the order of the triangles.

#include "molsurf/mesh.h"
#include "molsurf/progress.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Slices of 16384 vertices, whose triangles stay in the cache. It does not hold the mesh.
class VertexSlices
{
public:
    VertexSlices(const Mesh& mesh, const Progress& progress);

    std::size_t size() const { return begins_.size() - 1; }

    /// The first vertex of a slice; that of the next one is its end.
    std::uint32_t first(std::size_t slice) const
    {
        return std::uint32_t(std::min(slice << bits, vertices_));
    }

    /// Calls f(triangle) for some of the triangles, in ascending order: all that have a corner in
    /// the slice, and some that have none.
    template<typename F>
    void forEachTriangle(std::size_t slice, const F& f) const
    {
        for (std::size_t i = begins_[slice]; i < begins_[slice + 1]; ++i) {
            const std::size_t begin = blocks_[i] * blockSize;
            const std::size_t end = std::min(triangles_, begin + blockSize);
            for (std::size_t t = begin; t < end; ++t) f(t);
        }
    }

private:
    static constexpr int bits = 14;
    static constexpr std::size_t sliceSize = std::size_t(1) << bits;
    static constexpr std::size_t blockSize = 256; // triangles

    std::size_t vertices_, triangles_;
    std::vector<std::size_t> begins_;   // of the blocks of each slice
    std::vector<std::uint32_t> blocks_; // that have a corner in it
};

} // namespace molsurf
