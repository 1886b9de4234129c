// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A quantity on a regular lattice, as programs for electrostatics write it.

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// Values at the points origin + (i, j, k) * spacing.
struct ScalarMap {
    openvdb::Vec3d origin{0.0};  ///< [Å]
    openvdb::Vec3d spacing{1.0}; ///< along each axis [Å], > 0
    std::size_t counts[3] = {};  ///< of points along each axis, at least 2
    std::vector<float> values;   ///< the last axis runs fastest

    /// The value at a point, linear between points of the lattice; not a number outside.
    float at(const openvdb::Vec3d& x) const;
};

/// Reads the format OpenDX as APBS writes it: a lattice along the axes, one array of numbers.
/// @throws Error(ErrorKind::Input) with the line, if the file is no such map
ScalarMap readDx(const std::string& path, std::size_t maxBytes = 0);

/// Reads a map of MRC2014 or CCP4: modes 0, 1, 2, 6 and 12 (half floats), either byte order, any
/// order of the axes. It lies at ORIGIN if that is not 0, else at NSTART, as in ChimeraX.
/// @throws Error(ErrorKind::Input) if the file is no such map, is cut short, or if its cell is not
///         rectangular
ScalarMap readMrc(const std::string& path, std::size_t maxBytes = 0);

/// The points of a map by what the file begins with, unpacked; 0 if it cannot be read, is a pipe or
/// no map of one of these formats.
std::size_t pointsOfMap(const std::string& path);

/// Reads a map by its content.
/// @throws Error(ErrorKind::Input) as these
ScalarMap readMap(const std::string& path, std::size_t maxBytes = 0);

} // namespace molsurf
