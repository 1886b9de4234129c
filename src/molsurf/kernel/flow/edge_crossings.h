// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where an interface crosses the edges between voxels of a leaf.

#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"

#include <cstddef>
#include <vector>

namespace molsurf
{

/// The crossings of the edges that begin at voxels of a leaf, from cubic interpolation along each.
struct EdgeCrossings {
    using Block = LeafBlock<float, 2>;

    /// The edge of a crossing.
    struct Edge {
        int voxel;           ///< of the leaf, at which it begins
        std::ptrdiff_t from; ///< place of that voxel in the block
        std::ptrdiff_t step; ///< to the voxel at its end
        double t;            ///< of the crossing, from 0 to 1
    };

    std::vector<GaussianSum::Point> points;
    std::vector<double> weights; ///< |n_a|, by which it counts for h^2 |n_a| of the area
    std::vector<Edge> edges;

    /// @param[in] phi     negative inside
    /// @param[in] active  where edges begin
    void find(const Block& phi, const LeafMask& active);
};

} // namespace molsurf
