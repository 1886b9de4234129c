// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The table of the frames of a run, a .csv file.

#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <map>
#include <string>

namespace molsurf
{

/// A line of the table.
struct FrameRow {
    int frame = 0;       ///< its number in the input
    int euler = 0;       ///< Euler characteristic
    bool rests = true;   ///< the flow converged
    std::string options; ///< a digest of those that the surface depends on
    std::string line;    ///< all of it as it stands in the file
};

/// By the number of the files.
using FrameTable = std::map<std::size_t, FrameRow>;

FrameRow frameRow(std::size_t file, int frame, const std::string& options, const Report& report);

/// Reads what writeFrameTable() wrote; empty if the file does not exist.
/// @throws Error(ErrorKind::Output) if it is another file
FrameTable readFrameTable(const std::string& path);

/// @throws Error(ErrorKind::Output) if it cannot be written
void writeFrameTable(const FrameTable& table, OutputFile& file);

} // namespace molsurf
