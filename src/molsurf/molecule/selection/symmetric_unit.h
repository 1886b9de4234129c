// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a symmetric assembly that its rotations make the whole of, and what is around it.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/assembly.h"

#include <vector>

namespace molsurf
{

/// Chooses a unit of an assembly: copies of which its rotations make every copy once, those nearest
/// to a common point, so that they hang together.
/// @param[out] out  gets the balls of the unit, copy by copy
/// @throws Error as findRotationGroup(), or if a copy lies farther than 1 Å from where the
///         rotations bring it
Placement chooseUnit(const AssemblyCopies& assembly, std::vector<Ball>& out);

/// Adds the images of a unit's balls that lie near it. Of image m of copy i the number is that of
/// copy i. Does nothing if there is no unit.
/// @param[in]     reach   how far from a ball of the unit the centre of an image may lie [Å]
/// @param[in,out] out     with the unit's balls, copy by copy; copies are added
void surround(double reach, BallSet& out);

} // namespace molsurf
