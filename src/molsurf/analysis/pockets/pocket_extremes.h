// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The widest and the deepest place of a pocket, from voxels near them.

#include "molsurf/analysis/pockets/clearance.h"
#include "molsurf/analysis/pockets/void_field.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/depth.h"

#include <openvdb/Types.h>

#include <functional>

namespace molsurf
{

/// The radius of the largest ball in a pocket without a node: from its widest voxel it moves to
/// where it has more room, by longer steps as long as there is more and by shorter ones where there
/// is not.
/// @param[in] isWithin  whether a point is of the pocket
/// @return [Å]
double largestBall(const openvdb::Vec3d& widest, double voxelSize, const Clearance& clearance,
                   const std::function<bool(const openvdb::Vec3d&)>& isWithin);

/// The depth of pockets: that of the deepest place that a small probe covers. Where the surface of
/// the large probe bulges most over it, the small one touches three balls; elsewhere it is moved
/// from there, and the place on it, to where that is deeper.
class DeepestPlaces
{
public:
    /// @param[in] space      has to outlive this object
    /// @param[in] probe      the small one [Å]
    /// @param[in] clearance  has to outlive this object
    DeepestPlaces(const VoidField& space, double probe, const Clearance& clearance);

    /// @param[in] voxel  the deepest one of a pocket
    /// @return the depth of the deepest place within a voxel's diagonal of it [Å]
    double depthNear(const openvdb::Vec3d& voxel) const;

private:
    /// A small probe, and a place that it covers.
    struct Cover {
        openvdb::Vec3d centre, place;
    };
    struct Deepest {
        Cover cover;
        OuterDepth::Depth depth;
    };

    /// The place on the way from the centre of a probe that it covers yet.
    openvdb::Vec3d coveredBy(const openvdb::Vec3d& centre, const openvdb::Vec3d& place) const;
    bool tryDeeper(const Cover& next, const openvdb::Vec3d& voxel, Deepest& at) const;
    void climb(const openvdb::Vec3d& voxel, Deepest& at) const;

    BallIndex corners_;
    const OuterDepth& outer_;
    const Clearance& clearance_;
    double probe_, reach_;
};

} // namespace molsurf
