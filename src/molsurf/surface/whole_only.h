// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Options that need the whole molecule, or its voxels, at once: a row each.

#include "molsurf/options.h"

#include <string>

namespace molsurf
{

/// Ways to a surface that cannot give everything. Their bits make sets.
enum Way : unsigned {
    InBricks = 1,     ///< part of space by part
    BySymmetry = 2,   ///< from one unit, which rotations repeat
    InClosedForm = 4, ///< without voxels
    ByAtom = 8        ///< with areas of atoms
};

/// The request of the options that a way cannot give, in backticks; "": it gives all.
std::string missingIn(Way way, const SurfaceOptions& options);

/// Checks that a way gives all of what the options ask for.
/// @throws Error(ErrorKind::Usage) that names the first thing that it does not
void checkWay(Way way, const SurfaceOptions& options);

} // namespace molsurf
