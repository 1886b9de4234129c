// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How each kind of surface is made: of which set it is the boundary, and how far inside of that.

#include "molsurf/grid/distance_band.h"
#include "molsurf/levelset/gaussian_sum.h"
#include "molsurf/options.h"

namespace molsurf
{

/// Half width of the grid `surface` [voxel].
constexpr double surfaceWidthVox = 3.0;

/// How far from S = 0 the spline needs samples [voxel]: the corners of the 4^3 coefficients about a
/// point are up to 2 sqrt(3) away.
constexpr double splineWidthVox = 4.0;

/// Tells whether a surface is that of a union of balls.
bool isUnion(SurfaceKind kind);

/// Gives how far the surface lies inside the set whose distance is known [Å], >= 0.
double offsetOf(const SurfaceOptions& options);

/// Gives the probe that the balls of a union surface are grown by [Å], >= 0.
double grownBy(const SurfaceOptions& options);

/// Tells whether area, volume and pieces of a surface are known in closed form.
bool isClosedForm(const SurfaceOptions& options);

/// Tells whether a surface is the boundary of a union of balls itself, and not one inside of it.
bool isBoundary(const SurfaceOptions& options);

/// Tells whether SurfaceOptions::grid may be false: area, volume and pieces of the surface, and the
/// areas of its balls, are known in closed form, and nothing is asked for that needs voxels.
bool hasClosedForm(const SurfaceOptions& options);

/// Gives the half width of the band of S that the spline is fitted on [Å].
double splineWidthOf(const SurfaceOptions& options);

/// Gives how far from the surface of its set the distance is computed.
BandWidths widthsOf(const SurfaceOptions& options);

/// Says that the voxels show nothing of a surface, and what would.
/// @param[in] stage  that found it
[[noreturn]] void failNothingLeft(const char* stage, SurfaceKind kind);

/// Gives the parameters of the sum of Gaussians.
GaussianOptions gaussianOptions(const SurfaceOptions& options);

} // namespace molsurf
