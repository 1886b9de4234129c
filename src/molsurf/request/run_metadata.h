// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Metadata by which a .vdb says how it was made.

#include "molsurf/report.h"
#include "molsurf/request/request.h"

#include <openvdb/openvdb.h>

namespace molsurf
{

/// The value of a setting as metadata.
openvdb::Metadata::Ptr metadataOf(const SettingValue& value);

/// The program, its input and options ("option.NAME"), the measures of the surface, and how its
/// grids lie in their scene.
openvdb::MetaMap runMetadata(const Request& request, const Report& report);

} // namespace molsurf
