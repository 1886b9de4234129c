// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Grids beside `surface` that a spline or a level set gives.

#include "molsurf/kernel/spline/spline.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// Whether a list of fields names one.
bool hasField(const std::vector<std::string>& fields, const std::string& name);

/// The coefficients of a spline, as they are.
openvdb::FloatGrid::Ptr splineGrid(const Spline& spline);

/// A level set as fog: 1 inside, from the surface to the depth of the band rising from 0 to 1.
openvdb::FloatGrid::Ptr densityGrid(const openvdb::FloatGrid& surface);

/// Curvatures of the surface on the active voxels of `surface`, 0 elsewhere. A voxel has the value
/// of the point of S = 0 that is reached from it along the gradient of S: the closest one. So the
/// value does not change along the normals, a sample anywhere near the surface is that of the
/// surface, and nothing grows without bound toward the centres of concave patches. Where the way
/// along the gradient ends before the surface (on ridges of the distance) it is the curvature of
/// the level set through the voxel.
///
/// @param[in] names  of curvatureFields(); others are skipped
/// @return one grid a name, in their order: float, or vec3s for a direction
std::vector<openvdb::GridBase::Ptr> curvatureGrids(const openvdb::FloatGrid& surface,
                                                   const Spline& spline,
                                                   const std::vector<std::string>& names,
                                                   const Progress& progress);

/// Has the values of grids saved as 16-bit floats, but for those of `value`, which may be beyond
/// the range of these.
void saveAsHalf(const openvdb::GridPtrVec& grids);

} // namespace molsurf
