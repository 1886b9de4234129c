// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The properties of a Mesh in USD's text.

#include "molsurf/mesh.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/usda_text.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The range of a mesh that is written, and how.
struct UsdaMesh {
    const Mesh& mesh;
    PartRange range;
    openvdb::Vec3d origin{0.0};  ///< is 0 in the file
    std::string indent;          ///< of its properties
    std::optional<int> time{};   ///< values are a sample at this time; none: they are constant
    double velocityFactor = 1.0; ///< of v_x, v_y and v_z, which become `velocities`
    std::vector<std::string> fields{}; ///< scalars of vertices that are primvars, others are not
    bool declared = false;             ///< only properties, without values
};

/// The box of a part.
openvdb::BBoxd boxOf(const Mesh& mesh, const PartRange& range);

/// Extent, triangles, points and normals; with colours displayColor in linear light; velocities;
/// the scalars that are asked for, as primvars of their names.
void putUsdaMesh(TextOutput& out, const UsdaMesh& what);

} // namespace molsurf
