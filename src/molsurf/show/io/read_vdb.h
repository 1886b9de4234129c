// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads the grids and metadata of a .vdb file.

#include "molsurf/show/io/check_vdb.h"

#include <openvdb/openvdb.h>

#include <functional>
#include <string>

namespace molsurf
{

/// A .vdb file in memory.
struct VdbFile {
    openvdb::GridPtrVec grids; ///< in the order of the file, trees loaded
    openvdb::MetaMap metadata; ///< of the file as a whole
};

/// True if a file can be read and starts with OpenVDB's magic number, whatever its name: VIPERdb
/// names PDB files .vdb, too. False for pipes, whose first bytes would be gone.
bool isVdbFile(const std::string& path);

/// Reads all of a .vdb file. openvdb::initialize() must have been called.
///
/// @param[in] wanted  tells of what checkVdb() has found whether it is read, or throws an Error
/// @return nothing if it is not wanted
/// @throws Error(ErrorKind::Input) if the file does not exist, is a pipe, is no .vdb file or is cut
///         short
VdbFile readVdb(const std::string& path,
                const std::function<bool(const VdbContent&)>& wanted = nullptr);

/// A text of a file's metadata, which is looked for in its first MB without reading the rest; empty
/// if there is none.
std::string vdbText(const std::string& path, const std::string& name);

} // namespace molsurf
