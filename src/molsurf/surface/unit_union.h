// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Shares of a symmetric unit in a union of balls, in closed form.

#include "molsurf/atoms.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace molsurf
{

/// How near balls are that count as one in the place of several [Å].
constexpr double onAxis = 0.05;

/// The other balls of the same radius that lie where a ball is: its own images, if it is on an
/// axis, and images of others that stand in for each other.
/// @param[in] index  of the balls
std::vector<std::size_t> imagesAt(const BallSet& atoms, const BallIndex& index, std::size_t i);

/// Parts of the whole that the rotations of a unit make; times the order of their group they are
/// those of the whole.
struct UnitShare {
    double volume = 0.0;       ///< [Å^3]
    std::vector<double> areas; ///< of each ball [Å^2]; 0 for those of neighbours
    /// Of the boundary of the whole. None where the parts of its units do not add up to a number
    /// that a closed surface can have.
    std::optional<int> wholeEuler;
};

/// Measures what a unit (Placement::unit) has of the union of balls of radius r_i + grown. A patch
/// belongs to the unit of its ball. Balls in one place have equal parts of what is theirs.
///
/// The volume is the flux of (x - c)/3 through the unit's patches, c being the point about which
/// the group rotates: it is the same for every unit.
///
/// @throws Error(ErrorKind::Check) if the boundary contradicts itself
UnitShare shareOfUnit(const BallSet& atoms, double grown, const Progress& progress);

} // namespace molsurf
