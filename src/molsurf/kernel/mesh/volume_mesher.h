// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// OpenVDB's mesher, whose templates take the compiler a minute: one file instantiates them.

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace molsurf
{

/// Runs OpenVDB's dual contouring on the zero set of a level set.
/// @param[in]  surface  signed distance, < 0 inside [Å]
/// @param[out] mesher   new: takes the points [Å] and quads
void meshVolume(const openvdb::FloatGrid& surface, openvdb::tools::VolumeToMesh& mesher);

} // namespace molsurf
