// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The distances of the voxels of a leaf by their closest points.

#include "molsurf/kernel/levelset/nearest_seeds.h"

namespace molsurf
{

/// Computes the distances of the voxels of one leaf.
class LeafDistances
{
public:
    /// @param[in] near    but for its index
    /// @param[in] origin  of the leaf
    LeafDistances(const NearestSeeds& near, const openvdb::Coord& origin)
        : near_(near), origin_(origin)
    {
    }

    /// Distances without sign [voxel], by the expansion about the seeds; within two voxels of the
    /// level the closest points are first moved by Newton's method where that changes the distance.
    /// @param[in]  index   the seed of each voxel of the leaf
    /// @param[in]  voxels  `count` voxels that have one
    /// @param[in]  level   [voxel]
    /// @param[out] out     by voxel; others keep their values
    void compute(const std::int32_t* index, const std::uint16_t* voxels, int count,
                 const LeafMask& negative, float level, float* out);

private:
    /// A voxel whose closest point has to be moved; it waits until as many as there are lanes do.
    struct Waiting {
        int v;
        std::int32_t seed;
        float sign, aside2;
        openvdb::Vec3f y; // where to
        float least2;     // squared distance of the point so far
        int rounds;
    };

    openvdb::Vec3f shift(const Seed& seed) const { return near_.shift(seed, origin_); }

    void polish(float* out);
    void seekFoot(std::int32_t index, int v, float* out) const;

    const NearestSeeds& near_;
    const openvdb::Coord origin_;
    Waiting wait_[lanes];
    int waiting_ = 0;
};

} // namespace molsurf
