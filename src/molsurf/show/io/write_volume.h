// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The level set on all points of a box, for programs that know no sparse grids.

#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <cstddef>
#include <vector>

namespace molsurf
{

/// A cube of pixels.
struct PixelBox {
    int count;             ///< of pixels on an edge
    openvdb::Vec3d corner; ///< centre of the first pixel [Å]
    double pixel;          ///< edge of a pixel [Å]

    std::size_t size() const { return at(0, 0, count); }

    /// The place of a pixel among values, x fastest.
    std::size_t at(int x, int y, int z) const
    {
        return (std::size_t(z) * std::size_t(count) + std::size_t(y)) * std::size_t(count) +
               std::size_t(x);
    }

    /// The place of a pixel, or of what lies between pixels [Å].
    openvdb::Vec3d place(double x, double y, double z) const
    {
        return corner + pixel * openvdb::Vec3d(x, y, z);
    }
};

/// Writes a level set as a map of MRC2014: 32-bit floats in Å, negative inside as in a .vdb, x
/// fastest, z slowest. The box is that of the band; beyond the band values are those of its rim.
/// ORIGIN has the place of the first value [Å], and NSTART the same in voxels, rounded: programs of
/// crystallography read that one. None that is known adds the two.
///
/// @param[in] surface  with cubic voxels along the axes [Å]
/// @param[in] origin   the point of space that is 0 in the file [Å]
/// @throws Error(ErrorKind::Input) if the voxels do not lie along the axes
/// @throws Error(ErrorKind::Output) if the file cannot be written, or the box has more than 2^31
///         points
void writeMrc(const openvdb::FloatGrid& surface, const openvdb::Vec3d& origin, OutputFile& file);

/// Writes values on pixels as such a map.
/// @param[in] values  x fastest, as many as there are pixels
/// @param[in] label   what they are, at most 80 letters
void writeMrc(const PixelBox& box, const std::vector<float>& values, const char* label,
              OutputFile& file);

/// Writes a level set as OpenDX text, as APBS does: z fastest, x slowest, three values a line.
void writeDx(const openvdb::FloatGrid& surface, const openvdb::Vec3d& origin, OutputFile& file);

} // namespace molsurf
