// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Topology of unions of balls by CGAL's alpha shapes.

#include "molsurf/ball.h"

#include <vector>

namespace molsurf::test
{

/// The Euler characteristic of the boundary of the union of balls of radius r_i + probe: twice that
/// of the union, which is that of its dual complex, the weighted alpha shape (Edelsbrunner, The
/// union of balls and its dual shape, Discrete Comput. Geom. 13:415-440, 1995).
/// @param[in] probe  [Å]
int eulerOfUnion(const std::vector<Ball>& balls, double probe);

} // namespace molsurf::test
