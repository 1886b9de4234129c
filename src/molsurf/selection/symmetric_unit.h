// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a symmetric assembly that its rotations make the whole of, and what is around it.

#include "molsurf/atoms.h"
#include "molsurf/structure/rotation_group.h"
#include "molsurf/structure/structure.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Chooses a unit of an assembly: copies of which its rotations make every copy once, those nearest
/// to a common point, so that they hang together.
/// @param[in]     balls  in the coordinates of the file
/// @param[in,out] out    gets the balls of the unit, copy by copy, and the motions
/// @return the rotations
/// @throws Error as expandAssembly() and findRotationGroup(), or if a copy lies farther than 1 Å
///         from where the rotations bring it
RotationGroup chooseUnit(const Structure& structure, const std::string& name,
                         const std::vector<Ball>& balls, BallSet& out);

/// Adds the images of a unit's balls that lie near it. Of image m of copy i the number is that of
/// copy i.
/// @param[in]     group   its rotations
/// @param[in]     reach   how far from a ball of the unit the centre of an image may lie [Å]
/// @param[in,out] out     with the unit's balls, copy by copy; copies are added
/// @return for each ball the motion that made it; 0: one of the unit
std::vector<std::int32_t> surround(const RotationGroup& group, double reach, BallSet& out);

} // namespace molsurf
