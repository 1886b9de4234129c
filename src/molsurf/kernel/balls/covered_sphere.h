// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Finds spheres that caps cover all over.

#include "molsurf/kernel/balls/ball_boundary.h"

namespace molsurf
{

/// Whether caps surely cover all of a sphere, in floats: each of 384 cells of it lies in one of
/// them, by more than rounding. False may also mean that not every cell lies in a single cap.
///
/// A cell lies within the angle rho of its middle. So it lies in a cap of half angle theta if its
/// middle is no farther from the cap's axis than theta - rho.
///
/// @param[in] caps   the large ones first, which makes it quick
/// @param[in] count  of these, from the first one; others are not used
/// @param[in] error  of their axes; half angles are no larger than the true ones
bool isSphereSurelyCovered(const CapLists& caps, std::size_t count, float error = 3e-6f);

} // namespace molsurf
