// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Lines along edges in pictures.

#include "molsurf/progress.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The ink that lines leave on each sample of a picture, from 0 to 255: a line is round about every
/// sample of an edge, and its rim is a sample wide.
///
/// @param[in] edges  kind of edge that each sample is on, row by row; 0: none
/// @param[in] radii  half the width of the lines of each kind [sample]; 0: there are none
std::vector<std::uint8_t> inkOf(std::size_t width, const std::vector<std::uint8_t>& edges,
                                const std::vector<float>& radii, const Progress& progress);

} // namespace molsurf
