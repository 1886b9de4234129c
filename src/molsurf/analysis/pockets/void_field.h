// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The space about balls that a small probe reaches and a large one, from outside, does not.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/depth.h"
#include "molsurf/kernel/grid/leaf_table.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace molsurf
{

/// How deep a place with a clearance lies below what a large probe reaches from outside.
using DepthAt = std::function<OuterDepth::Depth(const openvdb::Vec3d&, double)>;
/// The same, below a cut.
using BelowCut = DepthAt;

using PocketOptions = Products::PocketRule;

/// A voxel as a number: 512 times its leaf and its place there.
using VoxelPlace = std::uint32_t;

/// Two distances on voxels. Where one of the corners of a cell has room, all of them are known.
struct VoidField {
    LeafTable table;     ///< active: voxels with room
    LeafField clearance; ///< distance to the small probe's surface, negative in the balls [Å]
    LeafField below; ///< how far below the cut, negative above it [Å]; where it is more than the
                     ///< clearance, a little too much
    double voxelSize = 0.0;
    std::vector<Ball> corners; ///< of radius 0: where small probes touch three balls or more
    std::shared_ptr<const OuterDepth> outer; ///< the depth itself

    /// Room [Å]: above 0 where a probe has it.
    float room(std::size_t leaf, int voxel) const
    {
        return std::min(clearance.leaf(leaf)[voxel], below.leaf(leaf)[voxel]);
    }
    float room(VoxelPlace voxel) const { return room(voxel / leafSize, int(voxel % leafSize)); }

    /// Where a voxel lies [Å].
    openvdb::Vec3d pointOf(VoxelPlace voxel) const
    {
        const int v = int(voxel % leafSize);
        return table.origin(voxel / leafSize).offsetBy(v >> 6, v >> 3 & 7, v & 7).asVec3d() *
               voxelSize;
    }

    /// The voxel at a coordinate; none: no leaf has it.
    std::optional<VoxelPlace> find(const openvdb::Coord& at) const
    {
        const std::int32_t leaf = table.find(at);
        if (leaf < 0) return {};
        return VoxelPlace(leaf * leafSize + ((at[0] & 7) << 6 | (at[1] & 7) << 3 | (at[2] & 7)));
    }
};

/// Finds that space. Where they decide it the distances are exact but for rounding.
/// @param[in] balls  at least one, every one finite
VoidField voidField(const std::vector<Ball>& balls, const PocketOptions& options, double voxelSize,
                    const Progress& progress);

} // namespace molsurf
