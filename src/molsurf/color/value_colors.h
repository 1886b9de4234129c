// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours by the values of balls.

#include "molsurf/atoms.h"
#include "molsurf/color/color_map.h"
#include "molsurf/color/label.h"
#include "molsurf/mesh.h"

#include <vector>

namespace molsurf
{

/// The colours of values: viridis, RdBu (turned round for charges: red is negative), the four of
/// the AlphaFold database for pLDDT (above 90, 70, 50 and below), turbo (Mikhailov, 2019) along a
/// chain. All but the last are safe for the colour-blind.
ColorScale scaleOf(const BallValues& values);

/// The colour of every ball, neutral where it has no value.
std::vector<Color> valueColors(const BallValues& values);

/// Adds the values to the vertices of a mesh as a scalar, and colours them by it where they are
/// distances from a centre.
/// @param[in] nearest  ball of each vertex
void addValues(const BallValues& values, const Labels& nearest, Mesh& mesh);

} // namespace molsurf
