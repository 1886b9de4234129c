// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The optional grids beside `surface`.

#include "molsurf/bspline/spline.h"
#include "molsurf/core/progress.h"
#include "molsurf/selection/ball.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace molsurf
{

/// The names that Options::fields takes: "sas", "spline", "mean_curvature", "gaussian_curvature",
/// "atom_id".
const std::vector<std::string>& fieldNames();

/// The coefficients of a spline, as they are.
openvdb::FloatGrid::Ptr splineGrid(const Spline& spline);

/// Mean or Gaussian curvature, at each active voxel of `surface`, of the level set of the spline
/// through that voxel [1/Å or 1/Å^2]; on the same voxels as `surface`, 0 elsewhere.
openvdb::FloatGrid::Ptr curvatureGrid(const openvdb::FloatGrid& surface, const Spline& spline,
                                      bool gaussian, const Progress& progress);

/// The atom whose ball is nearest to each active voxel of `surface`; -1 elsewhere.
openvdb::Int32Grid::Ptr atomGrid(const openvdb::FloatGrid& surface, const std::vector<Ball>& balls,
                                 double reach, const Progress& progress);

} // namespace molsurf
