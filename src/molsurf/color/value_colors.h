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

/// The value of a point, where points have values of their own (BallValues::byPoint()).
/// @param[in] normal  of the surface there, outward
float valueAt(const BallValues& values, const openvdb::Vec3d& x, const openvdb::Vec3d& normal);

/// A grid Cd of such values on the active voxels of a level set; linear light.
openvdb::GridBase::Ptr valueGrid(const openvdb::FloatGrid& surface, const BallValues& values,
                                 const Progress& progress);

/// Adds the values to the vertices of a mesh as a scalar, and colours them by it where points have
/// values of their own.
/// @param[in] nearest  ball of each vertex
void addValues(const BallValues& values, const Labels& nearest, Mesh& mesh);

} // namespace molsurf
