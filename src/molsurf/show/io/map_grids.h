// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Maps on regular lattices as sparse grids.

#include "molsurf/molecule/selection/scalar_map.h"

#include <openvdb/openvdb.h>

namespace molsurf
{

/// The fog "density" with the values of a map where it has them. What is 0 is not active.
openvdb::FloatGrid::Ptr fogOf(const ScalarMap& map);

/// The level set "surface" where a map has a value, negative where it has more, or, of a value
/// below 0, where it has less. The band is 3 voxels wide on either side; distances there are by
/// fast sweeping, to a fifth of a voxel. Voxels are cubes: of a map with others its values are
/// interpolated linearly, at its least spacing.
/// @throws Error(ErrorKind::Usage) if it does not have the value, or too many such cubes
openvdb::FloatGrid::Ptr levelSetOf(const ScalarMap& map, double iso);

} // namespace molsurf
