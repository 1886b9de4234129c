// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Area and volume of a union of balls to a few per cent, from points at random: for estimates.

#include "molsurf/kernel/balls/repeated_balls.h"

namespace molsurf
{

/// The area of the union of balls of radius r + grown [Å^2], from 8,192 points on their spheres.
/// The standard error is that of a share: 3 % where an eighth of the spheres is exposed.
/// @param[in] balls  every one finite
double sampledArea(const RepeatedBalls& balls, double grown);

/// The volume of that union [Å^3], from 2,048 points in the balls, each of which counts by the
/// inverse of the number of balls that it lies in.
double sampledVolume(const RepeatedBalls& balls, double grown);

} // namespace molsurf
