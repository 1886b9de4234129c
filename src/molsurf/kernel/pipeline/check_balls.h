// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Checks balls before anything is computed of them.

#include "molsurf/kernel.h"
#include "molsurf/kernel/core/memory.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// Tells what is in memory at once: a surface in one piece, no more of it than its bricks' merge
/// needs, or no grid.
enum class Pieces { One, Bricks, NoGrid };

/// Checks that balls have places and radii that can be computed with.
/// @throws Error(ErrorKind::Input) that names the first ball at fault, by its index
void checkFinite(const std::vector<Ball>& balls);

/// Checks that there are balls, that they are finite, and that the largest one fits in a grid: the
/// surface of the whole is at least as large as its own.
///
/// @param[in] memory  that there is [byte]
/// @throws Error(ErrorKind::Input) that names the first ball at fault, by its index, or says what
///         voxel would do
void checkBalls(const std::vector<Ball>& balls, const SurfaceSpec& spec, Pieces pieces,
                std::size_t memory);

/// A warning on atoms that are packed as no matter is: coordinates in nanometres, most likely.
/// @return one line; empty: none
std::string packingWarning(const std::vector<Ball>& balls);

} // namespace molsurf
