// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What is decided of the topology of a smooth surface. Where a small change would open or close a
/// gap or a wall, a grid, its place and the steps of a flow would decide. Instead a property of the
/// molecule decides, and the level set is changed there such that voxels hold the decision.
/// docs/math.md, sections 2 and 7.

#include "molsurf/report.h"

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// A place where a gap or a wall is open or closed, and how near it is to being the other.
struct Decision {
    openvdb::Vec3d place; ///< [Å]
    /// How far the place is on the closed side of where the decision turns; negative: it is open.
    /// Of a gap as a value of psi; of a wall how much deeper its middle lies than that of the
    /// thinnest that stays [Å].
    double beyond;
    bool byItself = false; ///< of a gap: psi >= 0, atoms fill it, and tension does not close it

    bool closed() const { return beyond > 0.0; }
};

using GapReport = EvolutionReport::Gaps;

/// Counts decisions, and how near the nearest is, at most `farthest`.
GapReport reportOf(const std::vector<Decision>& decisions, double farthest);

/// Whether one of some that ascend by places, the last of which has no larger x, is at a place.
template<typename Placed>
bool isAmong(const std::vector<Placed>& some, const openvdb::Vec3d& place, double same)
{
    for (auto o = some.rbegin(); o != some.rend() && place.x() - o->place.x() <= same; ++o)
        if ((place - o->place).length() < same) return true;
    return false;
}

} // namespace molsurf
