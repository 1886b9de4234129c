// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What a probe sweeps in closed cavities, in closed form.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/progress.h"

#include <openvdb/Types.h>

#include <optional>
#include <set>
#include <vector>

namespace molsurf
{

/// Measures closed cavities: the space that probes there sweep, without bodies apart in it. Only
/// the balls about a cavity are looked at.
class SweptCavities
{
public:
    /// @param[in] probe  [Å]
    SweptCavities(const std::vector<Ball>& balls, double probe);

    /// Which cavities.
    struct Query {
        std::vector<openvdb::Vec3d> places; ///< where probes fit, at least one in each [Å]
        openvdb::BBoxd box;                 ///< about the walls [Å]
        std::set<std::size_t> lining;       ///< balls that have a part of the walls
    };

    struct Measure {
        double volume; ///< [Å^3]
        double area;   ///< of the walls [Å^2]
    };

    /// The sum over these cavities; what probes of two of them sweep counts once.
    /// @return none if a place is in no closed cavity
    std::optional<Measure> measure(const Query& query, const Progress& progress) const;

private:
    double probe_;
    BallIndex index_;
};

} // namespace molsurf
