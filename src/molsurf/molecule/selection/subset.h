// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Some of the balls, with all that is known of them.

#include "molsurf/atoms.h"
#include "molsurf/kernel/balls/repeated_balls.h"
#include "molsurf/progress.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace molsurf
{

/// The balls that numbers in groups and resolution rules count: those of a subset, or still
/// those of the whole.
enum class Counted { Subset, Whole };

/// Sets the number of balls of each group or rule in the whole that a unit stands for, or in these.
/// @param[in] memberOf  index of its group for each ball, or -1
template<typename T>
void countBalls(const BallSet& atoms, const std::vector<std::int32_t>& memberOf,
                std::vector<T>& groups)
{
    for (T& group : groups) group.balls = 0;
    for (std::size_t i = 0; i < std::min(atoms.own(), memberOf.size()); ++i)
        if (memberOf[i] >= 0) groups[std::size_t(memberOf[i])].balls += atoms.placement.order();
}

/// Takes some of the balls, with their labels, colours and resolutions, as a whole of their own.
/// Chains, groups and rules stay all, so that their indices mean the same.
/// @param[in] which  indices, in the order that is wanted
BallSet subset(const BallSet& atoms, const std::vector<std::size_t>& which,
               Counted counted = Counted::Subset);

/// The same balls in spatial order, so that results have the same bits for any order of the atoms.
BallSet inSpatialOrder(const BallSet& atoms);

/// The balls of a whole, where its copies lie.
struct WholeBalls {
    std::vector<Ball> balls;
    std::vector<std::size_t> sources; ///< of each: the ball that a motion made it of
};

/// Finds the balls of the whole that a set stands for: these, or its own ones as motions repeat
/// them.
WholeBalls ballsOfWhole(const BallSet& atoms);

/// The balls of the whole that a set stands for if it is folded, or its own ones.
/// @param[in] atoms  have to outlive the result
RepeatedBalls repeatedBalls(const BallSet& atoms);

/// How deep the centre of each ball lies below the outer solvent-excluded surface of the whole, or
/// of its prototype [Å].
/// @param[in] probe  0: below the van der Waals surface [Å]
std::vector<double> ballDepths(const BallSet& atoms, double probe, const Progress& progress);

} // namespace molsurf
