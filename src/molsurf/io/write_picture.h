// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A picture of a level set, for a first look.

#include "molsurf/io/output_file.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Pixels in rows from top to bottom, three bytes (red, green, blue; sRGB) each.
struct Picture {
    int width = 0, height = 0; ///< [pixel]
    std::vector<std::uint8_t> rgb;
};

/// Shows the zero set from the direction of its shortest extent, the longest one across the
/// picture, on white. The picture depends on the grid only, not on the number of threads.
///
/// @param[in] surface  level set with cubic voxels, negative inside; an empty one gives a blank
///                     picture
/// @param[in] width    of the picture [pixel], > 0; the height follows the shape
Picture drawSurface(const openvdb::FloatGrid& surface, int width = 1000);

/// Writes a picture as PNG, 8 bits a channel.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writePng(const Picture& picture, OutputFile& file);

} // namespace molsurf
