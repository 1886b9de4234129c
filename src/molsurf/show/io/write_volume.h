// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The level set on all points of a box, for programs that know no sparse grids.

#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

namespace molsurf
{

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

/// Writes the same as OpenDX text, as APBS does: z fastest, x slowest, three values a line.
void writeDx(const openvdb::FloatGrid& surface, const openvdb::Vec3d& origin, OutputFile& file);

} // namespace molsurf
