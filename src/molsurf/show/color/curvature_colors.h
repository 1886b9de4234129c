// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours by curvature: of the mesh and of the grid Cd, by one scale.

#include "molsurf/atoms.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/show/color/color_map.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace molsurf
{

/// The vertex attribute and grid that the colours show, or null: not a curvature.
const char* curvatureNameOf(ColorBy by);

/// Red where it is positive, blue where it is negative, full at the 95th percentile of its size,
/// where the options do not say otherwise.
ColorScale curvatureScale(const std::vector<float>& curvature, const Coloring& options);

/// Colours a mesh by one of its curvatures, if `by` is one.
void colorByCurvature(ColorBy by, const Coloring& options, Mesh& mesh);

/// A grid Cd for each curvature grid of the name that `by` has, by the scale of the mesh:
/// "Cd", or with parts "Cd_NAME".
openvdb::GridPtrVec curvatureColors(ColorBy by, const Coloring& options, const Mesh& mesh,
                                    const openvdb::GridPtrVec& fields);

} // namespace molsurf
