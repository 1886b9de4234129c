// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The table of the frames of a run, a .csv file.

#include "molsurf/report.h"

#include <cstddef>
#include <map>
#include <string>

namespace molsurf::tool
{

/// A line of the table.
struct FrameRow {
    int frame = 0;       ///< its number in the input
    int euler = 0;       ///< Euler characteristic
    bool rests = true;   ///< the flow converged
    std::string options; ///< see optionsDigest()
    std::string line;    ///< all of it as it stands in the file
};

/// By the number of the files, from 1.
using FrameTable = std::map<std::size_t, FrameRow>;

/// @param[in] warm  whether the flow began at the surface of the frame before
FrameRow rowOf(std::size_t file, int frame, bool warm, const std::string& options,
               const Report& report);

/// Reads what saveTable() wrote; empty if the file does not exist.
/// @throws Error(ErrorKind::Output) if it is another file
FrameTable readTable(const std::string& path);

/// Replaces the file.
/// @throws Error(ErrorKind::Output) if it cannot be written
void saveTable(const FrameTable& table, const std::string& path);

} // namespace molsurf::tool
