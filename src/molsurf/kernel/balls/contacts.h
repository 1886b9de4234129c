// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds the labelled parts of a molecule that touch.

#include "molsurf/ball.h"
#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// For each label the others, in ascending order, that have a ball near one of its own.
///
/// @param[in] labelOf  label of each ball, or -1
/// @param[in] labels   how many labels there are
/// @param[in] gap      largest distance between the surfaces of two balls that are near [Å]
std::vector<std::vector<std::int32_t>> contacts(const std::vector<Ball>& balls,
                                                const std::vector<std::int32_t>& labelOf,
                                                std::size_t labels, double gap,
                                                const Progress& progress);

} // namespace molsurf
