// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Patches: connected pieces of a mesh where a value is beyond a level.

#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/report.h"

#include <array>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// The part of a triangle where a linear function is above a level: the integral over it of each
/// corner's barycentric coordinate, by the area of the triangle. They add up to the part's share of
/// the area; weighted by values of the corners, to the integral of the function with these values.
/// @param[in] values  of the function at the corners
std::array<double, 3> sharesAbove(const std::array<double, 3>& values, double level);

/// Patches, and the place of each vertex among them.
struct FoundPatches {
    std::vector<Report::Patches::Patch> list; ///< the largest first
    std::vector<std::int32_t> patchOf;        ///< of each vertex: the patch, from 1; 0: none
};

/// Finds them by the value's linear interpolation, exactly. Triangles with a corner that has no
/// value are in none. Points of a triangle belong to the balls of its corners by their barycentric
/// coordinates.
/// @param[in] values   of the vertices; not a number where there is none
/// @param[in] nearest  ball of each vertex, or -1
FoundPatches findPatches(const Mesh& mesh, const std::vector<float>& values,
                         const Products::PatchRule& rule, const std::vector<std::int32_t>& nearest);

} // namespace molsurf
