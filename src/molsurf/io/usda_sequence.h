// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The names of .vdb files and of the .usda beside them, for single files and for sequences of
/// frames.

#include "molsurf/io/write_usda.h"

#include <optional>
#include <string>

namespace molsurf
{

/// The name of a .vdb without folder and extension: "name.0001.vdb" is frame 1 of "name".
struct FrameName {
    std::string stem;
    std::optional<int> frame;
};
FrameName frameName(const std::string& path);

/// What the .usda beside a .vdb says.
///
/// @param[in] vdb         the file; of a frame, the other frames in its folder are in the .usda too
/// @param[in] sequence    whether it may be a frame
/// @param[in] metersPerUnit  length of a unit of the scene [m]
UsdVolume usdVolumeOf(const std::string& vdb, bool sequence, double metersPerUnit);

} // namespace molsurf
