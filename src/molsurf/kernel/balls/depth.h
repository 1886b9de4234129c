// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How deep atoms lie below a solvent-excluded surface.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <memory>
#include <vector>

namespace molsurf
{

/// How deep points lie below what a probe reaches from outside. Immutable once made; safe to use
/// from all threads.
class OuterDepth
{
public:
    /// What a probe reaches from outside.
    enum class Reach {
        Washed, ///< also voids whose probes overlap with those outside: they wash one void, so that
                ///< atoms there are not below a wall
        Passed  ///< only where its centre gets
    };

    /// @param[in] balls  at least one, every one finite
    /// @param[in] probe  [Å]
    OuterDepth(const std::vector<Ball>& balls, double probe, Reach reach, const Progress& progress);

    /// A depth.
    struct Depth {
        double value;          ///< the distance from `centre` less the probe's radius [Å];
                               ///< negative where the probe gets from outside
        openvdb::Vec3d centre; ///< the nearest centre of a probe at the edge of its space [Å]
    };

    /// @param[in] hasRoom  whether the probe fits about the point
    /// @param[in] guess    the distance from the centre of a probe, for speed [Å], > 0
    Depth at(const openvdb::Vec3d& x, bool hasRoom, double guess) const;

    /// Whether probes reach the void that a point lies in from outside.
    /// @param[in] guess  as above
    bool isOutside(const openvdb::Vec3d& x, double guess) const;

    /// Whether the probe fits into places that it does not reach from outside.
    bool hasVoids() const { return closed_ != nullptr; }

    /// Centres of probes in such places are no farther from the edge of their space than this [Å].
    double voidRadius() const { return voidRadius_; }

private:
    BallBoundary boundary_;
    BoundaryMeasure measure_;
    std::unique_ptr<const BoundaryPoints> open_, closed_; ///< the pieces reached, and the others
    double probe_, voidRadius_ = 0.0;
};

/// The distance of points from the nearest place that a probe reaches from outside: how far away
/// the centre of the nearest such probe is, less its radius. In the balls that is the distance to
/// the solvent-excluded surface without the walls of cavities.
///
/// @param[in] balls   at least one, every one finite
/// @param[in] probe   0: the van der Waals surface [Å]
/// @param[in] points  each in a ball [Å]
/// @return one a point, exact to 1e-5 Å
std::vector<double> depthsOf(const std::vector<Ball>& balls, double probe,
                             const std::vector<openvdb::Vec3d>& points, const Progress& progress);

} // namespace molsurf
