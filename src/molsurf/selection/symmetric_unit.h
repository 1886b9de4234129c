// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a symmetric assembly that its rotations make the whole of, and what is around it.

#include "molsurf/atoms.h"
#include "molsurf/structure/rotation_group.h"
#include "molsurf/structure/structure.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// Copies of an assembly of which its rotations make every copy once: those nearest to a common
/// point, so that they hang together.
struct UnitBalls {
    RotationGroup group;
    double deviation = 0.0; ///< farthest that the corner of a copy's box lies from where a rotation
                            ///< brings it from the unit [Å]
    std::vector<Ball> balls;            ///< copy by copy
    std::vector<std::size_t> copyBegin; ///< copy i is balls [copyBegin[i], copyBegin[i + 1])
    std::vector<int> copyNumbers;       ///< of copy i in the whole assembly, from 1
    std::size_t unused = 0;             ///< balls that no part of the assembly lists
};

/// Chooses a unit of an assembly.
/// @param[in] balls  in the coordinates of the file
/// @throws Error as expandAssembly() and findRotationGroup(), or if a copy lies farther than 1 Å
///         from where the rotations bring it
UnitBalls unitBalls(const Structure& structure, const std::string& name,
                    const std::vector<Ball>& balls);

/// Adds the images of a unit's balls that lie near it. Of image m of copy i the number is that of
/// copy i.
/// @param[in]     group   its rotations
/// @param[in]     reach   how far from a ball of the unit the centre of an image may lie [Å]
/// @param[in,out] out     with the unit's balls, copy by copy; copies are added
/// @return for each ball the motion that made it; 0: one of the unit
std::vector<std::int32_t> surround(const RotationGroup& group, double reach, BallSet& out);

} // namespace molsurf
