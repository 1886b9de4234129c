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

/// Whether a surface is that of a union of balls.
bool isUnion(SurfaceKind kind);

/// How far the surface lies inside the set whose distance is known [Å].
double offsetOf(const SurfaceOptions& options);

/// The probe that the balls of a union surface are grown by [Å].
double grownBy(const SurfaceOptions& options);

/// Whether area, volume and pieces of a surface are known in closed form.
bool isClosedForm(const SurfaceOptions& options);

/// The half width of S's band, which the spline is fitted on [Å].
double splineWidthOf(const SurfaceOptions& options);

/// How far from the surface of its set the distance is computed.
BandWidths widthsOf(const SurfaceOptions& options);

/// How the Gaussians of a run are summed.
GaussianOptions gaussianOptions(const SurfaceOptions& options);

} // namespace molsurf
